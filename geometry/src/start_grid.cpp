// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cubes about half as large as the cells, entered by each cell whose box comes near them.
#include "start_grid.hpp"

#include <algorithm>
#include <limits>

namespace cusp::geometry::detail {
namespace {

constexpr std::size_t most_cubes = std::size_t{1} << 20U;
/// A cell is entered this many cubes around its box, for queries off the surface.
constexpr double around = 1.0;

/// Mean of the shorter sides of the cells.
double meanSide(std::span<const PatchCell> cells) {
    double sum = 0.0;
    for (const PatchCell& cell : cells) sum += std::min(cell.bounds.length_u_mm, cell.bounds.length_v_mm);
    return sum / static_cast<double>(cells.size());
}

}  // namespace

StartGrid::StartGrid(std::span<const PatchCell> cells) {
    Eigen::AlignedBox3d box;
    for (const PatchCell& cell : cells) box.extend(cell.hull);
    double edge_mm = std::max(0.5 * meanSide(cells), 1e-6 * box.diagonal().norm());
    if (!(edge_mm > 0.0)) return;
    const auto count = [&](double size) { return std::floor((size + 2.0 * around * edge_mm) / edge_mm) + 1.0; };
    const auto cubes = [&] { return count(box.sizes().x()) * count(box.sizes().y()) * count(box.sizes().z()); };
    while (cubes() > static_cast<double>(most_cubes)) edge_mm *= 1.25;
    low_ = box.min() - Vector3::Constant(around * edge_mm);
    per_mm_ = 1.0 / edge_mm;
    limits_ = Vector3(count(box.sizes().x()), count(box.sizes().y()), count(box.sizes().z()));
    for (std::size_t k = 0; k < 3; ++k) counts_[k] = static_cast<std::size_t>(limits_[static_cast<Eigen::Index>(k)]);
    cells_.assign(counts_[0] * counts_[1] * counts_[2], none);
    std::vector<double> nearest(cells_.size(), std::numeric_limits<double>::infinity());
    for (std::size_t c = 0; c < cells.size(); ++c) enter(cells, static_cast<std::uint32_t>(c), nearest);
}

void StartGrid::enter(std::span<const PatchCell> cells, std::uint32_t cell, std::vector<double>& nearest) {
    std::array<std::size_t, 3> first{};
    std::array<std::size_t, 3> last{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        const double most = static_cast<double>(counts_[k] - 1);
        const double from = (cells[cell].hull.min()[axis] - low_[axis]) * per_mm_ - around;
        const double to = (cells[cell].hull.max()[axis] - low_[axis]) * per_mm_ + around;
        first[k] = static_cast<std::size_t>(std::clamp(from, 0.0, most));
        last[k] = static_cast<std::size_t>(std::clamp(to, 0.0, most));
    }
    for (std::size_t x = first[0]; x <= last[0]; ++x) {
        for (std::size_t y = first[1]; y <= last[1]; ++y) {
            for (std::size_t z = first[2]; z <= last[2]; ++z) {
                const Vector3 middle = low_ + Vector3(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5,
                                                      static_cast<double>(z) + 0.5) /
                                                  per_mm_;
                const double squared = cells[cell].bounds.squaredDistance(middle);
                const std::size_t i = indexOf(x, y, z);
                if (squared < nearest[i]) {
                    nearest[i] = squared;
                    cells_[i] = cell;
                }
            }
        }
    }
}

}  // namespace cusp::geometry::detail
