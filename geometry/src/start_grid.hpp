// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A coarse grid of cubes that names a cell to start from, at the price of one look-up.
#pragma once

#include "patch_cells.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cusp::geometry::detail {

class StartGrid {
public:
    static constexpr std::uint32_t none = 0xffffffff;

    StartGrid() = default;
    explicit StartGrid(std::span<const PatchCell> cells);

    /// The cell nearest to the middle of the cube the point lies in; `none` far from all cells.
    [[nodiscard]] std::uint32_t cellNear(const Vector3& point) const {
        const Vector3 scaled = (point - low_) * per_mm_;
        // Also false for what is no number.
        if (!(scaled.x() >= 0.0 && scaled.y() >= 0.0 && scaled.z() >= 0.0 && scaled.x() < limits_.x() &&
              scaled.y() < limits_.y() && scaled.z() < limits_.z())) {
            return none;
        }
        return cells_[indexOf(static_cast<std::size_t>(scaled.x()), static_cast<std::size_t>(scaled.y()),
                              static_cast<std::size_t>(scaled.z()))];
    }

private:
    [[nodiscard]] std::size_t indexOf(std::size_t x, std::size_t y, std::size_t z) const {
        return (x * counts_[1] + y) * counts_[2] + z;
    }
    void enter(std::span<const PatchCell> cells, std::uint32_t cell, std::vector<double>& nearest);

    Vector3 low_ = Vector3::Zero();
    Vector3 limits_ = Vector3::Zero();
    double per_mm_ = 0.0;
    std::array<std::size_t, 3> counts_{};
    std::vector<std::uint32_t> cells_;
};

}  // namespace cusp::geometry::detail
