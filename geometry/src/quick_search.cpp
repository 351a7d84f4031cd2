// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Start from the inverse of the cell's second-order expansion, then Newton; the last step is taken on the expansion.
#include "quick_search.hpp"

#include "cell_reach.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::geometry::detail {
namespace {

/// Outside of this the start is no good, and the general search is the faster one.
constexpr double start_scope = 3.0;
constexpr int most_steps = 5;
constexpr int most_cells = 3;

}  // namespace

QuickSearch::QuickSearch(std::span<const BezierPatch* const> patches, std::span<const PatchCell> cells,
                         std::span<const double> reaches) {
    index_.assign(cells.size(), StartGrid::none);
    for (std::size_t c = 0; c < cells.size(); ++c) {
        if (!(reaches[c] > 0.0)) continue;
        const CellPolynomial shape(partOf(*patches[cells[c].patch], cells[c].box));
        index_[c] = static_cast<std::uint32_t>(cells_.size());
        cells_.push_back(cellOf(cells[c], shape, reaches[c]));
    }
    if (!cells_.empty()) grid_ = StartGrid(cells);
}

QuickSearch::Cell QuickSearch::cellOf(const PatchCell& cell, const CellPolynomial& shape, double reach_mm) {
    Cell out;
    out.shape = shape;
    out.middle = shape.evaluate(0.0, 0.0);
    const Vector3 ds = toVector(out.middle.ds);
    const Vector3 dt = toVector(out.middle.dt);
    const double determinant = ds.squaredNorm() * dt.squaredNorm() - ds.dot(dt) * ds.dot(dt);
    out.to_s = toLanes((dt.squaredNorm() * ds - ds.dot(dt) * dt) / determinant);
    out.to_t = toLanes((ds.squaredNorm() * dt - ds.dot(dt) * ds) / determinant);
    out.middle_u = cell.box.middleU();
    out.middle_v = cell.box.middleV();
    out.half_u = 0.5 * (cell.box.high_u - cell.box.low_u);
    out.half_v = 0.5 * (cell.box.high_v - cell.box.low_v);
    out.low_s = std::max(-reach_scope, -out.middle_u / out.half_u);
    out.high_s = std::min(reach_scope, (1.0 - out.middle_u) / out.half_u);
    out.low_t = std::max(-reach_scope, -out.middle_v / out.half_v);
    out.high_t = std::min(reach_scope, (1.0 - out.middle_v) / out.half_v);
    out.squared_reach = reach_mm * reach_mm;
    // The reach is at most half the radius of curvature in the metric of the cell, so 1/reach bounds how fast J turns, and
    // the Hessian is at least half of JᵀJ: the error behind a step h is below 4 h²/reach.
    out.last_step_mm2 = 0.25e-12 * std::min(reach_mm, 1.0);
    out.patch = cell.patch;
    return out;
}

bool QuickSearch::find(const Vector3& query, QuickFoot& foot) const {
    std::uint32_t start = grid_.cellNear(query);
    for (int attempt = 0; attempt < most_cells; ++attempt) {
        if (start == StartGrid::none || index_[start] == StartGrid::none) return false;
        const Ending ending = findFrom(cells_[index_[start]], query, foot);
        if (ending != Ending::Beside) return ending == Ending::Proved;
        // The foot belongs to another cell, which is the one near the foot.
        const std::uint32_t next = grid_.cellNear(foot.position);
        if (next == start) return false;
        start = next;
    }
    return false;
}

QuickSearch::Ending QuickSearch::findFrom(const Cell& cell, const Vector3& query, QuickFoot& foot) {
    const Lanes point = toLanes(query);
    const Lanes offset = point - cell.middle.position;
    double s = dot(cell.to_s, offset);
    double t = dot(cell.to_t, offset);
    if (!(std::abs(s) <= start_scope && std::abs(t) <= start_scope)) return Ending::Lost;
    const Lanes straight =
        offset - (cell.middle.dss * (0.5 * s * s) + cell.middle.dst * (s * t) + cell.middle.dtt * (0.5 * t * t));
    s = dot(cell.to_s, straight);
    t = dot(cell.to_t, straight);
    for (int i = 0; i < most_steps; ++i) {
        if (!(std::abs(s) <= start_scope && std::abs(t) <= start_scope)) return Ending::Lost;
        const LanePoint p = cell.shape.evaluate(s, t);
        const Lanes r = p.position - point;
        const double g_s = dot(r, p.ds);
        const double g_t = dot(r, p.dt);
        const double h_ss = dot(p.ds, p.ds) + dot(r, p.dss);
        const double h_st = dot(p.ds, p.dt) + dot(r, p.dst);
        const double h_tt = dot(p.dt, p.dt) + dot(r, p.dtt);
        const double inverse = 1.0 / (h_ss * h_tt - h_st * h_st);
        const double step_s = (h_st * g_t - h_tt * g_s) * inverse;
        const double step_t = (h_st * g_s - h_ss * g_t) * inverse;
        s += step_s;
        t += step_t;
        const Lanes step = p.ds * step_s + p.dt * step_t;
        if (!(dot(step, step) <= cell.last_step_mm2)) continue;
        const Lanes rest = r + step;
        foot.position = toVector(p.position + step);
        if (!(s >= cell.low_s && s <= cell.high_s && t >= cell.low_t && t <= cell.high_t)) return Ending::Beside;
        if (!(dot(rest, rest) < cell.squared_reach)) return Ending::Lost;
        foot.patch = cell.patch;
        foot.u = cell.middle_u + s * cell.half_u;
        foot.v = cell.middle_v + t * cell.half_v;
        foot.ds = toVector(p.ds + p.dss * step_s + p.dst * step_t);
        foot.dt = toVector(p.dt + p.dst * step_s + p.dtt * step_t);
        return Ending::Proved;
    }
    return Ending::Lost;
}

}  // namespace cusp::geometry::detail
