// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Stocks, tools and a witness that tests of the milling simulation are made of.
#pragma once

#include "envelope_scenes.hpp"

#include <cusp/simulation/milling.hpp>

#include <vector>

namespace cusp::test_support {

[[nodiscard]] Eigen::AlignedBox3d boxOf(double x0, double y0, double z0, double x1, double y1, double z1);
/// A failure fails the test and gives an empty stock.
[[nodiscard]] simulation::Stock blockOf(const Eigen::AlignedBox3d& box, double resolution_mm);
[[nodiscard]] simulation::ToolAssembly cutterOnly(const geometry::Cutter& cutter);
/// Mills with one assembly; a failure fails the test.
simulation::MillingReport millWith(simulation::Stock& stock, const std::vector<simulation::ToolMove>& moves,
                                   const simulation::ToolAssembly& assembly,
                                   const simulation::MillingOptions& options = {});
/// The same move in `parts`, of unequal length.
[[nodiscard]] std::vector<simulation::ToolMove> cutUp(const simulation::ToolMove& move, int parts);
/// Pose at a time 0 … 1 of a move: tip on the line, axis on the great circle.
[[nodiscard]] toolpath::CutterLocation poseAt(const simulation::ToolMove& move, double time);
/// Signed distance to a toroidal, ball or flat cutter, written apart from CutterBody; exact outside, negative inside.
[[nodiscard]] double toroidDistance(const geometry::Cutter& cutter, const toolpath::CutterLocation& at,
                                    const geometry::Vector3& x);
/// The least of it over the time of a move: dense samples, then a search around the best of them.
[[nodiscard]] double sweptDistance(const geometry::Cutter& cutter, const simulation::ToolMove& move,
                                   const geometry::Vector3& x);

}  // namespace cusp::test_support
