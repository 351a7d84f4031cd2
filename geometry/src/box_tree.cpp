// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Halved at the median of the centres along the longest side, so that the depth is the logarithm of the count.
#include "box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace cusp::geometry::detail {

BoxTree::BoxTree(std::span<const Eigen::AlignedBox3d> boxes) {
    if (boxes.empty()) return;
    std::vector<std::uint32_t> order(boxes.size());
    std::iota(order.begin(), order.end(), 0U);
    nodes_.reserve(2 * boxes.size());
    build(boxes, order);
}

std::uint32_t BoxTree::build(std::span<const Eigen::AlignedBox3d> boxes, std::span<std::uint32_t> order) {
    Eigen::AlignedBox3d box;
    Eigen::AlignedBox3d centers;
    for (const std::uint32_t index : order) {
        box.extend(boxes[index]);
        centers.extend(boxes[index].center());
    }
    const auto self = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{box.min().x(), box.min().y(), box.min().z()},
                      {box.max().x(), box.max().y(), box.max().z()},
                      0,
                      order.front()});
    if (order.size() == 1) return self;
    Eigen::Index axis = 0;
    centers.sizes().maxCoeff(&axis);
    const std::size_t half = order.size() / 2;
    std::nth_element(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(half), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                         const double x = boxes[a].center()[axis];
                         const double y = boxes[b].center()[axis];
                         return x != y ? x < y : a < b;
                     });
    build(boxes, order.first(half));
    const std::uint32_t second = build(boxes, order.subspan(half));
    nodes_[self].second = second;
    return self;
}

}  // namespace cusp::geometry::detail
