// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A solid as rays in three directions (tri-dexel): what milling takes away from.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/closest_point.hpp>
#include <cusp/geometry/frames.hpp>
#include <cusp/geometry/triangle_mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

namespace cusp::simulation {

class DexelTile;

/// One value an axis, numbered as Eigen numbers the components of a vector.
template <class T>
class PerAxis {
public:
    [[nodiscard]] T& operator[](int axis) { return values_[static_cast<std::size_t>(axis)]; }
    [[nodiscard]] const T& operator[](int axis) const { return values_[static_cast<std::size_t>(axis)]; }

private:
    std::array<T, 3> values_{};
};

/// Where rays run: along each axis through the nodes `low + (i + ½)·step` of the two others, so that the cells of the nodes
/// fill the box exactly.
struct DexelLattice {
    Eigen::AlignedBox3d box;
    PerAxis<std::size_t> count;
    geometry::Vector3 step_mm = geometry::Vector3::Zero();

    /// The steps are at most `resolution_mm`.
    [[nodiscard]] static DexelLattice over(const Eigen::AlignedBox3d& box, double resolution_mm);
    [[nodiscard]] double node(int axis, std::size_t i) const {
        return box.min()[axis] + (static_cast<double>(i) + 0.5) * step_mm[axis];
    }
};

struct StockOptions {
    double resolution_mm = 0.5;                            ///< distance of the rays
    std::uint64_t memory_bytes = std::uint64_t{4} << 30U;  ///< the stock and the work on it stay below this
};

/// A stretch of material on a ray, and the moves that cut its ends (`no_cut`: as the stock came).
struct DexelSpan {
    double from_mm = 0.0;
    double to_mm = 0.0;
    std::uint32_t from_move = no_cut;
    std::uint32_t to_move = no_cut;

    static constexpr std::uint32_t no_cut = std::numeric_limits<std::uint32_t>::max();
};

/// A solid on a lattice. Copies share what neither has changed since, so that a copy is a cheap point of return.
class Stock {
public:
    /// All makers check the memory before any work. Errors: `simulation.resolution` (not positive, or more than the box
    /// is wide), `simulation.memory`, `simulation.stock` (an empty box).
    [[nodiscard]] static base::Result<Stock> box(const Eigen::AlignedBox3d& box, const StockOptions& options);
    /// Further errors: `simulation.open-mesh` when the mesh does not close a volume.
    [[nodiscard]] static base::Result<Stock> mesh(const geometry::TriangleMesh& mesh, const StockOptions& options);
    /// The material side of any shape within a box: where the signed distance is negative.
    [[nodiscard]] static base::Result<Stock> shape(const geometry::NominalShape& shape, const Eigen::AlignedBox3d& box,
                                                   const StockOptions& options);

    /// A shape that encloses a volume by itself, as a blank must. Further error: `simulation.open-shape` where it ends somewhere,
    /// or has its material outside.
    [[nodiscard]] static base::Result<Stock> solid(const geometry::NominalShape& shape, const StockOptions& options);

    [[nodiscard]] const DexelLattice& lattice() const { return lattice_; }
    /// The spans of the ray along `axis` at node u of axis (axis + 1) % 3 and v of (axis + 2) % 3, in order.
    [[nodiscard]] std::span<const DexelSpan> ray(int axis, std::size_t u, std::size_t v) const;
    /// Mean of the three directions.
    [[nodiscard]] double volume() const;
    [[nodiscard]] bool contains(const geometry::Vector3& point) const;  ///< by the nearest ray along Z

    /// What a stock of this box and resolution takes at least.
    [[nodiscard]] static std::uint64_t memoryOf(const DexelLattice& lattice);

private:
    friend class StockAccess;
    using Tile = std::shared_ptr<const DexelTile>;

    DexelLattice lattice_;
    PerAxis<std::vector<Tile>> tiles_;  ///< of 8 × 8 rays, v running faster
    std::uint64_t memory_bytes_ = 0;
};

}  // namespace cusp::simulation
