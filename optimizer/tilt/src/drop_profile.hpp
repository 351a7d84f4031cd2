// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The lower side of an upright turned cutter, and where it first meets a plane or a line it comes down on.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/cutter.hpp>

#include <cmath>

namespace cusp::tilt::detail {

/// Height of the cutter's lower side above the tip at a distance rho from the axis: bottom (flat or conical), corner arc,
/// flank where it is tapered. Convex and growing on [0, radius]; beyond the radius there is no cutter. Lengths in mm.
class DropProfile {
public:
    /// Errors: `simulation.cutter` when the seven values describe no convex cutter.
    [[nodiscard]] static base::Result<DropProfile> make(const geometry::Cutter& cutter);

    [[nodiscard]] double radius() const { return radius_; }

    [[nodiscard]] double height(double rho) const {
        if (rho <= bottom_end_) return rho * bottom_tan_;
        if (rho <= corner_end_) {
            const double x = rho - corner_rho_;
            const double left = corner_radius_ * corner_radius_ - x * x;
            return corner_z_ - (left > 0.0 ? std::sqrt(left) : 0.0);
        }
        return corner_end_height_ + (rho - corner_end_) * flank_cot_;
    }

    /// Distance from the axis at which a plane of this slope is met: `across` and `up` are the parts of its unit normal.
    [[nodiscard]] double planeContact(double across, double up) const {
        if (across <= up * bottom_tan_) return 0.0;
        if (!flank_is_upright_ && across > up * flank_cot_) return radius_;
        return corner_rho_ + corner_radius_ * across;
    }

    /// A line passes the axis at the distance `aside` ≤ radius and rises by `slope` ≥ 0 a mm. The way s along it, from where
    /// it is nearest to the axis, at which slope · s − height(√(aside² + s²)) is largest.
    [[nodiscard]] double lineContact(double aside, double slope) const;

private:
    DropProfile() = default;
    [[nodiscard]] double cornerContact(double aside, double slope, double least) const;

    double bottom_tan_ = 0.0;
    double bottom_end_ = 0.0;  ///< distance from the axis where the corner begins
    double corner_rho_ = 0.0;
    double corner_z_ = 0.0;
    double corner_radius_ = 0.0;
    double corner_end_ = 0.0;
    double corner_end_height_ = 0.0;
    double flank_cot_ = 0.0;
    double flank_angle_ = 0.0;  ///< of the flank against the axis
    double bottom_angle_ = 0.0;
    bool flank_is_upright_ = true;
    double radius_ = 0.0;
};

}  // namespace cusp::tilt::detail
