// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Writes the files of an inspection side by side and lets them appear together.
#include "inspect_output.hpp"

#include "inspection_page.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/inspect/qif_writer.hpp>
#include <cusp/inspect/report_files.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <functional>
#include <system_error>
#include <vector>

namespace cusp::cli {

namespace {

using inspect::ByteSink;
using inspect::InspectionReport;

base::Result<void> writeJson(const InspectionReport& report, const ByteSink& sink) {
    return base::jsonText(inspectionJson(report)).and_then(sink);
}

base::Result<void> writePage(const InspectionReport& report, const ByteSink& sink) {
    return inspectionPage(report, report.planned_step_over_mm).and_then(sink);
}

struct Output {
    const char* name;
    base::Result<void> (*write)(const InspectionReport&, const ByteSink&);
};
constexpr Output outputs[] = {{"report.json", writeJson},
                              {"report.html", writePage},
                              {"report.qif", inspect::writeQif},
                              {"points.csv", inspect::writePointsCsv},
                              {"sections.csv", inspect::writeSectionsCsv},
                              {"deviations.ply", inspect::writeDeviationPly}};

}  // namespace

base::Result<void> writeInspection(const std::string& folder, const InspectionReport& report) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return base::fail("io.open", fmt::format("{}: {}", folder, error.message()));
    std::vector<base::AtomicFile> files;
    for (const Output& output : outputs) {
        auto file = base::AtomicFile::create((std::filesystem::path(folder) / output.name).string());
        if (!file) return base::fail(file.error());
        files.push_back(*std::move(file));
        const auto done = output.write(report, [&files](std::string_view bytes) { return files.back().write(bytes); });
        if (!done) return done;
    }
    for (base::AtomicFile& file : files)
        if (auto done = file.commit(); !done) return done;
    return {};
}

}  // namespace cusp::cli
