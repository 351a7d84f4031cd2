// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where a block lies on the CL move it runs along, and how far it strays from it between its ends.
#pragma once

#include "expected_path.hpp"

#include <cusp/post/reader/executed_program.hpp>
#include <cusp/post/reader/forward_chain.hpp>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cusp::post::verify {

struct Tolerance {
    double tip_mm = 0.0;
    double axis_rad = 0.0;
};

struct PoseError {
    double tip_mm = 0.0;
    double axis_rad = 0.0;
    [[nodiscard]] bool within(const Tolerance& tolerance) const {
        return tip_mm <= tolerance.tip_mm && axis_rad <= tolerance.axis_rad;
    }
};

[[nodiscard]] PoseError difference(const reader::ToolPose& a, const reader::ToolPose& b);

/// The move of a CL file between two of its points: the tip straight or on an arc, the axis on the great circle.
struct ExpectedMove {
    reader::ToolPose from;
    reader::ToolPose to;
    const ExpectedArc* arc = nullptr;

    /// Where `pose` lies on the move, 0 to 1, when tip and axis both lie on it within tolerance, and at one place of it.
    [[nodiscard]] std::optional<double> fractionOf(const reader::ToolPose& pose, const Tolerance& tolerance) const;
};

/// Whole steps, at least one; `most` where more are wanted, or no number.
[[nodiscard]] inline int stepsFor(double wanted, int most) {
    return wanted < most ? std::max(1, static_cast<int>(std::ceil(wanted))) : most;
}

/// Largest departures from `move` of a block that runs from fraction `from` to fraction `to` of it, its ends included,
/// sampled as the control interpolates and so densely that no more than 0.05 µm and 0.0006° can go unseen. The tip is held
/// against the line, or against the arc at the same fraction; the axis against the great circle at the same fraction.
[[nodiscard]] PoseError strayBetween(const reader::ExecutedMotion& motion, const reader::ForwardChain& chain,
                                     const ExpectedMove& move, double from, double to);

}  // namespace cusp::post::verify
