// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp capability`: QIF results of many parts, to capability and trend of every characteristic.
#include "command.hpp"
#include "console.hpp"
#include "input.hpp"
#include "qif_schema.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/number_text.hpp>
#include <cusp/base/units.hpp>
#include <cusp/inspect/capability.hpp>
#include <cusp/pages/render.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace cusp::cli {

namespace {

using inspect::CapabilitySeries;
using inspect::QifResults;

struct Flags {
    std::vector<std::string> files;
    std::string output;
    std::string schema;
    bool json = false;
};

base::Result<QifResults> readOne(const std::string& file, const Flags& flags) {
    if (!flags.schema.empty())
        if (const auto valid = checkAgainstQifSchema(file, flags.schema); !valid) return base::fail(valid.error());
    auto input = TextInput::open(file);
    if (!input) return base::fail(input.error());
    base::Diagnostics warnings;
    auto results = inspect::readQif(input->stream(), input->name(), warnings);
    tell(warnings);
    if (results && results->measurements.empty())
        return base::fail("capability.nothing", "the document holds no measured characteristic with a value",
                          {input->name(), 0, 0, {}});
    return results;
}

std::string numberText(const std::optional<double>& value, int decimals) {
    return value ? base::formatFixed(*value, decimals) : std::string("–");
}

std::string titleOf(const CapabilitySeries& series) {
    return series.feature.empty() ? series.name : series.name + " of " + series.feature;
}

std::string trendText(const CapabilitySeries& series) {
    constexpr double bar = 0.01;
    if (!series.trend_probability || *series.trend_probability >= bar) return "";
    const double scale = series.is_angle ? base::degFromRad(1.0) : 1.0;
    return fmt::format("trend {:+.3g} {} per part (p = {:.1g})", series.slope_per_part.value_or(0.0) * scale,
                       series.is_angle ? "°" : "mm", *series.trend_probability);
}

std::string tableText(const std::vector<QifResults>& files, const std::vector<CapabilitySeries>& all) {
    std::size_t parts = 0;
    std::size_t widest = 0;
    for (const QifResults& file : files) parts += file.parts.size();
    for (const CapabilitySeries& series : all) widest = std::max(widest, titleOf(series).size());
    std::string out = fmt::format("{} parts, {} characteristics\n\n  {:<{}}{:>5}{:>14}{:>8}{:>8}{:>8}{:>8}{:>8}\n",
                                  parts, all.size(), "", widest, "n", "mean", "Cp", "Cpk", "Pp", "Ppk", "beyond");
    for (const CapabilitySeries& s : all) {
        const double mean = s.is_angle ? base::degFromRad(s.mean) : s.mean;
        out +=
            fmt::format("  {:<{}}{:>5}{:>11} {:<2}{:>8}{:>8}{:>8}{:>8}{:>8}  {}\n", titleOf(s), widest, s.values.size(),
                        base::formatFixed(mean, 4), s.is_angle ? "°" : "mm", numberText(s.cp, 2), numberText(s.cpk, 2),
                        numberText(s.pp, 2), numberText(s.ppk, 2), s.beyond_limits, trendText(s));
    }
    return out;
}

base::Result<void> writeFolder(const std::string& folder, const base::Json& summary) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return base::fail("io.open", fmt::format("{}: {}", folder, error.message()));
    const auto path = [&folder](const char* name) { return (std::filesystem::path(folder) / name).string(); };
    return base::jsonText(summary).and_then([&](const std::string& json) {
        return base::writeWholeFile(path("capability.json"), json)
            .and_then([&] { return pages::renderPage("capability", json); })
            .and_then([&](const std::string& html) { return base::writeWholeFile(path("capability.html"), html); });
    });
}

ExitCode runCapability(const Flags& flags) {
    std::vector<QifResults> files;
    base::Diagnostics failures;
    for (const std::string& file : flags.files) {
        if (interrupted()) return ExitCode::Interrupted;
        auto results = readOne(file, flags);
        if (results)
            files.push_back(*std::move(results));
        else
            failures.append(results.error());
    }
    if (failures.hasErrors()) return failWith(failures);
    const auto series = inspect::capabilityOf(files);
    if (!series) return failWith(series.error());
    const base::Json summary = inspect::capabilityJson(files, *series);
    if (!flags.output.empty())
        if (const auto done = writeFolder(flags.output, summary); !done) return failWith(done.error());
    if (flags.json)
        sayJson(summary);
    else
        say(tableText(files, *series));
    for (const CapabilitySeries& one : *series)
        if (one.beyond_limits > 0) return ExitCode::FoundSomething;
    return ExitCode::Done;
}

}  // namespace

void addCapabilityCommand(CLI::App& app, Action& action) {
    CLI::App* capability = app.add_subcommand(
        "capability", "Many parts: Cp, Cpk, Pp, Ppk and the trend of every characteristic, from QIF results.");
    const auto flags = std::make_shared<Flags>();
    capability->add_option("RESULTS", flags->files, "QIF 2.1 or 3.0 documents, in the order the parts were made.")
        ->required();
    capability->add_option("-o,--output", flags->output, "Folder for capability.html and capability.json.");
    capability->add_option(
        "--qif-schema", flags->schema,
        "Folder of the QIF schema (QIFApplications/QIFDocument.xsd): every document is checked first.");
    capability->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    capability->callback([flags, &action] { action = [flags] { return runCapability(*flags); }; });
}

}  // namespace cusp::cli
