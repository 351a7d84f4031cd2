// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cuts sections from measured points and lays them out along the nominal section.
#include <cusp/inspect/section.hpp>

#include "section_order.hpp"

#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cusp::inspect {
namespace {

/// The pieces of a section; of one whose label is no plane, the points as measured, joined by chords.
std::vector<SectionPiece> piecesOf(const SectionResult& section, const std::vector<std::uint32_t>& members,
                                   std::span<const PointDeviation> deviations, const geometry::NominalShape& nominal) {
    std::vector<Vector3> positions;
    std::vector<Vector3> normals;
    for (const std::uint32_t i : members) {
        positions.push_back(deviations[i].nominal);
        normals.push_back(deviations[i].normal);
    }
    if (section.axis) {
        const SectionPlane plane{*section.axis, section.position_mm};
        return orderedPieces(plane, stationsIn(plane, std::move(positions), std::move(normals), nominal), nominal);
    }
    SectionPiece piece;
    for (std::size_t k = 0; k < positions.size(); ++k) {
        piece.stations.push_back(static_cast<std::uint32_t>(k));
        piece.step_mm.push_back(k == 0 ? 0.0 : (positions[k] - positions[k - 1]).norm());
    }
    return {piece};
}

/// What stands between two pieces: the middle step within them.
double jointOf(const std::vector<SectionPiece>& pieces) {
    std::vector<double> steps;
    for (const SectionPiece& piece : pieces) steps.insert(steps.end(), piece.step_mm.begin() + 1, piece.step_mm.end());
    if (steps.empty()) return 1.0;
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

/// Fills points, arc lengths and statistics. `candidates` are indices of measured points.
void layOut(SectionResult& section, const std::vector<std::uint32_t>& candidates,
            std::span<const PointDeviation> deviations, const geometry::NominalShape& nominal,
            double edge_tolerance_mm) {
    std::vector<std::uint32_t> members;
    std::copy_if(candidates.begin(), candidates.end(), std::back_inserter(members),
                 [&](std::uint32_t i) { return deviations[i].beyond_edge_mm <= edge_tolerance_mm; });
    section.beyond_edge = candidates.size() - members.size();
    if (members.empty()) return;
    const std::vector<SectionPiece> pieces = piecesOf(section, members, deviations, nominal);
    const double joint_mm = jointOf(pieces);
    double arc_mm = 0.0;
    std::vector<double> values;
    for (const SectionPiece& piece : pieces) {
        if (!section.points.empty()) arc_mm += joint_mm;
        section.piece_starts.push_back(static_cast<std::uint32_t>(section.points.size()));
        for (std::size_t k = 0; k < piece.stations.size(); ++k) {
            const std::uint32_t point = members[piece.stations[k]];
            arc_mm += piece.step_mm[k];
            section.length_mm += piece.step_mm[k];
            section.points.push_back(point);
            section.arc_length_mm.push_back(arc_mm);
            values.push_back(deviations[point].deviation_mm);
        }
    }
    section.statistics = statisticsOf(values);
    section.statistics.min_point = section.points[section.statistics.min_point];
    section.statistics.max_point = section.points[section.statistics.max_point];
}

double widthOf(const SectionPlan& plan) {
    if (plan.width_mm) return *plan.width_mm;
    double width = 1.0;
    for (std::size_t i = 0; i < plan.positions_mm.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const double gap = std::abs(plan.positions_mm[i] - plan.positions_mm[j]);
            if (gap > 0.0) width = std::min(width, 0.5 * gap);
        }
    return width;
}

}  // namespace

std::string sectionLabel(int axis, double position_mm) {
    return std::string(1, "XYZ"[axis]) + "=" + base::formatShortest(position_mm);
}

base::Result<SectionPlan> parseSectionPlan(std::string_view text) {
    SectionPlan plan;
    const std::size_t axis = text.empty() ? std::string_view::npos : std::string_view("XYZxyz").find(text.front());
    bool sound = axis != std::string_view::npos && text.size() > 2 && text[1] == '=';
    for (std::size_t at = 2; sound && at <= text.size();) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        const auto value = base::parseDouble(text.substr(at, end - at));
        sound = value.has_value();
        if (value) plan.positions_mm.push_back(*value);
        at = end + 1;
    }
    if (!sound)
        return base::fail("sections.text",
                          fmt::format("'{}' names no sections; they are written like X=-5,-30,-60,-90", text));
    plan.axis = static_cast<int>(axis % 3);
    return plan;
}

std::vector<SectionResult> cutSections(const SectionPlan& plan, const MeasuredPoints& points,
                                       std::span<const PointDeviation> deviations,
                                       const geometry::NominalShape& nominal, double edge_tolerance_mm) {
    std::vector<SectionResult> out;
    for (const double position_mm : plan.positions_mm) {
        SectionResult section;
        section.label = sectionLabel(plan.axis, position_mm);
        section.axis = plan.axis;
        section.position_mm = position_mm;
        const auto label = std::find(points.section_labels.begin(), points.section_labels.end(), section.label);
        const auto index = static_cast<std::int32_t>(label - points.section_labels.begin());
        const bool was_measured = label != points.section_labels.end();
        section.width_mm = was_measured ? 0.0 : widthOf(plan);
        std::vector<std::uint32_t> candidates;
        for (std::size_t i = 0; i < deviations.size(); ++i) {
            const double off_mm = std::abs(deviations[i].nominal[plan.axis] - position_mm);
            if (was_measured ? points.sections[i] == index : off_mm <= 0.5 * section.width_mm)
                candidates.push_back(static_cast<std::uint32_t>(i));
        }
        layOut(section, candidates, deviations, nominal, edge_tolerance_mm);
        out.push_back(std::move(section));
    }
    return out;
}

std::vector<SectionResult> measuredSections(const MeasuredPoints& points, std::span<const PointDeviation> deviations,
                                            const geometry::NominalShape& nominal, double edge_tolerance_mm) {
    std::vector<std::vector<std::uint32_t>> members(points.section_labels.size());
    for (std::size_t i = 0; i < points.sections.size(); ++i)
        if (points.sections[i] >= 0)
            members[static_cast<std::size_t>(points.sections[i])].push_back(static_cast<std::uint32_t>(i));
    std::vector<SectionResult> out;
    for (std::size_t k = 0; k < members.size(); ++k) {
        SectionResult section;
        section.label = points.section_labels[k];
        if (const auto plan = parseSectionPlan(section.label); plan && plan->positions_mm.size() == 1) {
            section.axis = plan->axis;
            section.position_mm = plan->positions_mm.front();
        }
        layOut(section, members[k], deviations, nominal, edge_tolerance_mm);
        out.push_back(std::move(section));
    }
    return out;
}

}  // namespace cusp::inspect
