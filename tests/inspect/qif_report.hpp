// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A small inspection to write as QIF.
#pragma once

#include <cusp/inspect/qif_writer.hpp>

#include <cstddef>
#include <string>

namespace cusp::inspect::test {

/// Points on a tilted plane with deviations of ± 3 µm, one of them far beyond an edge; limits −5 … +10 µm.
inline InspectionReport qifReport(std::size_t points, Verdict verdict) {
    InspectionReport report;
    report.points_file = "part & \"17\".csv";
    report.nominal_file = "surface <a>.toml";
    const Vector3 normal = Vector3(0.6, 0.0, 0.8);
    for (std::size_t i = 0; i < points; ++i) {
        const auto x = static_cast<double>(i);
        PointDeviation point;
        point.nominal = Vector3(0.8 * x, 1e-7 * x, -0.6 * x);
        point.normal = normal;
        point.deviation_mm = 0.001 * (static_cast<double>(i % 7) - 3.0);
        report.best_fit.deviations.push_back(point);
    }
    if (points > 0) report.best_fit.deviations.back().beyond_edge_mm = 4.0;
    report.best_fit.statistics.max_mm = 0.003;
    report.best_fit.statistics.min_mm = -0.003;
    report.best_fit.statistics.profile_mm = 0.006;
    report.best_fit.decision.verdict = verdict;
    report.best_fit.decision.limits = {-0.005, 0.01};
    return report;
}

/// The same with two sections: the even points, and the first three alone.
inline InspectionReport qifReportWithSections(std::size_t points, Verdict verdict) {
    InspectionReport report = qifReport(points, verdict);
    report.best_fit.decision.uncertainty.standard_mm = 0.0001;
    for (const double position_mm : {-5.0, 30.5}) {
        SectionResult section;
        section.axis = 1;
        section.position_mm = position_mm;
        section.label = sectionLabel(1, position_mm);
        std::vector<double> deviations_mm;
        for (std::size_t i = 0; i + 1 < points; i += 2) {
            if (position_mm > 0.0 && i > 4) break;
            section.points.push_back(static_cast<std::uint32_t>(i));
            deviations_mm.push_back(report.best_fit.deviations[i].deviation_mm);
        }
        section.statistics = statisticsOf(deviations_mm);
        report.sections.push_back(section);
    }
    return report;
}

inline std::string qifText(const InspectionReport& report) {
    std::string text;
    const auto done = writeQif(report, [&text](std::string_view piece) -> base::Result<void> {
        text += piece;
        return {};
    });
    return done ? text : base::toText(done.error());
}

}  // namespace cusp::inspect::test
