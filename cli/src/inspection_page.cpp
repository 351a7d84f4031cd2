// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Lists as the page wants them: one per quantity, rounded to what a screen can show.
#include "inspection_page.hpp"

#include <cusp/inspect/texture_section.hpp>
#include <cusp/pages/render.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <numeric>
#include <vector>

namespace cusp::cli {

namespace {

using base::Json;
using inspect::Evaluation;
using inspect::InspectionReport;

constexpr double per_tenth_micrometre = 1e4;
constexpr double per_nanometre = 1e6;
constexpr double per_ten_thousandth = 1e4;
constexpr std::size_t worst_points = 10;

double rounded(double value, double per_step) { return std::round(value * per_step) / per_step; }

double deviationAt(const Evaluation& evaluation, std::size_t point) {
    return evaluation.deviations[point].deviation_mm;
}

bool counts(const InspectionReport& report, std::size_t point) {
    return report.judged().deviations[point].beyond_edge_mm <= report.edge_tolerance_mm;
}

/// Points that count, the largest deviation first; of equals, the first measured.
std::vector<std::size_t> largestFirst(const InspectionReport& report, std::size_t wanted) {
    std::vector<std::size_t> points;
    for (std::size_t i = 0; i < report.judged().deviations.size(); ++i)
        if (counts(report, i)) points.push_back(i);
    const auto end = points.begin() + static_cast<std::ptrdiff_t>(std::min(wanted, points.size()));
    std::partial_sort(points.begin(), end, points.end(), [&report](std::size_t a, std::size_t b) {
        const double first = std::abs(deviationAt(report.judged(), a));
        const double second = std::abs(deviationAt(report.judged(), b));
        return first > second || (first == second && a < b);
    });
    points.erase(end, points.end());
    return points;
}

/// At most `wanted` points, in the order they were measured: a quarter of them the largest deviations, the rest at equal
/// steps.
std::vector<std::size_t> pointsForMap(const InspectionReport& report, std::size_t wanted) {
    const std::size_t total = report.judged().deviations.size();
    if (total <= wanted) {
        std::vector<std::size_t> all(total);
        std::iota(all.begin(), all.end(), std::size_t{0});
        return all;
    }
    std::vector<std::size_t> points = largestFirst(report, wanted / 4);
    const std::size_t room = wanted - points.size();
    for (std::size_t i = 0; i < room; ++i) points.push_back(i * total / room);
    std::sort(points.begin(), points.end());
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

Json listOf(const std::vector<std::size_t>& points, double per_step, const auto& value) {
    Json list = Json::array();
    for (const std::size_t point : points) list.push_back(rounded(value(point), per_step));
    return list;
}

Json mapOf(const InspectionReport& report, std::size_t wanted) {
    const Evaluation& judged = report.judged();
    const std::vector<std::size_t> points = pointsForMap(report, wanted);
    Json map;
    constexpr std::array axes{'x', 'y', 'z'};
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const char name = axes[static_cast<std::size_t>(axis)];
        map[fmt::format("{}_mm", name)] = listOf(points, per_tenth_micrometre, [&judged, axis](std::size_t point) {
            return judged.deviations[point].surfacePoint()[axis];
        });
        map[fmt::format("normal_{}", name)] = listOf(points, per_ten_thousandth, [&judged, axis](std::size_t point) {
            return judged.deviations[point].normal[axis];
        });
    }
    const auto deviations = [&points](const Evaluation& evaluation) {
        return listOf(points, per_nanometre,
                      [&evaluation](std::size_t point) { return deviationAt(evaluation, point); });
    };
    map["deviation_mm"] = deviations(judged);
    if (report.alignment.fit != inspect::FitKind::None) {
        map["best_fit_deviation_mm"] = deviations(report.best_fit);
        map["datum_deviation_mm"] = deviations(report.datum);
    }
    if (points.size() < judged.deviations.size())
        map["thinning"] = fmt::format("Shown are {} of {} points, the {} largest deviations among them.", points.size(),
                                      judged.deviations.size(), largestFirst(report, wanted / 4).size());
    return map;
}

Json worstOf(const InspectionReport& report) {
    Json worst = Json::array();
    for (const std::size_t point : largestFirst(report, worst_points)) {
        const inspect::Vector3 at = report.judged().deviations[point].surfacePoint();
        worst.push_back({{"point", point},
                         {"x_mm", at.x()},
                         {"y_mm", at.y()},
                         {"z_mm", at.z()},
                         {"deviation_mm", deviationAt(report.judged(), point)}});
    }
    return worst;
}

std::vector<double> deviationsOf(const InspectionReport& report, const inspect::SectionResult& section) {
    std::vector<double> out;
    out.reserve(section.points.size());
    for (const std::uint32_t point : section.points) out.push_back(deviationAt(report.judged(), point));
    return out;
}

Json curveOf(const InspectionReport& report, const inspect::SectionResult& section, double planned_step_over_mm) {
    Json arc_length = Json::array();
    Json deviation = Json::array();
    for (std::size_t i = 0; i < section.points.size(); ++i) {
        arc_length.push_back(rounded(section.arc_length_mm[i], per_tenth_micrometre));
        deviation.push_back(rounded(deviationAt(report.judged(), section.points[i]), per_nanometre));
    }
    Json curve{{"arc_length_mm", arc_length}, {"deviation_mm", deviation}};
    const auto form =
        inspect::evaluateSection(section.arc_length_mm, deviationsOf(report, section), planned_step_over_mm);
    if (!form) return curve;
    Json form_mm = Json::array();
    for (const double height : form->form.form_mm) form_mm.push_back(rounded(height, per_nanometre));
    curve["form_mm"] = form_mm;
    curve["form"] = form->form.text;
    return curve;
}

}  // namespace

void addSectionForms(Json& json, const InspectionReport& report, double planned_step_over_mm) {
    for (std::size_t i = 0; i < report.sections.size(); ++i) {
        const inspect::SectionResult& section = report.sections[i];
        const auto found =
            inspect::evaluateSection(section.arc_length_mm, deviationsOf(report, section), planned_step_over_mm);
        if (!found) continue;
        const Json added = inspect::toJson(*found, planned_step_over_mm);
        json["sections"][i]["form"] = added["form"];
        // Without a plan ridges of noise would count as scallops.
        if (!(planned_step_over_mm > 0.0)) continue;
        json["sections"][i]["scallops"] = added["scallops"];
        if (!found->note.empty()) json["sections"][i]["scallops_note"] = found->note;
    }
}

Json inspectionJson(const InspectionReport& report) {
    Json json = inspect::toJson(report);
    addSectionForms(json, report, report.planned_step_over_mm);
    return json;
}

Json inspectionDocument(const InspectionReport& report, double planned_step_over_mm, std::size_t map_points) {
    Json document = inspect::toJson(report);
    addSectionForms(document, report, planned_step_over_mm);
    for (std::size_t i = 0; i < report.sections.size(); ++i)
        document["sections"][i]["curve"] = curveOf(report, report.sections[i], planned_step_over_mm);
    document["worst"] = worstOf(report);
    document["map"] = mapOf(report, map_points);
    return document;
}

base::Result<std::string> inspectionPage(const InspectionReport& report, double planned_step_over_mm) {
    return base::jsonText(inspectionDocument(report, planned_step_over_mm)).and_then([](const std::string& json) {
        return pages::renderPage("inspection", json);
    });
}

}  // namespace cusp::cli
