// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A coarse grid of distances (Felzenszwalb & Huttenlocher 2012: the exact transform, one axis after the other), and the rays
// where it does not decide.
#include <cusp/simulation/collision_field.hpp>

#include "tile_cutter.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cusp::simulation {

using geometry::Vector3;

namespace {

constexpr double cells_along = 96.0;

/// Squared distances along one line of cells: values become the least over j of values[j] + ((i − j)·step)², the lower
/// envelope of parabolas.
class LineTransform {
public:
    void operator()(std::vector<double>& values, double step) {
        feet_.clear();
        for (std::size_t q = 0; q < values.size(); ++q)
            if (std::isfinite(values[q])) push({static_cast<double>(q) * step, values[q], 0.0});
        if (feet_.empty()) return;
        std::size_t k = 0;
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double at = static_cast<double>(i) * step;
            while (k + 1 < feet_.size() && feet_[k + 1].from < at) ++k;
            const double away = at - feet_[k].at;
            values[i] = feet_[k].value + away * away;
        }
    }

private:
    struct Foot {
        double at, value, from;  ///< the parabola is the lowest from here on
    };
    void push(Foot foot) {
        for (; !feet_.empty(); feet_.pop_back()) {
            const Foot& last = feet_.back();
            foot.from = 0.5 * (foot.at + last.at + (foot.value - last.value) / (foot.at - last.at));
            if (foot.from > last.from) break;
        }
        if (feet_.empty()) foot.from = -std::numeric_limits<double>::infinity();
        feet_.push_back(foot);
    }
    std::vector<Foot> feet_;
};

}  // namespace

class CollisionField::Field {
public:
    explicit Field(const Stock& solid) : box_(solid.lattice().box) {
        const double wanted = std::max(box_.sizes().maxCoeff() / cells_along, solid.lattice().step_mm.maxCoeff());
        for (int axis = 0; axis < 3; ++axis) {
            count_[axis] = static_cast<std::size_t>(std::max(1.0, std::ceil(box_.sizes()[axis] / wanted)));
            step_[axis] = box_.sizes()[axis] / static_cast<double>(count_[axis]);
        }
        diagonal_ = step_.norm();
        distance_.assign(count_[0] * count_[1] * count_[2], std::numeric_limits<double>::infinity());
        occupy(solid);
        transform();
    }

    [[nodiscard]] double clearance(const Vector3& point) const {
        const Vector3 inside = point.cwiseMax(box_.min()).cwiseMin(box_.max());
        PerAxis<std::size_t> cell{};
        for (int axis = 0; axis < 3; ++axis) cell[axis] = cellOf(axis, inside[axis]);
        const double near = std::max(0.0, distance_[indexOf(cell)] - diagonal_);
        // The solid lies in the box, and so behind the plane at the box's nearest point.
        return std::sqrt((point - inside).squaredNorm() + near * near);
    }

private:
    [[nodiscard]] std::size_t cellOf(int axis, double at) const {
        const double cell = std::floor((at - box_.min()[axis]) / step_[axis]);
        return static_cast<std::size_t>(std::clamp(cell, 0.0, static_cast<double>(count_[axis] - 1)));
    }
    [[nodiscard]] std::size_t indexOf(const PerAxis<std::size_t>& cell) const {
        return (cell[0] * count_[1] + cell[1]) * count_[2] + cell[2];
    }

    void occupy(const Stock& solid) {
        const DexelLattice& lattice = solid.lattice();
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            PerAxis<std::size_t> cell{};
            for (std::size_t i = 0; i < lattice.count[u]; ++i)
                for (std::size_t j = 0; j < lattice.count[v]; ++j) {
                    cell[u] = cellOf(u, lattice.node(u, i));
                    cell[v] = cellOf(v, lattice.node(v, j));
                    for (const DexelSpan& span : solid.ray(axis, i, j))
                        for (cell[axis] = cellOf(axis, span.from_mm); cell[axis] <= cellOf(axis, span.to_mm);
                             ++cell[axis])
                            distance_[indexOf(cell)] = 0.0;
                }
        }
    }

    void transform() {
        std::vector<double> line;
        LineTransform transform_line;
        for (int axis = 0; axis < 3; ++axis) {
            const int u = (axis + 1) % 3;
            const int v = (axis + 2) % 3;
            line.resize(count_[axis]);
            PerAxis<std::size_t> cell{};
            for (cell[u] = 0; cell[u] < count_[u]; ++cell[u])
                for (cell[v] = 0; cell[v] < count_[v]; ++cell[v]) {
                    for (cell[axis] = 0; cell[axis] < count_[axis]; ++cell[axis])
                        line[cell[axis]] = distance_[indexOf(cell)];
                    transform_line(line, step_[axis]);
                    for (cell[axis] = 0; cell[axis] < count_[axis]; ++cell[axis])
                        distance_[indexOf(cell)] = line[cell[axis]];
                }
        }
        for (double& distance : distance_) distance = std::sqrt(distance);
    }

    Eigen::AlignedBox3d box_;
    PerAxis<std::size_t> count_{};
    Vector3 step_;
    double diagonal_ = 0.0;         ///< two points of two cells are at most this much closer than the cells' centres
    std::vector<double> distance_;  ///< between centres of cells
};

CollisionField::CollisionField(Stock solid) : solid_(std::move(solid)), field_(std::make_unique<const Field>(solid_)) {}
CollisionField::CollisionField(CollisionField&&) noexcept = default;
CollisionField& CollisionField::operator=(CollisionField&&) noexcept = default;
CollisionField::~CollisionField() = default;

const Stock& CollisionField::solid() const { return solid_; }
double CollisionField::clearance(const Vector3& point) const { return field_->clearance(point); }

namespace {

/// Spheres along the body's axis, each as wide as the body: clear of the solid, whenever in the move?
bool staysClear(const CollisionField& field, const ToolMove& move, const CutterBody& body) {
    const double height = body.height() - body.base();
    const double radius = body.largestRadius();
    const int spheres = std::clamp(static_cast<int>(std::ceil(height / std::max(radius, 0.05 * height))), 1, 16);
    const double half = 0.5 * height / spheres;
    const double reach = std::hypot(radius, half);
    const Vector3 tip = 0.5 * (move.from.tip_mm + move.to.tip_mm);
    const double half_turn = 0.5 * geometry::angleBetween(move.from.axis, move.to.axis);
    const Vector3 sum = move.from.axis + move.to.axis;
    if (sum.squaredNorm() < 1e-6) return false;
    const Vector3 axis = sum.normalized();
    const double half_way = 0.5 * (move.to.tip_mm - move.from.tip_mm).norm();
    for (int i = 0; i < spheres; ++i) {
        const double z = body.base() + (2 * i + 1) * half;
        if (field.clearance(tip + z * axis) <= reach + half_way + half_turn * (std::abs(z) + reach)) return false;
    }
    return true;
}

}  // namespace

CollisionVolume CollisionField::measure(std::span<const ToolMove> moves, std::span<const ToolAssembly> assemblies,
                                        const CollisionQuery& query) const {
    SweepBatch batch;
    for (std::size_t i = 0; i < moves.size(); ++i)
        batch.add(moves[i], static_cast<std::uint32_t>(i), assemblies[moves[i].cutter], query.sweep_tolerance_mm,
                  query.sweep_tolerance_mm, [&](const AssemblyBody& body) {
                      return (query.with_cutter || body.part != ToolPart::Cutter) &&
                             !staysClear(*this, moves[i], body.body);
                  });
    CollisionVolume out;
    if (batch.sweeps.empty()) return out;
    if (query.with_cutter)
        for (SweepRole& role : batch.roles) {
            role.cuts = false;
            role.touches = true;
        }
    const SweepTree tree(batch.sweeps);
    std::vector<Touch> touches;
    for (int axis = 0; axis < 3; ++axis) {
        const auto& tiles = StockAccess::tiles(solid_, axis);
        std::vector<std::vector<Touch>> by_tile(tiles.size());
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size()), [&](const auto& range) {
            TileCutter cutter(solid_.lattice(), batch, tree, query.touch_tolerance_mm);
            DexelTile work;
            for (std::size_t index = range.begin(); index < range.end(); ++index)
                cutter.cut(*tiles[index], TileFrame(solid_.lattice(), axis, index), query.first_move, work, nullptr,
                           by_tile[index]);
        });
        for (const auto& part : by_tile) touches.insert(touches.end(), part.begin(), part.end());
    }
    out.collisions = collisionsOf(batch, std::move(touches), query.first_move);
    for (const Collision& collision : out.collisions) {
        out.volume_mm3 += collision.volume_mm3;
        out.depth_mm = std::max(out.depth_mm, collision.depth_mm);
    }
    return out;
}

}  // namespace cusp::simulation
