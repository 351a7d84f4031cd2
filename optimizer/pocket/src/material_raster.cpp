// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The raster of the material.
#include "material_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace cusp::pocket {
namespace {

constexpr std::size_t rim_samples = 180;  ///< all around; the front half has 90

struct Direction {
    double x = 0.0;
    double y = 0.0;
};

std::array<Direction, rim_samples> rimDirections() {
    std::array<Direction, rim_samples> out{};
    for (std::size_t i = 0; i < rim_samples; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / rim_samples;
        out[i] = {std::cos(angle), std::sin(angle)};
    }
    return out;
}

const std::array<Direction, rim_samples> rim = rimDirections();

}  // namespace

MaterialRaster::MaterialRaster(const PocketArea& area, double cell_mm)
    : cell_mm_(cell_mm), inverse_(1.0 / cell_mm), radius_mm_(area.radius_mm) {
    const Box box = boxOf(area.material);
    low_ = box.low;
    columns_ = static_cast<std::ptrdiff_t>(std::ceil((box.high.x_mm - low_.x_mm) / cell_mm)) + 1;
    rows_ = static_cast<std::ptrdiff_t>(std::ceil((box.high.y_mm - low_.y_mm) / cell_mm)) + 1;
    cells_.assign(static_cast<std::size_t>(columns_ * rows_), 0);
    const RegionIndex material(area.material);
    for (std::ptrdiff_t r = 0; r < rows_; ++r)
        for (std::ptrdiff_t c = 0; c < columns_; ++c)
            cells_[static_cast<std::size_t>(r * columns_ + c)] =
                material.contains({low_.x_mm + (static_cast<double>(c) + 0.5) * cell_mm,
                                   low_.y_mm + (static_cast<double>(r) + 0.5) * cell_mm});
}

/// Calls `visit` with the index of each cell whose middle is within `radius_mm` of the segment, until it answers false.
template <class Visit>
void MaterialRaster::forCells(const Point& a, const Point& b, double radius_mm, const Visit& visit) const {
    const auto clampTo = [](double value, std::ptrdiff_t end) {
        return std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(std::floor(value)), 0, end - 1);
    };
    const auto [x0, x1] = std::minmax(a.x_mm, b.x_mm);
    const auto [y0, y1] = std::minmax(a.y_mm, b.y_mm);
    const std::ptrdiff_t c0 = clampTo((x0 - radius_mm - low_.x_mm) * inverse_, columns_);
    const std::ptrdiff_t c1 = clampTo((x1 + radius_mm - low_.x_mm) * inverse_, columns_);
    const std::ptrdiff_t r0 = clampTo((y0 - radius_mm - low_.y_mm) * inverse_, rows_);
    const std::ptrdiff_t r1 = clampTo((y1 + radius_mm - low_.y_mm) * inverse_, rows_);
    for (std::ptrdiff_t r = r0; r <= r1; ++r)
        for (std::ptrdiff_t c = c0; c <= c1; ++c) {
            const auto index = static_cast<std::size_t>(r * columns_ + c);
            if (cells_[index] == 0) continue;
            const Point middle{low_.x_mm + (static_cast<double>(c) + 0.5) * cell_mm_,
                               low_.y_mm + (static_cast<double>(r) + 0.5) * cell_mm_};
            if (distanceToSegment(middle, a, b) <= radius_mm && !visit(index)) return;
        }
}

void MaterialRaster::sweep(const Point& a, const Point& b) {
    forCells(a, b, radius_mm_, [this](std::size_t index) {
        cells_[index] = 0;
        return true;
    });
}

void MaterialRaster::sweepRing(const Point& centre, double ring_radius_mm) {
    // A ring narrower than the tool's radius leaves no core.
    forCells(centre, centre, ring_radius_mm + radius_mm_, [this](std::size_t index) {
        cells_[index] = 0;
        return true;
    });
}

std::size_t MaterialRaster::removal(const Point& a, const Point& b) const {
    std::size_t count = 0;
    forCells(a, b, radius_mm_, [&count](std::size_t) {
        ++count;
        return true;
    });
    return count;
}

bool MaterialRaster::isClear(const Point& a, const Point& b, double rim_cells) const {
    bool clear = true;
    forCells(a, b, radius_mm_ - rim_cells * cell_mm_, [&clear](std::size_t) { return clear = false; });
    return clear;
}

double MaterialRaster::engagementDeg(const Point& a, const Point& b) const {
    const double dx = b.x_mm - a.x_mm;
    const double dy = b.y_mm - a.y_mm;
    const double length = std::hypot(dx, dy);
    const auto parts = std::max(1, static_cast<int>(std::ceil(length / (2.0 * cell_mm_))));
    const double heading = std::atan2(dy, dx) + 2.0 * std::numbers::pi;
    const auto ahead = static_cast<std::size_t>(std::lround(heading / (2.0 * std::numbers::pi) * rim_samples));
    std::size_t most = 0;
    for (int i = 1; i <= parts; ++i) {
        const double x = a.x_mm + dx * i / parts;
        const double y = a.y_mm + dy * i / parts;
        std::size_t count = 0;
        for (std::size_t k = 0; k < rim_samples / 2; ++k) {
            const Direction& d = rim[(ahead + k + rim_samples - rim_samples / 4) % rim_samples];
            if (at(x + radius_mm_ * d.x, y + radius_mm_ * d.y)) ++count;
        }
        most = std::max(most, count);
    }
    return static_cast<double>(most) * 360.0 / rim_samples;
}

}  // namespace cusp::pocket
