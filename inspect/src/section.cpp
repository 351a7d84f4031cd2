// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cuts sections from measured points and lays them out along the nominal section.
#include <cusp/inspect/section.hpp>

#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <numeric>

namespace cusp::inspect {
namespace {

/// A point of the nominal section with its tangent along the section, in the plane.
struct Station {
    Vector3 position;
    Vector3 tangent;
};

/// Moves footpoints along the nominal into the plane: Newton's steps to where surface and plane meet, each answered by
/// the nominal itself.
std::vector<Station> stationsIn(int axis, double position_mm, std::vector<Vector3> positions,
                                std::vector<Vector3> normals, const geometry::NominalShape& nominal) {
    std::vector<geometry::Footpoint> footpoints(positions.size());
    const Vector3 a = Vector3::Unit(axis);
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const Vector3 uphill = a - a.dot(normals[i]) * normals[i];
            const double slope = uphill.squaredNorm();
            const double gap = position_mm - positions[i][axis];
            // A surface parallel to the plane has no section with it; then the point stays where it is.
            if (slope > 1e-6) positions[i] += gap / slope * uphill;
        }
        nominal.closest(positions, footpoints, round > 0);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            positions[i] = footpoints[i].position;
            normals[i] = footpoints[i].normal;
        }
    }
    std::vector<Station> out(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vector3 tangent = a.cross(normals[i]);
        const double length = tangent.norm();
        out[i] = {positions[i], length > 1e-9 ? Vector3(tangent / length) : Vector3::Zero()};
    }
    return out;
}

/// Along the mean tangent where no tangent turns away from it, else by the angle about the middle of the section.
std::vector<double> orderKeys(const std::vector<Station>& stations, int axis) {
    Vector3 middle = Vector3::Zero();
    Vector3 mean = Vector3::Zero();
    for (const Station& s : stations) {
        middle += s.position / static_cast<double>(stations.size());
        mean += s.tangent;
    }
    const bool runs_one_way = std::all_of(stations.begin(), stations.end(),
                                          [&](const Station& s) { return s.tangent.dot(mean) > 0.05 * mean.norm(); });
    std::vector<double> keys;
    const int first = (axis + 1) % 3;
    const int second = (axis + 2) % 3;
    for (const Station& s : stations) {
        const Vector3 arm = s.position - middle;
        keys.push_back(runs_one_way ? s.position.dot(mean.normalized()) : std::atan2(arm[second], arm[first]));
    }
    return keys;
}

/// Sorted by the keys, in the direction in which the points were measured.
std::vector<std::uint32_t> ordered(const std::vector<double>& keys) {
    std::vector<std::uint32_t> order(keys.size());
    std::iota(order.begin(), order.end(), 0U);
    std::sort(order.begin(), order.end(), [&keys](std::uint32_t a, std::uint32_t b) {
        return keys[a] < keys[b] || (!(keys[b] < keys[a]) && a < b);
    });
    double agreement = 0.0;
    const double middle = 0.5 * static_cast<double>(keys.size() - 1);
    for (std::size_t i = 0; i < order.size(); ++i)
        agreement += (static_cast<double>(i) - middle) * (static_cast<double>(order[i]) - middle);
    if (agreement < 0.0) std::reverse(order.begin(), order.end());
    return order;
}

/// Length of an arc with this chord whose tangents turn by this angle, exact for a circle.
double arcLength(const Station& from, const Station& to) {
    const double chord = (to.position - from.position).norm();
    const double half_turn = 0.5 * std::atan2(from.tangent.cross(to.tangent).norm(), from.tangent.dot(to.tangent));
    if (half_turn < 1e-6 || half_turn > 0.25 * std::numbers::pi) return chord;
    return chord * half_turn / std::sin(half_turn);
}

std::vector<Station> stationsOf(const SectionResult& section, const std::vector<std::uint32_t>& members,
                                std::span<const PointDeviation> deviations, const geometry::NominalShape& nominal) {
    std::vector<Vector3> positions;
    std::vector<Vector3> normals;
    for (const std::uint32_t i : members) {
        positions.push_back(deviations[i].nominal);
        normals.push_back(deviations[i].normal);
    }
    if (section.axis)
        return stationsIn(*section.axis, section.position_mm, std::move(positions), std::move(normals), nominal);
    std::vector<Station> out;
    for (const Vector3& position : positions) out.push_back({position, Vector3::Zero()});
    return out;
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
    const auto stations = stationsOf(section, members, deviations, nominal);
    std::vector<std::uint32_t> order(members.size());
    std::iota(order.begin(), order.end(), 0U);
    if (section.axis) order = ordered(orderKeys(stations, *section.axis));
    double arc_mm = 0.0;
    std::vector<double> values;
    const Station* last = nullptr;
    for (const std::uint32_t k : order) {
        if (last != nullptr) arc_mm += arcLength(*last, stations[k]);
        last = &stations[k];
        section.points.push_back(members[k]);
        section.arc_length_mm.push_back(arc_mm);
        values.push_back(deviations[members[k]].deviation_mm);
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
