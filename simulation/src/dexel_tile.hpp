// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Eight by eight neighbouring rays of one direction, and taking stretches away from them.
#pragma once

#include <cusp/simulation/stock.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cusp::simulation {

class DexelTile {
public:
    static constexpr std::size_t side = 8;
    static constexpr std::size_t rays = side * side;

    [[nodiscard]] std::span<const DexelSpan> ray(std::size_t index) const {
        return std::span(spans_).subspan(first_[index], first_[index + 1] - first_[index]);
    }
    [[nodiscard]] bool empty() const { return spans_.empty(); }

    /// Spans of the next ray; called once for each, in order.
    void append(std::size_t index, std::span<const DexelSpan> spans) {
        spans_.insert(spans_.end(), spans.begin(), spans.end());
        first_[index + 1] = static_cast<std::uint32_t>(spans_.size());
    }

    /// Takes [from, to] from a ray where `accept(lo, hi)` agrees to the piece of material there.
    template <class Accept>
    void remove(std::size_t index, double from, double to, std::uint32_t move, const Accept& accept) {
        for (std::size_t i = first_[index]; i < first_[index + 1];) {
            DexelSpan& span = spans_[i];
            const double low = std::max(span.from_mm, from);
            const double high = std::min(span.to_mm, to);
            if (!(high > low) || !accept(low, high)) {
                ++i;
                continue;
            }
            const bool keeps_below = low - span.from_mm > sliver_mm;
            const bool keeps_above = span.to_mm - high > sliver_mm;
            if (keeps_below && keeps_above) {
                const DexelSpan above{high, span.to_mm, move, span.to_move};
                span.to_mm = low;
                span.to_move = move;
                spans_.insert(spans_.begin() + static_cast<std::ptrdiff_t>(i) + 1, above);
                shift(index, 1);
                i += 2;
            } else if (keeps_below) {
                span.to_mm = low;
                span.to_move = move;
                ++i;
            } else if (keeps_above) {
                span.from_mm = high;
                span.from_move = move;
                ++i;
            } else {
                spans_.erase(spans_.begin() + static_cast<std::ptrdiff_t>(i));
                shift(index, -1);
            }
        }
    }

private:
    /// What is shorter is no material: far below the exactness of the cuts.
    static constexpr double sliver_mm = 1e-7;

    void shift(std::size_t index, std::int32_t by) {
        for (std::size_t i = index + 1; i <= rays; ++i)
            first_[i] = static_cast<std::uint32_t>(static_cast<std::int64_t>(first_[i]) + by);
    }

    std::array<std::uint32_t, rays + 1> first_{};
    std::vector<DexelSpan> spans_;
};

/// The insides of a stock, for those in this room that fill, cut and read it.
class StockAccess {
public:
    using Tile = std::shared_ptr<const DexelTile>;

    [[nodiscard]] static Stock make(const DexelLattice& lattice, std::uint64_t memory_bytes) {
        Stock stock;
        stock.lattice_ = lattice;
        stock.memory_bytes_ = memory_bytes;
        for (int axis = 0; axis < 3; ++axis)
            stock.tiles_[axis].resize(tilesAlong(lattice, (axis + 1) % 3) * tilesAlong(lattice, (axis + 2) % 3));
        return stock;
    }
    [[nodiscard]] static std::vector<Tile>& tiles(Stock& stock, int axis) { return stock.tiles_[axis]; }
    [[nodiscard]] static const std::vector<Tile>& tiles(const Stock& stock, int axis) { return stock.tiles_[axis]; }
    [[nodiscard]] static std::uint64_t memory(const Stock& stock) { return stock.memory_bytes_; }
    [[nodiscard]] static std::size_t tilesAlong(const DexelLattice& lattice, int axis) {
        return (lattice.count[axis] + DexelTile::side - 1) / DexelTile::side;
    }
};

/// Which rays a tile holds: nodes [first_u, end_u) of axis u, [first_v, end_v) of axis v.
struct TileFrame {
    int axis, u, v;
    std::size_t first_u, end_u, first_v, end_v;

    TileFrame(const DexelLattice& lattice, int axis_of_rays, std::size_t tile)
        : axis(axis_of_rays), u((axis_of_rays + 1) % 3), v((axis_of_rays + 2) % 3) {
        const std::size_t across = StockAccess::tilesAlong(lattice, v);
        first_u = tile / across * DexelTile::side;
        first_v = tile % across * DexelTile::side;
        end_u = std::min(first_u + DexelTile::side, lattice.count[u]);
        end_v = std::min(first_v + DexelTile::side, lattice.count[v]);
    }
    [[nodiscard]] std::size_t index(std::size_t i, std::size_t j) const {
        return (i - first_u) * DexelTile::side + (j - first_v);
    }
    /// The ray's point at 0 along the axis.
    [[nodiscard]] geometry::Vector3 origin(const DexelLattice& lattice, std::size_t i, std::size_t j) const {
        geometry::Vector3 at = geometry::Vector3::Zero();
        at[u] = lattice.node(u, i);
        at[v] = lattice.node(v, j);
        return at;
    }
};

}  // namespace cusp::simulation
