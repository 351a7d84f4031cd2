// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cutting speed and a proxy for the force where the ball touches the part.
#include <cusp/optimizer/tilt/tilt_case.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cusp::tilt {

using geometry::Vector3;

ContactReport contactReport(const geometry::NominalShape& shape, const StartPath& path,
                            const std::vector<toolpath::CutterLocation>& poses) {
    constexpr double contact_tolerance_mm = 0.05;
    constexpr double least_sine = 0.05;
    constexpr double kienzle_exponent = 0.25;
    constexpr double mm_per_m = 1000.0;
    const double radius = path.cutter.diameter_mm / 2.0;
    std::vector<Vector3> centers;
    std::vector<std::size_t> places;
    for (std::size_t i = 1; i < poses.size(); ++i) {
        if (path.locations[i].kind != toolpath::MotionKind::Feed) continue;
        centers.emplace_back(poses[i].tip_mm + radius * poses[i].axis);
        places.push_back(i);
    }
    std::vector<geometry::Footpoint> feet(centers.size());
    shape.closest(centers, feet, false);
    ContactReport out;
    out.speed_min_m_per_min = std::numeric_limits<double>::infinity();
    double length = 0.0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        const Vector3 away = centers[k] - feet[k].position;
        if (std::abs(away.norm() - radius) > contact_tolerance_mm) continue;
        const std::size_t i = places[k];
        const double sine = std::sin(geometry::angleBetween(away, poses[i].axis));
        const double speed = 2.0 * std::numbers::pi * path.spindle_rpm * radius * sine / mm_per_m;
        const double proxy = std::pow(std::max(sine, least_sine), -kienzle_exponent);
        const double way = (poses[i].tip_mm - poses[i - 1].tip_mm).norm();
        ++out.contacts;
        length += way;
        out.speed_min_m_per_min = std::min(out.speed_min_m_per_min, speed);
        out.speed_max_m_per_min = std::max(out.speed_max_m_per_min, speed);
        out.speed_mean_m_per_min += way * speed;
        out.force_proxy_mean += way * proxy;
        out.force_proxy_max = std::max(out.force_proxy_max, proxy);
    }
    if (out.contacts == 0) return {};
    if (length > 0.0) {
        out.speed_mean_m_per_min /= length;
        out.force_proxy_mean /= length;
    }
    return out;
}

}  // namespace cusp::tilt
