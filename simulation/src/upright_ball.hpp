// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What an upright ball end mill sweeps of eight neighbouring rays in one straight move: closed forms, eight at a time.
#pragma once

#include <array>
#include <cstddef>

namespace cusp::simulation {

/// A ball with a cylinder on it, at least a diameter long, whose axis points along one of the stock's axes, shifting from
/// `tip_mm` by `way_mm`. Its sweep is that of the ball and that of the cylinder from the ball's equator up, together.
///
/// Free of Eigen, so that it can be compiled for several processors (DESIGN: run-time dispatch); every one gives the same
/// bits, because only sums, products, quotients and roots occur, and nothing is contracted.
struct UprightBall {
    static constexpr std::size_t lanes = 8;
    using Row = std::array<double, lanes>;

    double radius_mm = 0.0;
    double height_mm = 0.0;
    std::array<double, 3> tip_mm{};
    std::array<double, 3> way_mm{};
    int axis = 2;  ///< of the stock, along which the tool axis points upwards

    /// Of rays along `ray_axis`, at `u_mm` of axis (ray_axis + 1) % 3 and `v_mm` of (ray_axis + 2) % 3: where the sweep begins
    /// and ends. Rays it misses begin after they end.
    void sweep(int ray_axis, double u_mm, const Row& v_mm, Row& from_mm, Row& to_mm) const;
};

}  // namespace cusp::simulation
