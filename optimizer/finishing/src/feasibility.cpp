// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The largest principal curvature of the part decides which cutters and leads can finish it.
#include <cusp/base/units.hpp>
#include <cusp/optimizer/finishing/feasibility.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <vector>

namespace cusp::finishing {

namespace {

constexpr std::size_t looks_per_patch = 16;
constexpr std::size_t most_looks = 257;

std::vector<double> looksOf(const std::vector<double>& breaks) {
    const std::size_t count = std::min(most_looks, (breaks.size() - 1) * looks_per_patch + 1);
    std::vector<double> out;
    for (std::size_t i = 0; i < count; ++i)
        out.push_back(
            std::lerp(breaks.front(), breaks.back(), static_cast<double>(i) / static_cast<double>(count - 1)));
    return out;
}

bool isOnShape(const Workpiece& part, const Vector3& point) {
    constexpr double on_mm = 1e-6;
    if (part.shape == nullptr || part.shape->trimmedFaces() == 0) return true;
    return std::abs(part.shape->closest(point).distance_mm) <= on_mm;
}

std::string placeText(const Vector3& at) { return fmt::format("X{:.2f} Y{:.2f} Z{:.2f}", at.x(), at.y(), at.z()); }

}  // namespace

HollowPlace mostHollow(const Workpiece& part) {
    HollowPlace out;
    out.curvature_per_mm = -std::numeric_limits<double>::infinity();
    for (const geometry::SurfaceFace& face : part.faces)
        for (const double u : looksOf(face.breaksU()))
            for (const double v : looksOf(face.breaksV())) {
                const auto point = face.evaluate(u, v);
                const Vector3 normal = face.outwardSign() * geometry::crossNormal(point);
                if (normal.squaredNorm() < 0.5) continue;
                const double bend = geometry::principalCurvatures(point, normal).largest;
                if (bend > out.curvature_per_mm && isOnShape(part, point.position)) out = {bend, point.position};
            }
    return out;
}

base::Diagnostics checkFeasible(const Workpiece& part, const geometry::Cutter& cutter,
                                const OrientationOptions& orientation) {
    base::Diagnostics report;
    const HollowPlace hollow = mostHollow(part);
    const double radius = cutter.diameter_mm / 2.0;
    const double corner = cutter.corner_radius_mm;
    const double bend = hollow.curvature_per_mm;
    const bool upright = !orientation.adaptive && orientation.lead_rad == 0.0 && orientation.tilt_rad == 0.0;
    if (upright && corner == 0.0)
        report.error(
            "finishing.lead-zero",
            fmt::format("a flat cutter at lead 0 and tilt 0 touches with its whole bottom and cuts in with its rim; "
                        "lead_deg above 0, or adaptive = true, is needed{}",
                        bend > 0.0 && matchedLead(cutter, bend)
                            ? fmt::format(": {:.3f}° clears the most hollow place of this surface",
                                          base::degFromRad(*matchedLead(cutter, bend)))
                            : std::string()));
    if (bend <= 0.0) return report;
    if (corner > 0.0 && corner * bend >= 1.0) {
        const bool ball = cutter.corner_e_mm <= 0.0;
        report.error(
            "finishing.offset",
            fmt::format("{} of {:g} mm is larger than the smallest radius of the surface, {:.3f} mm at {}: its offset "
                        "crosses itself there; a {} below {:.3f} mm is needed",
                        ball ? "a ball radius" : "a corner radius", corner, 1.0 / bend, placeText(hollow.position),
                        ball ? "ball diameter" : "corner radius", (ball ? 2.0 : 1.0) / bend));
        return report;
    }
    if (cutter.corner_e_mm <= 0.0) return report;
    const auto needed = matchedLead(cutter, bend);
    if (!needed) {
        report.error(
            "finishing.offset",
            fmt::format("a cutter of {:g} mm radius does not fit into the smallest radius of the surface, {:.3f} mm at "
                        "{}, at any lead; a smaller cutter is needed",
                        radius, 1.0 / bend, placeText(hollow.position)));
    } else if (orientation.adaptive && *needed > orientation.lead_max_rad) {
        report.warning(
            "finishing.lead-max",
            fmt::format("at {} the surface has a radius of {:.3f} mm and wants a lead of {:.3f}°, more than "
                        "lead_max_deg allows ({:.3f}°): the cutter cuts in there; a larger lead_max_deg or a smaller "
                        "cutter does not",
                        placeText(hollow.position), 1.0 / bend, base::degFromRad(*needed),
                        base::degFromRad(orientation.lead_max_rad)));
    } else if (!orientation.adaptive && orientation.lead_rad < *needed) {
        report.warning(
            "finishing.lead-low",
            fmt::format("at {} the surface has a radius of {:.3f} mm: with a lead of {:.3f}° the cutter is flatter "
                        "and may cut in; a lead of {:.3f}°, or adaptive = true, does not",
                        placeText(hollow.position), 1.0 / bend, base::degFromRad(orientation.lead_rad),
                        base::degFromRad(*needed)));
    }
    return report;
}

}  // namespace cusp::finishing
