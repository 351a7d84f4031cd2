// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Boxes over runs of sweeps, to find those that come near a box, in their order.
#pragma once

#include "body_sweep.hpp"

#include <cstddef>
#include <vector>

namespace cusp::simulation {

class SweepTree {
public:
    explicit SweepTree(const std::vector<BodySweep>& sweeps) : sweeps_(sweeps) {
        nodes_.reserve(2 * sweeps.size());
        if (!sweeps.empty()) build(0, sweeps.size());
    }

    /// Calls `visit(sweep)` for every sweep whose box meets `box`, in their order.
    template <class Visit>
    void meet(const Eigen::AlignedBox3d& box, const Visit& visit) const {
        for (std::size_t i = 0; i < nodes_.size();) {
            const Node& node = nodes_[i];
            if (!node.box.intersects(box)) {
                i = node.past;
                continue;
            }
            if (node.past == i + 1) visit(sweeps_[node.first]);
            ++i;
        }
    }

private:
    /// In preorder: the first child is the next node, what comes after the run is `past`; a leaf has no child.
    struct Node {
        Eigen::AlignedBox3d box;
        std::size_t first = 0;
        std::size_t past = 0;
    };

    Eigen::AlignedBox3d build(std::size_t first, std::size_t end) {
        const std::size_t at = nodes_.size();
        nodes_.push_back({sweeps_[first].box(), first, 0});
        if (end - first > 1) {
            const std::size_t middle = (first + end) / 2;
            const Eigen::AlignedBox3d left = build(first, middle);
            nodes_[at].box = left.merged(build(middle, end));
        }
        nodes_[at].past = nodes_.size();
        return nodes_[at].box;
    }

    const std::vector<BodySweep>& sweeps_;
    std::vector<Node> nodes_;
};

}  // namespace cusp::simulation
