// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Mills, measures, looks for collisions with what is not the stock, and asks the machine for every pose.
#include "simulate_run.hpp"

#include "console.hpp"
#include "progress_bar.hpp"
#include "ram_moves.hpp"

#include <cusp/base/units.hpp>
#include <cusp/geometry/mesh_shape.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <span>
#include <utility>

namespace cusp::cli {
namespace {

using simulation::Collision;
using simulation::Stock;
using simulation::ToolPart;

constexpr std::size_t most_violations = 100;
/// Nodes along the longest side of solids that only need to be touched or not.
constexpr double nodes_of_obstacles = 200.0;

/// Within `box` where the shape is open; a mesh that closes by its own box.
base::Result<Stock> solidOf(const geometry::NominalShape& shape, const Eigen::AlignedBox3d& box, double resolution_mm,
                            std::uint64_t memory) {
    if (const auto* mesh = dynamic_cast<const geometry::MeshShape*>(&shape))
        if (geometry::checkEdges(mesh->mesh()).isClosed()) return Stock::mesh(mesh->mesh(), {resolution_mm, memory});
    return Stock::shape(shape, box, {resolution_mm, memory});
}

double coarse(const Eigen::AlignedBox3d& box, double resolution_mm) {
    return std::min(std::max(resolution_mm, box.sizes().maxCoeff() / nodes_of_obstacles), box.sizes().minCoeff());
}

/// What is simulated: the path's moves, or these and the ram's.
struct Movers {
    std::span<const simulation::ToolMove> moves;
    std::span<const simulation::ToolAssembly> assemblies;
    const RamMoves* ram = nullptr;

    /// By the path's own moves; the chords of the ram in one move are one collision.
    void add(const Collision& found, const std::string& with, const std::string& file,
             std::vector<FoundCollision>& out) const {
        FoundCollision mine{with, file, found, ram != nullptr && ram->isRam(found.move)};
        if (ram != nullptr) mine.collision.move = ram->origin(found.move);
        if (mine.ram && !out.empty() && out.back().ram && out.back().collision.move == mine.collision.move &&
            out.back().with == with && out.back().file == file) {
            Collision& one = out.back().collision;
            mine.collision.volume_mm3 += one.volume_mm3;
            if (one.depth_mm > mine.collision.depth_mm) {
                mine.collision.depth_mm = one.depth_mm;
                mine.collision.position_mm = one.position_mm;
            }
            out.back() = mine;
            return;
        }
        out.push_back(std::move(mine));
    }
};

void addTouches(const Movers& movers, const simulation::CollisionVolume& found, const std::string& with,
                const std::string& file, std::vector<FoundCollision>& out) {
    for (const Collision& collision : found.collisions) movers.add(collision, with, file, out);
}

base::Result<void> measureObstacles(const SimulateFlags& flags, const SimulateInput& input, const Movers& movers,
                                    SimulateResult& done) {
    const auto memory = static_cast<std::uint64_t>(flags.memory_mb * 1024.0 * 1024.0);
    const Eigen::AlignedBox3d& box = input.stock->lattice().box;
    const bool only_cutters = std::all_of(movers.assemblies.begin(), movers.assemblies.end(), [](const auto& tool) {
        return tool.bodies.size() == 1 && tool.bodies.front().part == ToolPart::Cutter;
    });
    if (input.nominal && !only_cutters) {
        done.nominal_resolution_mm = coarse(box, flags.resolution_mm);
        auto solid = solidOf(*input.nominal, box, done.nominal_resolution_mm, memory);
        if (!solid) return base::fail(solid.error());
        addTouches(movers, simulation::CollisionField(*std::move(solid)).measure(movers.moves, movers.assemblies),
                   "nominal", {}, done.collisions);
    }
    for (const Obstacle& obstacle : input.obstacles) {
        const Eigen::AlignedBox3d around = obstacle.shape->bounds();
        auto solid = solidOf(*obstacle.shape, around, coarse(around, flags.resolution_mm), memory);
        if (!solid) return base::fail(solid.error());
        simulation::CollisionQuery query;
        query.with_cutter = true;
        addTouches(movers,
                   simulation::CollisionField(*std::move(solid)).measure(movers.moves, movers.assemblies, query),
                   obstacle.kind, obstacle.file, done.collisions);
    }
    return {};
}

/// Why a pose is out of the machine's range; empty when it is not.
std::string outOfRange(const kinematics::Machine& machine, const toolpath::CutterLocation& at, double tool_length_mm,
                       const std::optional<geometry::Vector3>& origin) {
    constexpr double axis_tolerance_rad = 1e-6;
    const kinematics::PoseSolutions found = machine.inverse(at, tool_length_mm, axis_tolerance_rad);
    if (found.miss_rad > axis_tolerance_rad)
        return fmt::format("the tool axis is {:.3f}° beyond what the rotary axes reach",
                           base::degFromRad(found.miss_rad));
    if (found.values.empty()) return "no position of the rotary axes within their limits gives this tool axis";
    if (!origin) return {};
    std::string reason;
    for (const kinematics::AxisValues& values : found.values) {
        reason.clear();
        for (std::size_t i = 0; i < 3; ++i) {
            const double position = values.linear_mm[static_cast<int>(i)];
            const double excess = machine.linearRange(i).excess(position);
            if (excess > 0.0)
                reason = fmt::format("{} stands at {:.3f} mm, {:.3f} mm beyond its range", machine.linearNames()[i],
                                     position, excess);
        }
        if (reason.empty()) return {};
    }
    return reason;
}

void checkRange(const SimulateFlags& flags, const SimulateInput& input, SimulateResult& done) {
    if (!input.machine) return;
    std::optional<geometry::Vector3> origin;
    if (flags.wcs_origin_mm.size() == 3)
        origin = geometry::Vector3(flags.wcs_origin_mm[0], flags.wcs_origin_mm[1], flags.wcs_origin_mm[2]);
    for (std::size_t i = 0; i < input.path.moves.size(); ++i) {
        const simulation::ToolMove& move = input.path.moves[i];
        toolpath::CutterLocation at = move.to;
        if (origin) at.tip_mm += *origin;
        const toolpath::Tool* tool = input.path.tools[move.cutter];
        std::string reason =
            outOfRange(input.machine->model, at, tool != nullptr ? tool->gauge_length_mm : 0.0, origin);
        if (reason.empty()) continue;
        ++done.violation_count;
        if (done.violations.size() < most_violations)
            done.violations.push_back({static_cast<std::uint32_t>(i), std::move(reason)});
    }
}

/// Reports speak of the path's moves.
void keepOwnMoves(const RamMoves& ram, SimulateResult& done) {
    std::vector<simulation::MoveEngagement> own;
    for (std::size_t i = 0; i < done.milling.moves.size(); ++i)
        if (!ram.isRam(static_cast<std::uint32_t>(i))) own.push_back(done.milling.moves[i]);
    done.milling.moves = std::move(own);
    for (Collision& collision : done.milling.collisions) collision.move = ram.origin(collision.move);
    if (!done.deviation) return;
    for (simulation::DeviationPoint& point : done.deviation->points)
        if (point.move != simulation::DexelSpan::no_cut) point.move = ram.origin(point.move);
}

}  // namespace

base::Result<SimulateResult> runSimulation(const SimulateFlags& flags, SimulateInput& input) {
    const auto begin = std::chrono::steady_clock::now();
    SimulateResult done;
    done.before = *input.stock;
    done.after = *input.stock;
    std::optional<RamMoves> ram;
    if (!input.ram.rings.empty()) {
        auto made = RamMoves::make(input);
        if (!made) return base::fail(made.error());
        ram = *std::move(made);
    }
    const Movers movers =
        ram ? Movers{ram->moves(), ram->assemblies(), &*ram} : Movers{input.path.moves, input.assemblies, nullptr};
    simulation::MillingOptions options;
    options.sweep_tolerance_mm = flags.sweep_tolerance_mm;
    {
        ProgressBar bar("milling");
        options.progress = [&](std::size_t moves) {
            bar.show(moves, movers.moves.size());
            return !interrupted();
        };
        auto milling = simulation::mill(done.after, movers.moves, movers.assemblies, options);
        if (!milling) return base::fail(milling.error());
        done.milling = *std::move(milling);
    }
    for (const Collision& collision : done.milling.collisions)
        movers.add(collision, collision.part == ToolPart::Cutter ? "rapid" : "stock", {}, done.collisions);
    // Of second order in the resolution, where the sums of the rays are of first.
    done.removed_volume_mm3 = simulation::enclosedVolume(simulation::surfaceMesh(done.before)) -
                              simulation::enclosedVolume(simulation::surfaceMesh(done.after));
    if (done.milling.removed_volume_mm3 == 0.0) done.removed_volume_mm3 = 0.0;
    if (const auto ok = measureObstacles(flags, input, movers, done); !ok) return base::fail(ok.error());
    std::stable_sort(done.collisions.begin(), done.collisions.end(),
                     [](const auto& a, const auto& b) { return a.collision.move < b.collision.move; });
    if (input.nominal) done.deviation = simulation::stockDeviation(done.after, *input.nominal, flags.tolerance_mm);
    if (ram) keepOwnMoves(*ram, done);
    checkRange(flags, input, done);
    done.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return done;
}

bool foundSomething(const SimulateFlags& flags, const SimulateResult& done) {
    const bool off = done.deviation && (done.deviation->summary.overcut_max_mm > flags.tolerance_mm ||
                                        done.deviation->summary.undercut_max_mm > flags.tolerance_mm);
    return off || !done.collisions.empty() || done.violation_count > 0;
}

}  // namespace cusp::cli
