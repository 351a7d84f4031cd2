// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A batch of sweeps against one tile of rays: what milling and collision queries share.
#pragma once

#include "body_sweep.hpp"
#include "dexel_tile.hpp"
#include "sweep_tree.hpp"

#include <cusp/simulation/milling.hpp>

#include <atomic>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cusp::simulation {

/// Sums and extremes that come out the same in whatever order threads add to them: volumes are whole numbers of 1e-9 mm³.
class EngagementTally {
public:
    explicit EngagementTally(std::size_t moves) : cells_(moves) {}
    void add(std::size_t move, double volume_mm3, const Eigen::AlignedBox2d& reach);
    [[nodiscard]] MoveEngagement of(std::size_t move) const;

private:
    struct Cell {
        std::atomic<std::int64_t> volume{0};
        std::atomic<double> axial_low{1e300}, axial_high{-1e300}, radial_low{1e300}, radial_high{-1e300};
    };
    std::vector<Cell> cells_;
};

/// One part of the tool in one move.
struct SweepRole {
    std::uint32_t move = 0;
    ToolPart part = ToolPart::Cutter;
    bool cuts = true;      ///< takes all it sweeps; else only where it goes deeper than the touch tolerance
    bool touches = false;  ///< what it takes is a collision
    geometry::Vector3 axis = geometry::Vector3::UnitZ();
    geometry::Vector3 across = geometry::Vector3::UnitX();  ///< unit, across feed and axis
};

struct Touch {
    std::uint32_t role = 0;
    double volume_mm3 = 0.0;
    double depth_mm = 0.0;
    geometry::Vector3 position_mm = geometry::Vector3::Zero();
};

/// The roles of a move, and its sweeps with the role's index as tag. `skip(sweep hull)` leaves whole bodies out.
class SweepBatch {
public:
    void clear();
    /// Sweeps of the bodies for which `wanted(body)` holds.
    template <class Wanted>
    void add(const ToolMove& move, std::uint32_t index, const ToolAssembly& assembly, double cutter_tolerance_mm,
             double part_tolerance_mm, const Wanted& wanted);

    std::vector<SweepRole> roles;
    std::vector<BodySweep> sweeps;

private:
    static SweepRole roleOf(const ToolMove& move, std::uint32_t index, ToolPart part);
};

class TileCutter {
public:
    TileCutter(const DexelLattice& lattice, const SweepBatch& batch, const SweepTree& tree, double touch_tolerance_mm)
        : lattice_(lattice), batch_(batch), tree_(tree), touch_tolerance_mm_(touch_tolerance_mm) {}

    /// True when the sweeps come near the tile's material; then `work` holds what is left.
    bool cut(const DexelTile& tile, const TileFrame& frame, std::uint32_t first_move, DexelTile& work,
             EngagementTally* tally, std::vector<Touch>& touches);

private:
    struct Taken;
    /// Where a ray has material within the sweep's box, at the lowest and the highest; false where it has none.
    static bool materialIn(const DexelTile& work, const TileFrame& frame, const BodySweep& sweep, std::size_t index,
                           double& low, double& high);
    void cutRay(DexelTile& work, const TileFrame& frame, const BodySweep& sweep, std::size_t i, std::size_t j,
                Taken& taken);
    /// The same of the rays [first, end) at node i of u.
    void cutRow(DexelTile& work, const TileFrame& frame, const BodySweep& sweep, const UprightBall& ball, std::size_t i,
                std::pair<std::size_t, std::size_t> nodes_of_v, Taken& taken);
    void take(DexelTile& work, const TileFrame& frame, const BodySweep& sweep, std::size_t i, std::size_t j,
              double from, double to, Taken& taken) const;

    const DexelLattice& lattice_;
    const SweepBatch& batch_;
    const SweepTree& tree_;
    double touch_tolerance_mm_;
    std::uint32_t first_move_ = 0;
    BodySweep::Pieces pieces_;
};

/// Adds up the touches of all tiles, in order, by move and part.
[[nodiscard]] std::vector<Collision> collisionsOf(const SweepBatch& batch, std::vector<Touch> touches,
                                                  std::uint32_t first_move);

template <class Wanted>
void SweepBatch::add(const ToolMove& move, std::uint32_t index, const ToolAssembly& assembly,
                     double cutter_tolerance_mm, double part_tolerance_mm, const Wanted& wanted) {
    bool fresh = true;
    for (const AssemblyBody& body : assembly.bodies) {
        if (!wanted(body)) continue;
        if (fresh || roles.back().part != body.part) roles.push_back(roleOf(move, index, body.part));
        fresh = false;
        BodySweep::split(move, body.body, roles.back().cuts ? cutter_tolerance_mm : part_tolerance_mm,
                         static_cast<std::uint32_t>(roles.size() - 1), sweeps);
    }
}

}  // namespace cusp::simulation
