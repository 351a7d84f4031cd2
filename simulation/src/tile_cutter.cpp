// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Finds the sweeps that meet a tile and takes them from its rays.
#include "tile_cutter.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::simulation {

using geometry::Vector3;

namespace {

constexpr double tally_unit_mm3 = 1e-9;

void lower(std::atomic<double>& cell, double value) {
    double seen = cell.load(std::memory_order_relaxed);
    while (value < seen && !cell.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
    }
}

void raise(std::atomic<double>& cell, double value) {
    double seen = cell.load(std::memory_order_relaxed);
    while (value > seen && !cell.compare_exchange_weak(seen, value, std::memory_order_relaxed)) {
    }
}

}  // namespace

void EngagementTally::add(std::size_t move, double volume_mm3, const Eigen::AlignedBox2d& reach) {
    Cell& cell = cells_[move];
    cell.volume.fetch_add(std::llround(volume_mm3 / tally_unit_mm3), std::memory_order_relaxed);
    lower(cell.axial_low, reach.min()[0]);
    raise(cell.axial_high, reach.max()[0]);
    lower(cell.radial_low, reach.min()[1]);
    raise(cell.radial_high, reach.max()[1]);
}

MoveEngagement EngagementTally::of(std::size_t move) const {
    const Cell& cell = cells_[move];
    const auto extent = [](const std::atomic<double>& low, const std::atomic<double>& high) {
        return std::max(0.0, high.load() - low.load());
    };
    return {static_cast<double>(cell.volume.load()) * tally_unit_mm3, extent(cell.axial_low, cell.axial_high),
            extent(cell.radial_low, cell.radial_high)};
}

void SweepBatch::clear() {
    roles.clear();
    sweeps.clear();
}

SweepRole SweepBatch::roleOf(const ToolMove& move, std::uint32_t index, ToolPart part) {
    SweepRole role;
    role.move = index;
    role.part = part;
    role.cuts = part == ToolPart::Cutter;
    role.touches = !role.cuts || move.kind == toolpath::MotionKind::Rapid;
    role.axis = (move.from.axis + move.to.axis).normalized();
    const Vector3 across = role.axis.cross(move.to.tip_mm - move.from.tip_mm);
    role.across = across.squaredNorm() > 1e-18 ? Vector3(across.normalized()) : role.axis.unitOrthogonal();
    return role;
}

/// What one sweep takes from one tile.
struct TileCutter::Taken {
    double volume_mm3 = 0.0;
    double area_mm2 = 0.0;  ///< of a ray, a third of it: the three directions share the volume
    Eigen::AlignedBox2d reach;
    Touch touch;
};

bool TileCutter::materialIn(const DexelTile& work, const TileFrame& frame, const BodySweep& sweep, std::size_t index,
                            double& low, double& high) {
    const double box_low = sweep.box().min()[frame.axis];
    const double box_high = sweep.box().max()[frame.axis];
    low = box_high;
    high = box_low;
    for (const DexelSpan& span : work.ray(index)) {
        if (span.to_mm <= box_low || span.from_mm >= box_high) continue;
        low = std::min(low, std::max(span.from_mm, box_low));
        high = std::max(high, std::min(span.to_mm, box_high));
    }
    return high > low;
}

void TileCutter::cutRay(DexelTile& work, const TileFrame& frame, const BodySweep& sweep, std::size_t i, std::size_t j,
                        Taken& taken) {
    double low = 0.0;
    double high = 0.0;
    if (!materialIn(work, frame, sweep, frame.index(i, j), low, high)) return;
    pieces_.clear();
    sweep.cut(sweep.rayAlong(frame.axis, frame.origin(lattice_, i, j)), low, high, pieces_);
    for (const auto& [from, to] : pieces_) take(work, frame, sweep, i, j, from, to, taken);
}

void TileCutter::cutRow(DexelTile& work, const TileFrame& frame, const BodySweep& sweep, const UprightBall& ball,
                        std::size_t i, std::pair<std::size_t, std::size_t> nodes_of_v, Taken& taken) {
    static_assert(UprightBall::lanes == DexelTile::side);
    UprightBall::Row low{};
    UprightBall::Row high{};
    const auto [first, end] = nodes_of_v;
    bool any = false;
    for (std::size_t j = first; j < end; ++j) {
        const std::size_t lane = j - frame.first_v;
        any = materialIn(work, frame, sweep, frame.index(i, j), low[lane], high[lane]) || any;
    }
    if (!any) return;
    UprightBall::Row v{};
    for (std::size_t lane = 0; lane < UprightBall::lanes; ++lane)
        v[lane] = lattice_.node(frame.v, frame.first_v + lane);
    UprightBall::Row from;
    UprightBall::Row to;
    ball.sweep(frame.axis, lattice_.node(frame.u, i), v, from, to);
    for (std::size_t j = first; j < end; ++j) {
        const std::size_t lane = j - frame.first_v;
        const double entry = std::max(low[lane], from[lane]);
        const double exit = std::min(high[lane], to[lane]);
        if (exit > entry) take(work, frame, sweep, i, j, entry, exit, taken);
    }
}

void TileCutter::take(DexelTile& work, const TileFrame& frame, const BodySweep& sweep, std::size_t i, std::size_t j,
                      double from, double to, Taken& taken) const {
    const SweepRole& role = batch_.roles[sweep.tag()];
    Vector3 at = frame.origin(lattice_, i, j);
    const auto accept = [&](double low, double high) {
        const double volume = (high - low) * taken.area_mm2;
        at[frame.axis] = 0.5 * (low + high);
        if (role.touches) {
            const BodySweep::Ray ray = sweep.rayAlong(frame.axis, frame.origin(lattice_, i, j));
            const double depth = sweep.depth(ray, at[frame.axis]);
            const bool counts = depth > touch_tolerance_mm_;
            if (!role.cuts && !counts) return false;
            if (counts) {
                taken.touch.volume_mm3 += volume;
                if (depth > taken.touch.depth_mm) {
                    taken.touch.depth_mm = depth;
                    taken.touch.position_mm = at;
                }
            }
        }
        taken.volume_mm3 += volume;
        if (role.cuts)
            for (const double end : {low, high}) {
                at[frame.axis] = end;
                const Vector3 away = at - sweep.middleTip();
                taken.reach.extend(Eigen::Vector2d(away.dot(role.axis), away.dot(role.across)));
            }
        return true;
    };
    work.remove(frame.index(i, j), from, to, first_move_ + role.move, accept);
}

bool TileCutter::cut(const DexelTile& tile, const TileFrame& frame, std::uint32_t first_move, DexelTile& work,
                     EngagementTally* tally, std::vector<Touch>& touches) {
    if (tile.empty()) return false;
    first_move_ = first_move;
    Eigen::AlignedBox3d box;
    box.extend(frame.origin(lattice_, frame.first_u, frame.first_v));
    box.extend(frame.origin(lattice_, frame.end_u - 1, frame.end_v - 1));
    box.min()[frame.axis] = 1e300;
    box.max()[frame.axis] = -1e300;
    for (std::size_t i = 0; i < DexelTile::rays; ++i) {
        const auto spans = tile.ray(i);
        if (spans.empty()) continue;
        box.min()[frame.axis] = std::min(box.min()[frame.axis], spans.front().from_mm);
        box.max()[frame.axis] = std::max(box.max()[frame.axis], spans.back().to_mm);
    }
    bool begun = false;
    const auto nodes = [&](int axis, double low, double high, std::size_t first, std::size_t end) {
        const double base = lattice_.box.min()[axis];
        const double step = lattice_.step_mm[axis];
        const auto bounded = [&](double at) {
            return static_cast<std::size_t>(std::clamp(at, static_cast<double>(first), static_cast<double>(end)));
        };
        return std::pair(bounded(std::ceil((low - base) / step - 0.5)),
                         bounded(std::floor((high - base) / step + 0.5)));
    };
    tree_.meet(box, [&](const BodySweep& sweep) {
        const auto [first_u, end_u] =
            nodes(frame.u, sweep.box().min()[frame.u], sweep.box().max()[frame.u], frame.first_u, frame.end_u);
        const auto [first_v, end_v] =
            nodes(frame.v, sweep.box().min()[frame.v], sweep.box().max()[frame.v], frame.first_v, frame.end_v);
        if (first_u >= end_u || first_v >= end_v) return;
        if (!begun) work = tile;
        begun = true;
        Taken taken;
        taken.area_mm2 = lattice_.step_mm[frame.u] * lattice_.step_mm[frame.v] / 3.0;
        UprightBall ball;
        const bool by_rows = sweep.asUprightBall(ball);
        for (std::size_t i = first_u; i < end_u; ++i) {
            if (by_rows) {
                cutRow(work, frame, sweep, ball, i, {first_v, end_v}, taken);
                continue;
            }
            for (std::size_t j = first_v; j < end_v; ++j) cutRay(work, frame, sweep, i, j, taken);
        }
        if (!(taken.volume_mm3 > 0.0)) return;
        const SweepRole& role = batch_.roles[sweep.tag()];
        if (role.cuts && tally != nullptr) tally->add(role.move, taken.volume_mm3, taken.reach);
        if (taken.touch.volume_mm3 > 0.0) {
            taken.touch.role = sweep.tag();
            touches.push_back(taken.touch);
        }
    });
    return begun;
}

std::vector<Collision> collisionsOf(const SweepBatch& batch, std::vector<Touch> touches, std::uint32_t first_move) {
    std::stable_sort(touches.begin(), touches.end(), [](const Touch& a, const Touch& b) { return a.role < b.role; });
    std::vector<Collision> out;
    std::uint32_t last = static_cast<std::uint32_t>(-1);
    for (const Touch& touch : touches) {
        const SweepRole& role = batch.roles[touch.role];
        if (touch.role != last) out.push_back({first_move + role.move, role.part, 0.0, 0.0, Vector3::Zero()});
        last = touch.role;
        out.back().volume_mm3 += touch.volume_mm3;
        if (touch.depth_mm > out.back().depth_mm) {
            out.back().depth_mm = touch.depth_mm;
            out.back().position_mm = touch.position_mm;
        }
    }
    return out;
}

}  // namespace cusp::simulation
