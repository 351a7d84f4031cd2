// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A bounding hierarchy of axis-parallel boxes: which of many things may be nearest to a point?
#pragma once

#include <cusp/geometry/frames.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cusp::geometry::detail {

/// A binary tree over boxes, built once. The tree knows the boxes by their index.
class BoxTree {
public:
    BoxTree() = default;
    explicit BoxTree(std::span<const Eigen::AlignedBox3d> boxes);

    /// Calls `visit(index)` for the boxes that are not farther from `place` (a point or a box) than `limit()` says, near ones
    /// first. `limit` returns a squared distance and may shrink from one call to the next.
    template <class Place, class Limit, class Visit>
    void visitNear(const Place& place, Limit limit, Visit visit) const {
        if (nodes_.empty()) return;
        std::array<Pending, most_depth> stack;
        std::size_t open = 0;
        Pending here{0, 0.0};
        while (true) {
            const Node& node = nodes_[here.node];
            if (node.second != 0) {
                Pending near{here.node + 1, squaredDistance(nodes_[here.node + 1], place)};
                Pending far{node.second, squaredDistance(nodes_[node.second], place)};
                if (far.squared < near.squared) std::swap(near, far);
                const double most = limit();
                if (far.squared <= most) stack[open++] = far;
                if (near.squared <= most) {
                    here = near;
                    continue;
                }
            } else {
                visit(node.box_index);
            }
            do {
                if (open == 0) return;
                here = stack[--open];
            } while (here.squared > limit());
        }
    }

private:
    // The tree is built balanced: 2^48 boxes would be needed to go deeper.
    static constexpr std::size_t most_depth = 64;

    struct Node {
        std::array<double, 3> low;
        std::array<double, 3> high;
        std::uint32_t second = 0;  ///< the first child is the next node; 0 in a leaf
        std::uint32_t box_index = 0;
    };
    struct Pending {
        std::uint32_t node;
        double squared;
    };

    static double squaredDistance(const Node& node, const Vector3& point) {
        double squared = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const double x = point[static_cast<Eigen::Index>(k)];
            const double below = node.low[k] - x;
            const double above = x - node.high[k];
            const double outside = below > above ? below : above;
            squared += outside > 0.0 ? outside * outside : 0.0;
        }
        return squared;
    }

    static double squaredDistance(const Node& node, const Eigen::AlignedBox3d& box) {
        double squared = 0.0;
        for (std::size_t k = 0; k < 3; ++k) {
            const auto axis = static_cast<Eigen::Index>(k);
            const double outside = std::max({node.low[k] - box.max()[axis], box.min()[axis] - node.high[k], 0.0});
            squared += outside * outside;
        }
        return squared;
    }

    std::uint32_t build(std::span<const Eigen::AlignedBox3d> boxes, std::span<std::uint32_t> order);

    std::vector<Node> nodes_;
};

}  // namespace cusp::geometry::detail
