// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp texture`: the profile, roughness and waviness parameters of stylus traces.
#include "command.hpp"
#include "console.hpp"
#include "input.hpp"
#include "texture_page.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/number_text.hpp>
#include <cusp/inspect/texture_report.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

namespace cusp::cli {

namespace {

constexpr double mm_per_um = 1e-3;

struct Flags {
    std::vector<std::string> files;
    std::string output;
    std::string form = "line";
    double cutoff_mm = 0.8;
    double short_cutoff_mm = 0.0;
    double depth_um = 1.0;
    double peak_band_um = 0.5;
    bool json = false;
};

inspect::TextureOptions optionsOf(const Flags& flags) {
    inspect::TextureOptions options;
    options.form = flags.form == "none"   ? inspect::FormRemoval::None
                   : flags.form == "line" ? inspect::FormRemoval::Line
                                          : inspect::FormRemoval::Curve;
    options.cutoff_mm = flags.cutoff_mm;
    options.short_cutoff_mm = flags.short_cutoff_mm;
    options.conditions.depth_mm = flags.depth_um * mm_per_um;
    options.conditions.peak_band_mm = flags.peak_band_um * mm_per_um;
    return options;
}

base::Result<inspect::TextureReport> evaluate(const std::string& file, const Flags& flags) {
    auto input = TextInput::open(file);
    if (!input) return base::fail(input.error());
    base::Diagnostics warnings;
    auto profile = inspect::readStylusProfile(input->stream(), input->name(), warnings);
    tell(warnings);
    if (!profile) return base::fail(profile.error());
    auto report = inspect::evaluateTexture(*std::move(profile), optionsOf(flags));
    if (!report) {
        // The evaluation does not know files; the user gave several, perhaps.
        base::Diagnostics named;
        for (base::Diagnostic item : report.error()) {
            item.where.file = input->name();
            named.add(std::move(item));
        }
        return base::fail(std::move(named));
    }
    return report;
}

std::string unitText(const std::string& unit) {
    if (unit == "um") return "µm";
    if (unit == "percent") return "%";
    if (unit == "deg") return "°";
    if (unit == "per_mm") return "1/mm";
    if (unit == "mm3_per_mm2") return "mm³/mm²";
    return unit;
}

std::string valueText(const inspect::TextureParameter& parameter) {
    return parameter.value ? fmt::format("{:.4g}", *parameter.value) : std::string("–");
}

/// fmt counts code points, so "µm" takes two columns as it should.
std::string tableText(const inspect::TextureReport& report) {
    std::string out =
        fmt::format("{}: {} heights, {:.6g} mm apart, over {:.6g} mm\n  {}\n", report.profile.source,
                    report.profile.height_mm.size(), report.profile.spacing_mm, report.profile.lengthMm(), report.form);
    for (const std::string& note : report.notes) out += "  " + note + "\n";
    out += fmt::format("\n  {:<6}{:>12}{:>12}{:>12}  {:<9}{}\n", "", "P", "R", "W", "unit", "source");
    for (std::size_t i = 0; i < report.primary.parameters.size(); ++i) {
        const inspect::TextureParameter& p = report.primary.parameters[i];
        out += fmt::format("  {:<6}{:>12}{:>12}{:>12}  {:<9}{}{}\n", p.name.substr(1), valueText(p),
                           valueText(report.roughness.parameters[i]), valueText(report.waviness.parameters[i]),
                           unitText(p.unit), p.source, p.condition.empty() ? "" : "; " + p.condition);
    }
    return out;
}

std::string inQuotes(std::string_view text) {
    std::string out = "\"";
    for (const char character : text) {
        if (character == '"') out += '"';
        out += character;
    }
    return out + "\"";
}

std::string csvText(const std::vector<inspect::TextureReport>& reports) {
    std::string out = "profile,parameter,value,unit,condition,source\n";
    for (const inspect::TextureReport& report : reports)
        for (const auto* band : {&report.primary, &report.roughness, &report.waviness})
            for (const inspect::TextureParameter& p : band->parameters)
                out += fmt::format("{},{},{},{},{},{}\n", inQuotes(report.profile.source), p.name,
                                   p.value ? base::formatShortest(*p.value) : "", p.unit, inQuotes(p.condition),
                                   inQuotes(p.source));
    return out;
}

base::Result<void> writeFolder(const std::string& folder, const std::vector<inspect::TextureReport>& reports) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return base::fail("io.open", fmt::format("{}: {}", folder, error.message()));
    const auto path = [&folder](const char* name) { return (std::filesystem::path(folder) / name).string(); };
    return base::jsonText(textureSummary(reports))
        .and_then([&](const std::string& json) { return base::writeWholeFile(path("texture.json"), json); })
        .and_then([&] { return base::writeWholeFile(path("texture.csv"), csvText(reports)); })
        .and_then([&] { return texturePage(reports); })
        .and_then([&](const std::string& html) { return base::writeWholeFile(path("texture.html"), html); });
}

ExitCode runTexture(const Flags& flags) {
    std::vector<inspect::TextureReport> reports;
    base::Diagnostics failures;
    for (const std::string& file : flags.files) {
        if (interrupted()) return ExitCode::Interrupted;
        auto report = evaluate(file, flags);
        if (report)
            reports.push_back(*std::move(report));
        else
            failures.append(report.error());
    }
    // Whoever gives ten files wants to hear of every one that is wrong; results of the others would look complete.
    if (failures.hasErrors()) return failWith(failures);
    if (!flags.output.empty())
        if (const auto done = writeFolder(flags.output, reports); !done) return failWith(done.error());
    if (flags.json)
        sayJson(textureSummary(reports));
    else
        for (const inspect::TextureReport& report : reports) say(tableText(report));
    return ExitCode::Done;
}

}  // namespace

void addTextureCommand(CLI::App& app, Action& action) {
    CLI::App* texture = app.add_subcommand(
        "texture", "Roughness: the parameters of profiles traced by a stylus, unfiltered (P) and filtered (R, W).");
    const auto flags = std::make_shared<Flags>();
    texture->add_option("PROFILE", flags->files, "Stylus profiles (cusp_stylus_profile); - for standard input.")
        ->required();
    texture->add_option("-o,--output", flags->output, "Folder for texture.html, texture.json and texture.csv.");
    texture->add_option("--form", flags->form, "What is taken off first: none, a line, a curve of fitting order.")
        ->capture_default_str()
        ->check(CLI::IsMember({"none", "line", "curve"}));
    texture->add_option("--cutoff-mm", flags->cutoff_mm, "Cut-off between roughness and waviness.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    texture->add_option("--short-cutoff-mm", flags->short_cutoff_mm, "What is shorter is noise; 0 keeps it.")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    texture->add_option("--depth-um", flags->depth_um, "Depth under the highest peak of mr, Tp and HSC.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    texture->add_option("--peak-band-um", flags->peak_band_um, "Half the band the peak count Pc must pass.")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    texture->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    texture->callback([flags, &action] { action = [flags] { return runTexture(*flags); }; });
}

}  // namespace cusp::cli
