// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What is wrong with a job before it is planned: cutter, angles and surface held against each other.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/optimizer/finishing/contact_path.hpp>

namespace cusp::finishing {

/// How hollow the part is, looked at on a grid.
struct HollowPlace {
    double curvature_per_mm = 0.0;  ///< the largest principal curvature; ≤ 0 where the part is convex everywhere
    Vector3 position = Vector3::Zero();
};
[[nodiscard]] HollowPlace mostHollow(const Workpiece& part);

/// Errors, each with the figures and what to change:
/// `finishing.lead-zero`: a flat cutter that stands on the normal touches with its whole bottom, and with its rim in a hollow;
/// `finishing.offset`: the corner (or the ball) is rounder than the surface is hollow: no place of the tool touches there
/// without cutting in, the offset surface crosses itself;
/// Warnings: `finishing.lead-low`: with this constant lead the cutter is flatter than the surface is hollow and cuts in
/// (the lead that would not, by eq. 4); `finishing.lead-max`: no lead up to the one allowed is enough.
[[nodiscard]] base::Diagnostics checkFeasible(const Workpiece& part, const geometry::Cutter& cutter,
                                              const OrientationOptions& orientation);

}  // namespace cusp::finishing
