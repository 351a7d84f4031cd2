// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Builds the tree and walks it.
#include "move_index.hpp"

#include <algorithm>
#include <utility>

namespace cusp::simulation {

MoveIndex::MoveIndex(std::vector<SweptMove> moves) : moves_(std::move(moves)) {
    nodes_.reserve(2 * moves_.size());
    for (std::size_t first = 0; first < moves_.size();) {
        std::size_t last = first + 1;
        while (last < moves_.size() && &moves_[last].body() == &moves_[first].body()) ++last;
        build(first, last);
        first = last;
    }
}

void MoveIndex::build(std::size_t first, std::size_t last) {
    const std::size_t at = nodes_.size();
    nodes_.emplace_back();
    nodes_[at].hull = SweptHull(moves_[(first + last) / 2].hull());
    for (std::size_t i = first; i < last; ++i) nodes_[at].hull.extend(moves_[i].hull());
    if (last - first == 1) {
        nodes_[at].move = first;
    } else {
        const std::size_t middle = (first + last) / 2;
        build(first, middle);
        build(middle, last);
    }
    nodes_[at].past = nodes_.size();
}

void MoveIndex::near(const geometry::Vector3& center, double radius_mm, std::vector<Near>& out) const {
    out.clear();
    for (std::size_t i = 0; i < nodes_.size();) {
        const Node& node = nodes_[i];
        const double clearance = node.hull.clearance(center) - radius_mm;
        if (clearance > 0.0) {
            i = node.past;
            continue;
        }
        if (node.move != no_move) {
            const SweptMove::Nearness nearness = moves_[node.move].nearness(center, radius_mm);
            if (nearness.distance_mm - (1.0 + nearness.bend) * radius_mm <= 0.0) out.push_back({nearness, node.move});
        }
        ++i;
    }
    std::sort(out.begin(), out.end(), [](const Near& a, const Near& b) {
        return std::pair(a.nearness.distance_mm, a.move) < std::pair(b.nearness.distance_mm, b.move);
    });
}

}  // namespace cusp::simulation
