// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Which moves of a path can come near a ball: a tree over the moves in the order of the path, where neighbours lie together.
#pragma once

#include "move_entry.hpp"

#include <cstddef>
#include <vector>

namespace cusp::simulation {

class MoveIndex {
public:
    explicit MoveIndex(std::vector<SweptMove> moves);

    struct Near {
        SweptMove::Nearness nearness;  ///< at the centre of the ball
        std::size_t move = 0;
    };
    /// The moves that may touch the ball, the closest first; the order is the same every time.
    void near(const geometry::Vector3& center, double radius_mm, std::vector<Near>& out) const;

    [[nodiscard]] const SweptMove& operator[](std::size_t i) const { return moves_[i]; }

private:
    /// A run of moves of one cutter, in preorder: its first child is the next node, what comes after it is `past`.
    struct Node {
        SweptHull hull;
        std::size_t past = 0;
        std::size_t move = no_move;
    };
    static constexpr std::size_t no_move = static_cast<std::size_t>(-1);

    void build(std::size_t first, std::size_t last);

    std::vector<SweptMove> moves_;
    std::vector<Node> nodes_;
};

}  // namespace cusp::simulation
