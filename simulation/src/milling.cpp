// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Batches of moves against all tiles, in parallel.
#include <cusp/simulation/milling.hpp>

#include "tile_cutter.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

namespace cusp::simulation {
namespace {

/// Moves whose sweeps are held in memory at once.
constexpr std::size_t batch_moves = 8192;
/// Shank and holder are swept this much more coarsely than the cutter.
constexpr double part_coarseness = 2.5;

base::Result<void> check(std::span<const ToolMove> moves, std::span<const ToolAssembly> assemblies,
                         const MillingOptions& options) {
    base::Diagnostics report;
    if (!(options.sweep_tolerance_mm >= 1e-5))
        report.error("simulation.option", fmt::format("the tolerance of sweeps is {} mm; it must be at least 1e-5 mm",
                                                      options.sweep_tolerance_mm));
    if (!(options.touch_tolerance_mm >= 0.0))
        report.error("simulation.option", fmt::format("the tolerance of touching is {} mm; it must not be negative",
                                                      options.touch_tolerance_mm));
    const bool known =
        std::all_of(moves.begin(), moves.end(), [&](const ToolMove& move) { return move.cutter < assemblies.size(); });
    if (!known) report.error("simulation.option", "a move names a tool that is not among the assemblies");
    if (report.hasErrors()) return base::fail(std::move(report));
    return {};
}

/// Takes one batch from the rays of one direction; the touches come in the order of the tiles.
void cutDirection(Stock& stock, int axis, const SweepBatch& batch, const SweepTree& tree, const MillingOptions& options,
                  std::uint32_t first_move, EngagementTally& tally, std::vector<Touch>& touches) {
    auto& tiles = StockAccess::tiles(stock, axis);
    std::vector<std::vector<Touch>> by_tile(tiles.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size()), [&](const auto& range) {
        TileCutter cutter(stock.lattice(), batch, tree, options.touch_tolerance_mm);
        DexelTile work;
        for (std::size_t index = range.begin(); index < range.end(); ++index) {
            const TileFrame frame(stock.lattice(), axis, index);
            if (cutter.cut(*tiles[index], frame, first_move, work, &tally, by_tile[index]))
                tiles[index] = std::make_shared<DexelTile>(work);
        }
    });
    for (const auto& part : by_tile) touches.insert(touches.end(), part.begin(), part.end());
}

}  // namespace

double MillingReport::collisionVolume() const {
    double volume = 0.0;
    for (const Collision& collision : collisions) volume += collision.volume_mm3;
    return volume;
}

base::Result<MillingReport> mill(Stock& stock, std::span<const ToolMove> moves,
                                 std::span<const ToolAssembly> assemblies, const MillingOptions& options) {
    if (const auto ok = check(moves, assemblies, options); !ok) return base::fail(ok.error());
    MillingReport report;
    SweepBatch batch;
    for (std::size_t first = 0; first < moves.size(); first += batch_moves) {
        const auto part = moves.subspan(first, std::min(batch_moves, moves.size() - first));
        batch.clear();
        for (std::size_t i = 0; i < part.size(); ++i)
            batch.add(part[i], static_cast<std::uint32_t>(i), assemblies[part[i].cutter], options.sweep_tolerance_mm,
                      part_coarseness * options.sweep_tolerance_mm, [](const AssemblyBody&) { return true; });
        const SweepTree tree(batch.sweeps);
        const auto first_move = static_cast<std::uint32_t>(options.first_move + first);
        EngagementTally tally(part.size());
        std::vector<Touch> touches;
        for (int axis = 0; axis < 3; ++axis)
            cutDirection(stock, axis, batch, tree, options, first_move, tally, touches);
        for (std::size_t i = 0; i < part.size(); ++i) {
            report.moves.push_back(tally.of(i));
            report.removed_volume_mm3 += report.moves.back().volume_mm3;
        }
        for (Collision& collision : collisionsOf(batch, std::move(touches), first_move)) {
            // A rapid move's cutter is in the tally already.
            if (collision.part != ToolPart::Cutter) report.removed_volume_mm3 += collision.volume_mm3;
            report.collisions.push_back(collision);
        }
        if (options.progress && !options.progress(first + part.size()))
            return base::fail("simulation.interrupted", "the simulation was interrupted");
    }
    return report;
}

}  // namespace cusp::simulation
