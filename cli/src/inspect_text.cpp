// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// An inspection on one screen: points, alignment, deviations in both frames, sections, decision.
#include "inspect_text.hpp"

#include <cusp/base/units.hpp>
#include <cusp/inspect/texture_section.hpp>

#include <cstdint>
#include <fmt/format.h>
#include <vector>

#include <cmath>

namespace cusp::cli {

namespace {

using inspect::DeviationStatistics;
using inspect::InspectionReport;

constexpr double um_per_mm = 1e3;

std::string pointsText(const InspectionReport& report) {
    std::string out = fmt::format("{}: {} points ({}", report.points_file, report.points.size(), report.points.format);
    out += report.kind == inspect::PointKind::Centre
               ? fmt::format("), centres of a probe of radius {:.6g} mm", report.probe_radius_mm)
               : "), surface points";
    return out + fmt::format(" ({}){}\n", report.kind_source,
                             report.points.unit_stated ? "" : "; mm assumed, the file states no unit");
}

std::string alignmentText(const inspect::AlignmentSummary& a) {
    if (a.termination == inspect::Termination::NotAsked)
        return "alignment: none, the coordinates are those of the start\n";
    std::string out =
        fmt::format("alignment: {}, {} in {} + {} iterations; {} points, rms {:.4f} µm, largest {:.4f} µm\n",
                    inspect::fitName(a.fit), inspect::terminationName(a.termination), a.coarse_iterations, a.iterations,
                    a.points, um_per_mm * a.rms_mm, um_per_mm * a.minimax_mm);
    out += "  to the nominal          translation mm      ± mm       rotation °         ± °\n";
    for (Eigen::Index i = 0; i < 3; ++i)
        out += fmt::format("  {}               {:>20.6f} {:>9.6f} {:>16.7f} {:>11.7f}\n", "XYZ"[i], a.translation_mm[i],
                           std::sqrt(a.covariance(i, i)), base::degFromRad(a.rotation_vector_rad[i]),
                           base::degFromRad(std::sqrt(a.covariance(i + 3, i + 3))));
    out += fmt::format("  ± are standard deviations about {:.3f}, {:.3f}, {:.3f}; condition {:.3g}\n", a.pivot_mm.x(),
                       a.pivot_mm.y(), a.pivot_mm.z(), a.condition);
    return out;
}

std::string statisticsText(const std::string& name, const DeviationStatistics& s) {
    return fmt::format("  {:<22}{:>8}{:>12.4f}{:>12.4f}{:>12.4f}{:>12.4f}{:>12.4f}\n", name, s.count,
                       um_per_mm * s.min_mm, um_per_mm * s.max_mm, um_per_mm * s.mean_mm, um_per_mm * s.rms_mm,
                       um_per_mm * s.profile_mm);
}

/// Against the plan; nothing without one.
std::string scallopsText(const InspectionReport& report) {
    if (!(report.planned_step_over_mm > 0.0)) return {};
    std::string out = fmt::format("scallops, planned {:.6g} mm apart\n", report.planned_step_over_mm);
    for (const auto& section : report.sections) {
        std::vector<double> deviations_mm;
        deviations_mm.reserve(section.points.size());
        for (const std::uint32_t point : section.points)
            deviations_mm.push_back(report.judged().deviations[point].deviation_mm);
        const auto found = inspect::evaluateSection(section.arc_length_mm, deviations_mm, report.planned_step_over_mm);
        out += fmt::format("  section {:<14}", section.label);
        if (!found)
            out += found.error().front().message + "\n";
        else if (!found->scallops)
            out += found->note + "\n";
        else if (found->scallops->count < 2)
            out += fmt::format("{} found\n", found->scallops->count);
        else
            out += fmt::format("{:>8} found ({:.0f} planned), {:.4g} mm apart, height {:.4f} µm, at most {:.4f} µm\n",
                               found->scallops->count, found->scallops->planned_count, found->scallops->mean_spacing_mm,
                               um_per_mm * found->scallops->mean_height_mm, um_per_mm * found->scallops->max_height_mm);
    }
    return out;
}

std::string deviationsText(const InspectionReport& report) {
    std::string out = "deviations in µm        points         min         max        mean         rms     profile\n";
    out += statisticsText("in the fixed datums", report.datum.statistics);
    if (report.alignment.fit != inspect::FitKind::None)
        out += statisticsText("best-fitted", report.best_fit.statistics);
    for (const auto& section : report.sections)
        if (!section.points.empty()) out += statisticsText("section " + section.label, section.statistics);
    return out;
}

std::string decisionText(const InspectionReport& report) {
    const inspect::Decision& d = report.judged().decision;
    if (d.verdict == inspect::Verdict::NotAsked) return {};
    return fmt::format("decision {}: {} – {}\n  limits {:+.6g} … {:+.6g} mm, u = {:.3g} µm ({}), {}\n",
                       report.judged_in_datum ? "in the fixed datums" : "best-fitted", inspect::verdictName(d.verdict),
                       d.reason, d.limits.lower_mm, d.limits.upper_mm, um_per_mm * d.uncertainty.standard_mm,
                       d.uncertainty.source, inspect::ruleName(d.rule));
}

}  // namespace

std::string inspectionText(const InspectionReport& report) {
    return pointsText(report) + alignmentText(report.alignment) + deviationsText(report) + scallopsText(report) +
           decisionText(report);
}

}  // namespace cusp::cli
