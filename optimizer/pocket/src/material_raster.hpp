// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Material on a raster: quick to clear and to look at, for choosing steps; measured paths are judged without it.
#pragma once

#include <cusp/optimizer/pocket/pocket_area.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cusp::pocket {

class MaterialRaster {
public:
    MaterialRaster(const PocketArea& area, double cell_mm);

    /// Clears what a tool sweeps on its way from a to b.
    void sweep(const Point& a, const Point& b);
    void sweepRing(const Point& centre, double ring_radius_mm);
    /// Whether nothing is left under a tool on its way from a to b, but for what lies within `rim_cells` cells of its rim.
    [[nodiscard]] bool isClear(const Point& a, const Point& b, double rim_cells) const;
    /// Cells a tool would clear on its way from a to b.
    [[nodiscard]] std::size_t removal(const Point& a, const Point& b) const;
    /// The largest engagement on the way from a to b, in degrees.
    [[nodiscard]] double engagementDeg(const Point& a, const Point& b) const;

private:
    [[nodiscard]] bool at(double x_mm, double y_mm) const {
        const auto c = static_cast<std::ptrdiff_t>((x_mm - low_.x_mm) * inverse_);
        const auto r = static_cast<std::ptrdiff_t>((y_mm - low_.y_mm) * inverse_);
        if (x_mm < low_.x_mm || y_mm < low_.y_mm || c >= columns_ || r >= rows_) return false;
        return cells_[static_cast<std::size_t>(r * columns_ + c)] != 0;
    }
    template <class Visit>
    void forCells(const Point& a, const Point& b, double radius_mm, const Visit& visit) const;

    Point low_;
    double cell_mm_;
    double inverse_;
    double radius_mm_;
    std::ptrdiff_t columns_ = 0;
    std::ptrdiff_t rows_ = 0;
    std::vector<std::uint8_t> cells_;
};

}  // namespace cusp::pocket
