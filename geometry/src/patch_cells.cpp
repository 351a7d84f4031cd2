// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Halving a patch in the direction in which it bends more.
#include "patch_cells.hpp"

#include <utility>

namespace cusp::geometry::detail {
namespace {

/// Newton's method then starts within a few percent of the answer. Bounds of rational patches are wider than the truth.
constexpr double flat_enough = 0.1;
constexpr double flat_enough_rational = 0.15;
constexpr int most_halvings = 12;

Eigen::AlignedBox3d hullOf(const BezierPatch& patch) {
    Eigen::AlignedBox3d box;
    for (const BezierPatch::Vector4& point : patch.net()) box.extend(Vector3(point.head<3>() / point[3]));
    return box;
}

void cut(const BezierPatch& part, const ParameterBox& box, std::uint32_t index, int halvings,
         std::vector<PatchCell>& cells) {
    const PatchBounds bounds = boundPatch(part);
    const bool flat = bounds.bend_u + bounds.bend_v <= (part.isRational() ? flat_enough_rational : flat_enough);
    if (halvings == most_halvings || (flat && bounds.isConvexFor(bounds.center))) {
        cells.push_back({index, box, bounds, hullOf(part)});
        return;
    }
    // A flat piece that is not proved convex is too long; at a pole nothing is known but the lengths.
    const bool by_length = flat || bounds.bend_u == bounds.bend_v;
    const bool along_u = by_length ? bounds.length_u_mm >= bounds.length_v_mm : bounds.bend_u > bounds.bend_v;
    const auto [left, right] = along_u ? part.splitU() : part.splitV();
    ParameterBox first = box;
    ParameterBox second = box;
    (along_u ? first.high_u : first.high_v) = along_u ? box.middleU() : box.middleV();
    (along_u ? second.low_u : second.low_v) = along_u ? box.middleU() : box.middleV();
    cut(left, first, index, halvings + 1, cells);
    cut(right, second, index, halvings + 1, cells);
}

}  // namespace

void cutIntoCells(const BezierPatch& patch, std::uint32_t index, std::vector<PatchCell>& cells) {
    cut(patch, {}, index, 0, cells);
}

BezierPatch partOf(const BezierPatch& patch, const ParameterBox& box) {
    BezierPatch part = patch;
    ParameterBox covered;
    while (covered.low_u < box.low_u || covered.high_u > box.high_u) {
        auto [left, right] = part.splitU();
        const bool upper = box.low_u >= covered.middleU();
        (upper ? covered.low_u : covered.high_u) = covered.middleU();
        part = std::move(upper ? right : left);
    }
    while (covered.low_v < box.low_v || covered.high_v > box.high_v) {
        auto [left, right] = part.splitV();
        const bool upper = box.low_v >= covered.middleV();
        (upper ? covered.low_v : covered.high_v) = covered.middleV();
        part = std::move(upper ? right : left);
    }
    return part;
}

}  // namespace cusp::geometry::detail
