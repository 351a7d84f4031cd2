// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A ball that comes down on any shape by steps its clearance proves free.
#include "drop_profile.hpp"

#include <cusp/optimizer/tilt/drop_cutter.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::tilt {

using geometry::Vector3;

base::Result<BallDrop> BallDrop::make(const geometry::NominalShape& shape, const geometry::Cutter& cutter) {
    if (auto profile = detail::DropProfile::make(cutter); !profile) return base::fail(profile.error());
    constexpr double rounding_mm = 1e-6;
    if (std::abs(cutter.corner_radius_mm - cutter.diameter_mm / 2.0) > rounding_mm || cutter.taper_angle_rad > 0.0)
        return base::fail("tilt.not-a-ball",
                          "on a surface without triangles only a ball end mill can be dropped; give the part as a mesh "
                          "(STL or PLY) for other cutters");
    return BallDrop(shape, cutter);
}

std::optional<DropContact> BallDrop::drop(double x_mm, double y_mm, std::uint32_t /*hint*/) const {
    const Eigen::AlignedBox3d box = shape_->bounds();
    const double r = cutter_.corner_radius_mm;
    const double dx = std::max({box.min().x() - x_mm, x_mm - box.max().x(), 0.0});
    const double dy = std::max({box.min().y() - y_mm, y_mm - box.max().y(), 0.0});
    if (dx * dx + dy * dy > r * r) return std::nullopt;
    constexpr double clearance_left_mm = 1e-7;
    constexpr int most_steps = 2000;
    Vector3 center(x_mm, y_mm, box.max().z() + r);
    // A step of exactly the clearance is always free. Steps of `reach` times as much are taken as long as the next clearance
    // covers the gap they leave, and taken back otherwise (over-relaxed sphere tracing, Keinert et al. 2014).
    constexpr double reach_most = 1.8;
    double reach = reach_most;
    double step = 0.0;
    double clearance_before = 0.0;
    for (int i = 0; i < most_steps; ++i) {
        const geometry::Footpoint foot = shape_->closest(center);
        const double clearance = std::abs(foot.distance_mm) - r;
        if (step > clearance_before && clearance < step - clearance_before) {
            center.z() += step - clearance_before;
            step = clearance_before;
            reach = 1.0;
            continue;
        }
        if (center.z() < box.min().z() - r) return std::nullopt;
        if (clearance <= clearance_left_mm || i + 1 == most_steps)
            return DropContact{center.z() - r, foot.position, static_cast<std::uint32_t>(foot.face)};
        clearance_before = clearance;
        step = reach * clearance;
        reach = reach_most;
        center.z() -= step;
    }
    return std::nullopt;
}

}  // namespace cusp::tilt
