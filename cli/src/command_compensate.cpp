// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp compensate`: the deviation that was measured, mirrored into the path.
#include "command.hpp"
#include "console.hpp"
#include "cut_input.hpp"
#include "input.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/json_report.hpp>
#include <cusp/geometry/cad/nominal_file.hpp>
#include <cusp/loop/correction.hpp>
#include <cusp/toolpath/cl_writer.hpp>

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace cusp::cli {

namespace {

constexpr std::size_t largest_report = std::size_t{256} << 20U;

struct Flags {
    std::string cl_file;
    std::string deviation;
    std::string nominal;
    std::string output;
    std::string dialect;
    std::string units;
    std::string part = "pose-and-form";
    toolpath::CompensationOptions options;
    double gouge_mm = 0.002;
    bool json = false;
};

struct Outcome {
    std::string nominal;
    geometry::DeviationField field;
    toolpath::CompensatedPath done;
    std::optional<loop::CorrectionCheck> check;  ///< absent: the nominal has no faces to check on
};

/// --nominal, else what the report was made with.
base::Result<std::string> nominalOf(const Flags& flags, const std::string& report) {
    if (!flags.nominal.empty()) return flags.nominal;
    const auto json = base::Json::parse(report, nullptr, false);
    if (json.is_object() && json.contains("nominal_file") && json["nominal_file"].is_string()) {
        auto named = json["nominal_file"].get<std::string>();
        if (!named.empty()) return named;
    }
    return base::fail("compensate.nominal", "the report does not name its nominal surface; give --nominal",
                      {flags.deviation, 0, 0, "nominal_file"});
}

base::Result<Outcome> compensatePath(const Flags& flags) {
    const auto report = base::readWholeFile(flags.deviation, largest_report);
    if (!report) return base::fail(report.error());
    auto field = geometry::readReportedDeviationField(*report, flags.deviation, "datum");
    if (!field) return base::fail(field.error());
    auto nominal_file = nominalOf(flags, *report);
    if (!nominal_file) return base::fail(nominal_file.error());
    base::Diagnostics remarks;
    const auto nominal = geometry::loadNominal(*nominal_file, remarks);
    tell(remarks);
    if (!nominal) return base::fail(nominal.error());
    const auto path = readWholeCl(flags.cl_file, clReaderOptions(flags.dialect, flags.units, false));
    if (!path) return base::fail(path.error());
    auto done = toolpath::compensate(*path, **nominal, *field, flags.options);
    if (!done) return base::fail(done.error());
    Outcome out{.nominal = *std::move(nominal_file), .field = *std::move(field), .done = *std::move(done), .check = {}};
    if (const auto* faces = dynamic_cast<const geometry::ParametricSurface*>(nominal->get());
        faces != nullptr && faces->trimmedFaces() == 0) {
        constexpr double spacing_mm = 1.0;
        const auto check =
            loop::checkCorrection(*path, out.done.path, *faces, out.field, flags.options, spacing_mm, flags.gouge_mm);
        if (!check) return base::fail(check.error());
        out.check = *check;
    }
    return out;
}

base::Json toJson(const Flags& flags, const Outcome& outcome) {
    const auto& sum = outcome.done.summary;
    base::Json out = base::jsonReport("compensate", 1);
    out["cl_file"] = flags.cl_file;
    out["deviation"] = flags.deviation;
    out["nominal"] = outcome.nominal;
    out["output"] = flags.output;
    out["part"] = flags.part;
    out["gain"] = flags.options.gain;
    out["clamp_mm"] = flags.options.clamp_mm;
    out["shortest_wave_mm"] = outcome.field.data().shortest_wave_mm;
    out["residual_mm"] = outcome.field.data().residual_mm;
    out["locations"] = sum.locations;
    out["moved"] = sum.moved;
    out["clamped"] = sum.clamped;
    out["extrapolated"] = sum.extrapolated;
    out["max_shift_mm"] = sum.max_shift_mm;
    out["rms_shift_mm"] = sum.rms_shift_mm;
    out["check"] = base::Json();
    if (outcome.check) {
        const auto& at = outcome.check->gouge_at_mm;
        out["check"] = {{"points", outcome.check->points},     {"max_change_mm", outcome.check->max_change_mm},
                        {"gouge_mm", outcome.check->gouge_mm}, {"gouge_at_mm", {at.x(), at.y(), at.z()}},
                        {"left_mm", outcome.check->left_mm},   {"allowed_mm", outcome.check->allowed_mm},
                        {"holds", outcome.check->holds()}};
    }
    return out;
}

std::string toText(const Flags& flags, const Outcome& outcome) {
    const auto& sum = outcome.done.summary;
    std::string out = fmt::format("{}: {} of {} locations moved, at most {:.1f} µm, rms {:.1f} µm\n", flags.output,
                                  sum.moved, sum.locations, sum.max_shift_mm * 1e3, sum.rms_shift_mm * 1e3);
    out += fmt::format("  the field keeps waves longer than {:.1f} mm and leaves {:.1f} µm (noise, scallops)\n",
                       outcome.field.data().shortest_wave_mm, outcome.field.data().residual_mm * 1e3);
    if (sum.clamped > 0)
        out += fmt::format("  {} locations are held at the clamp of {} mm\n", sum.clamped, flags.options.clamp_mm);
    if (sum.extrapolated > 0)
        out +=
            fmt::format("  {} locations lie outside of what was measured: the nearest value holds\n", sum.extrapolated);
    if (!outcome.check)
        return out + "  not checked for gouges: that needs a nominal of untrimmed faces; use cusp evaluate\n";
    const auto& check = *outcome.check;
    if (check.holds())
        out += fmt::format("  checked at {} points: cut deeper than meant by at most {:.2f} µm\n", check.points,
                           check.gouge_mm * 1e3);
    else
        out += fmt::format("  GOUGE: cut {:.1f} µm deeper than meant at X{:.2f} Y{:.2f} Z{:.2f}; {} µm are allowed\n",
                           check.gouge_mm * 1e3, check.gouge_at_mm.x(), check.gouge_at_mm.y(), check.gouge_at_mm.z(),
                           check.allowed_mm * 1e3);
    return out;
}

ExitCode runCompensate(const Flags& flags) {
    const auto outcome = compensatePath(flags);
    if (!outcome) return failWith(outcome.error());
    if (interrupted()) return ExitCode::Interrupted;
    const bool sound = !outcome->check || outcome->check->holds();
    // A path that gouges is not written: somebody would cut it.
    if (sound) {
        const auto text = toolpath::clText(outcome->done.path);
        if (!text) return failWith(text.error());
        auto target = base::OutputTarget::open(flags.output);
        if (!target) return failWith(target.error());
        if (auto written = target->write(*text); !written) return failWith(written.error());
        if (auto committed = target->commit(); !committed) return failWith(committed.error());
    }
    if (flags.json)
        sayJson(toJson(flags, *outcome));
    else if (flags.output != "-")
        say(toText(flags, *outcome));
    return sound ? ExitCode::Done : ExitCode::FoundSomething;
}

}  // namespace

void addCompensateCommand(CLI::App& app, Action& action) {
    CLI::App* compensate = app.add_subcommand(
        "compensate",
        "Takes the deviation of a measured part back in the path: where it came out high, the tool goes lower.");
    const auto flags = std::make_shared<Flags>();
    compensate->add_option("FILE", flags->cl_file, "CL file the part was cut with.")->required();
    compensate->add_option("--deviation", flags->deviation, "report.json of cusp inspect.")->required();
    compensate->add_option("-o,--output", flags->output, "CL file to write; - for standard output.")->required();
    compensate->add_option("--nominal", flags->nominal, "Nominal surface; absent: the one the report names.");
    compensate
        ->add_option("--part", flags->part,
                     "What is taken back: pose and form, or form alone when the work offset takes the pose.")
        ->capture_default_str()
        ->check(CLI::IsMember({"pose-and-form", "form"}));
    compensate->add_option("--gain", flags->options.gain, "Share of the deviation that is taken back.")
        ->capture_default_str()
        ->check(CLI::Range(0.01, 1.5));
    compensate->add_option("--clamp-mm", flags->options.clamp_mm, "No location moves farther than this.")
        ->capture_default_str()
        ->check(CLI::Range(1e-4, 1.0));
    compensate
        ->add_option("--gouge-mm", flags->gouge_mm, "A path that cuts deeper than meant by more than this is refused.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    compensate->add_option("--dialect", flags->dialect, "Who wrote the CL file, when it cannot be told from the text.")
        ->check(CLI::IsMember({"nx", "catia", "solidworks", "apt"}));
    compensate->add_option("--units", flags->units, "Unit of lengths, when the CL file does not say.")
        ->check(CLI::IsMember({"mm", "inch"}));
    compensate->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    compensate->callback([flags, &action] {
        flags->options.part =
            flags->part == "form" ? toolpath::CompensatedPart::Form : toolpath::CompensatedPart::PoseAndForm;
        action = [flags] { return runCompensate(*flags); };
    });
}

}  // namespace cusp::cli
