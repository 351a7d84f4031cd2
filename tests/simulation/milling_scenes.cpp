// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Stocks, tools and a witness that tests of the milling simulation are made of.
#include "milling_scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace cusp::test_support {

using geometry::Vector3;
using namespace cusp::simulation;

Eigen::AlignedBox3d boxOf(double x0, double y0, double z0, double x1, double y1, double z1) {
    return {Vector3(x0, y0, z0), Vector3(x1, y1, z1)};
}

Stock blockOf(const Eigen::AlignedBox3d& box, double resolution_mm) {
    auto stock = Stock::box(box, {resolution_mm, std::uint64_t{2} << 30U});
    if (!stock) ADD_FAILURE() << stock.error().front().message;
    return stock ? *std::move(stock) : Stock::box(boxOf(0, 0, 0, 1, 1, 1), {1.0, std::uint64_t{1} << 30U}).value();
}

ToolAssembly cutterOnly(const geometry::Cutter& cutter) { return assemblyOf(cutter).value(); }

MillingReport millWith(Stock& stock, const std::vector<ToolMove>& moves, const ToolAssembly& assembly,
                       const MillingOptions& options) {
    auto report = mill(stock, moves, std::span(&assembly, 1), options);
    EXPECT_TRUE(report.has_value());
    return report ? *std::move(report) : MillingReport{};
}

std::vector<ToolMove> cutUp(const ToolMove& move, int parts) {
    std::vector<ToolMove> out;
    double from = 0.0;
    for (int i = 0; i < parts; ++i) {
        const double to = i + 1 == parts ? 1.0 : std::pow(static_cast<double>(i + 1) / parts, 1.3);
        ToolMove part = move;
        part.from = poseAt(move, from);
        part.to = poseAt(move, to);
        out.push_back(part);
        from = to;
    }
    return out;
}

toolpath::CutterLocation poseAt(const ToolMove& move, double time) {
    const Vector3 tip = move.from.tip_mm + time * (move.to.tip_mm - move.from.tip_mm);
    const double turn = std::acos(std::clamp(move.from.axis.dot(move.to.axis), -1.0, 1.0));
    if (turn < 1e-7) return {tip, move.from.axis};
    const Vector3 axis = std::sin((1.0 - time) * turn) * move.from.axis + std::sin(time * turn) * move.to.axis;
    return {tip, axis / std::sin(turn)};
}

double toroidDistance(const geometry::Cutter& cutter, const toolpath::CutterLocation& at, const Vector3& x) {
    const Vector3 w = x - at.tip_mm;
    const double z = w.dot(at.axis);
    const double rho = (w - z * at.axis).norm();
    const double e = cutter.corner_e_mm;
    const double r = cutter.corner_radius_mm;
    const double top = z - cutter.cutting_height_mm;
    double below = 0.0;
    if (z >= r)
        below = rho - cutter.diameter_mm / 2.0;
    else if (rho <= e)
        below = -z;
    else
        below = std::hypot(rho - e, z - r) - r;
    if (z >= r && rho <= e) below = std::max(rho - cutter.diameter_mm / 2.0, -z);
    return std::max(below, top);
}

double sweptDistance(const geometry::Cutter& cutter, const ToolMove& move, const Vector3& x) {
    constexpr int samples = 200;
    const auto at = [&](double time) { return toroidDistance(cutter, poseAt(move, time), x); };
    double best = 1e300;
    double best_time = 0.0;
    for (int i = 0; i <= samples; ++i)
        if (const double value = at(static_cast<double>(i) / samples); value < best) {
            best = value;
            best_time = static_cast<double>(i) / samples;
        }
    double low = std::max(0.0, best_time - 1.0 / samples);
    double high = std::min(1.0, best_time + 1.0 / samples);
    for (int i = 0; i < 40; ++i) {
        const double a = low + (high - low) / 3.0;
        const double b = high - (high - low) / 3.0;
        (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
    }
    return std::min(best, at(0.5 * (low + high)));
}

}  // namespace cusp::test_support
