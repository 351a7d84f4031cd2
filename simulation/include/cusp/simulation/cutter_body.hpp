// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The body a milling cutter sweeps when it turns, as a convex distance function in its own half-plane.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/cutter.hpp>

#include <cmath>

namespace cusp::simulation {

/// A turned cutter: bottom (flat or conical), corner arc, flank (cylindrical or tapered), top at the cutting height.
/// Coordinates: `rho_mm` from the tool axis (≥ 0), `z_mm` above the tip along the axis.
///
/// Outside the body the value is the distance to it, except beyond the rim of the top, where it is less; inside it is
/// negative. It is convex in space and grows with rho, so that along any straight line Newton's method started before the
/// body arrives at the first point of entry and nowhere else.
class CutterBody {
public:
    struct Value {
        double distance_mm = 0.0;
        double by_rho = 0.0;  ///< derivative by rho
        double by_z = 0.0;    ///< derivative by z
    };

    /// Errors: `simulation.cutter` when the seven values describe no convex cutter whose parts meet smoothly.
    [[nodiscard]] static base::Result<CutterBody> make(const geometry::Cutter& cutter);
    /// A cone's frustum or a cylinder, `from_mm` to `to_mm` above the tip: what shanks, holders and heads are stacked of.
    /// Errors: `simulation.part` when it has no height or no width.
    [[nodiscard]] static base::Result<CutterBody> frustum(double from_mm, double from_diameter_mm, double to_mm,
                                                          double to_diameter_mm);

    [[nodiscard]] Value at(double rho_mm, double z_mm) const {
        const double x = rho_mm - corner_rho_mm_;
        const double z = z_mm - corner_z_mm_;
        Value value;
        if (x * bottom_cos_ + z * bottom_sin_ > 0.0 && x * flank_sin_ + z * flank_cos_ < 0.0) {
            const double away = std::sqrt(x * x + z * z);
            value = {away - corner_radius_mm_, x / away, z / away};
        } else {
            const double below = x * bottom_sin_ - z * bottom_cos_;
            const double beside = x * flank_cos_ - z * flank_sin_;
            value = below >= beside ? Value{below - corner_radius_mm_, bottom_sin_, -bottom_cos_}
                                    : Value{beside - corner_radius_mm_, flank_cos_, -flank_sin_};
        }
        const double above = z_mm - height_mm_;
        return above > value.distance_mm ? Value{above, 0.0, 1.0} : value;
    }

    /// Of the whole body; the farthest any of its points is from the axis.
    [[nodiscard]] double largestRadius() const { return largest_radius_mm_; }
    [[nodiscard]] double height() const { return height_mm_; }
    /// Of the lowest point above the tip: 0 for cutters.
    [[nodiscard]] double base() const { return base_mm_; }
    /// Of the ball that the body ends in, centred as high above the tip; 0 where it ends in none.
    [[nodiscard]] double ballRadius() const {
        const bool ball = corner_rho_mm_ == 0.0 && bottom_sin_ == 0.0 && flank_sin_ == 0.0;
        return ball ? corner_radius_mm_ : 0.0;
    }

private:
    CutterBody() = default;

    double corner_rho_mm_ = 0.0;  ///< centre of the corner arc
    double corner_z_mm_ = 0.0;
    double corner_radius_mm_ = 0.0;
    double bottom_sin_ = 0.0;
    double bottom_cos_ = 1.0;
    double flank_sin_ = 0.0;
    double flank_cos_ = 1.0;
    double height_mm_ = 0.0;
    double base_mm_ = 0.0;
    double largest_radius_mm_ = 0.0;
};

}  // namespace cusp::simulation
