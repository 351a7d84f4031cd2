// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Eq. 1–4 of Fountas 2017 over the contacts of a path.
#include <cusp/optimizer/finishing/path_criteria.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cusp::finishing {

namespace {

Vector3 nearestOn(const Vector3& point, const Vector3& from, const Vector3& to) {
    const Vector3 chord = to - from;
    const double length = chord.squaredNorm();
    const double share = length > 0.0 ? std::clamp(chord.dot(point - from) / length, 0.0, 1.0) : 0.0;
    return from + share * chord;
}

/// Distance to another pass; infinite where its nearest place is one of its ends and lies ahead or behind.
double distanceTo(std::span<const CutContact> pass, const CutContact& from) {
    double best = std::numeric_limits<double>::infinity();
    Vector3 way = Vector3::Zero();
    for (std::size_t i = 0; i + 1 < pass.size(); ++i) {
        const Vector3 here = nearestOn(from.position, pass[i].position, pass[i + 1].position) - from.position;
        if (here.norm() >= best) continue;
        best = here.norm();
        way = here;
    }
    constexpr double beside = 0.5;  // cosine against the left: within 60°
    return std::abs(way.dot(from.frame.left)) > beside * best ? best : std::numeric_limits<double>::infinity();
}

}  // namespace

void Spread::take(double value) {
    least = count == 0 ? value : std::min(least, value);
    most = count == 0 ? value : std::max(most, value);
    ++count;
    mean += (value - mean) / static_cast<double>(count);
}

double chordError(const CutContact& from, const CutContact& to) {
    const Vector3 chord = to.position - from.position;
    const double length = chord.norm();
    const Vector3 sideways = chord.cross(from.frame.normal + to.frame.normal);
    if (!(length > 0.0) || !(sideways.norm() > 0.0)) return 0.0;
    const Vector3 across = sideways.normalized();
    const auto within = [&](const Vector3& normal) { return Vector3(normal - normal.dot(across) * across); };
    const double angle = geometry::angleBetween(within(from.frame.normal), within(to.frame.normal));
    const double half_sine = std::sin(angle / 2.0);
    if (half_sine <= 0.0) return 0.0;
    const double radius = length / (2.0 * half_sine);  // eq. 1, inverted
    // Eq. 3, in a form that keeps its digits where the radius is large.
    const double half = length / 2.0;
    return half * half / (radius + std::sqrt(std::max(0.0, radius * radius - half * half)));
}

PathCriteria judgeContacts(std::span<const CutContact> contacts, std::span<const geometry::Cutter> cutters,
                           double edge_radius_mm) {
    PathCriteria out;
    out.cc_points = contacts.size();
    std::vector<std::span<const CutContact>> passes;
    for (std::size_t first = 0; first < contacts.size();) {
        std::size_t last = first + 1;
        while (last < contacts.size() && contacts[last].pass == contacts[first].pass) ++last;
        passes.push_back(contacts.subspan(first, last - first));
        first = last;
    }
    out.passes = passes.size();
    for (std::size_t p = 0; p < passes.size(); ++p) {
        for (std::size_t i = 0; i < passes[p].size(); ++i) {
            const CutContact& here = passes[p][i];
            const geometry::Cutter& cutter = cutters[here.cutter];
            if (i > 0) {
                out.chord_error_mm.take(chordError(passes[p][i - 1], here));
                out.cutting_length_mm += (here.position - passes[p][i - 1].position).norm();
            }
            out.lead_rad.take(here.angles.lead_rad);
            out.tilt_rad.take(here.angles.tilt_rad);
            if (cutter.corner_radius_mm <= 0.0)
                out.undercut_edge_mm =
                    std::max(out.undercut_edge_mm, edgeUndercut(edge_radius_mm, here.angles.lead_rad));
            const double radius = effectiveRadius(cutter, here.angles.lead_rad, here.angles.tilt_rad);
            if (std::isfinite(radius))
                out.effective_radius_mm.take(radius);
            else
                ++out.singular_leads;
            if (p + 1 == passes.size()) continue;
            const double apart = distanceTo(passes[p + 1], here);
            if (!std::isfinite(apart)) continue;
            out.step_over_mm.take(apart);
            if (here.cross_curvature_per_mm && std::isfinite(radius))
                out.scallop_mm.take(scallopHeight(apart, radius, *here.cross_curvature_per_mm));
        }
    }
    return out;
}

}  // namespace cusp::finishing
