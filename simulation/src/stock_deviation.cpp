// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The ends of the spans against the nearest points of the nominal.
#include <cusp/simulation/stock_surface.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cusp::simulation {

using geometry::Footpoint;
using geometry::Vector3;

namespace {

struct SpanEnd {
    Vector3 position;
    int axis;
    std::uint32_t move;
};

std::vector<SpanEnd> endsOf(const Stock& stock, std::size_t stride) {
    const DexelLattice& lattice = stock.lattice();
    std::vector<SpanEnd> out;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (std::size_t i = 0; i < lattice.count[u]; i += stride)
            for (std::size_t j = 0; j < lattice.count[v]; j += stride) {
                Vector3 at;
                at[u] = lattice.node(u, i);
                at[v] = lattice.node(v, j);
                for (const DexelSpan& span : stock.ray(axis, i, j)) {
                    at[axis] = span.from_mm;
                    out.push_back({at, axis, span.from_move});
                    at[axis] = span.to_mm;
                    out.push_back({at, axis, span.to_move});
                }
            }
    }
    return out;
}

DeviationSummary summaryOf(const std::vector<DeviationPoint>& points, double tolerance_mm) {
    DeviationSummary sum;
    sum.points = points.size();
    double area = 0.0;
    double within = 0.0;
    double weighted = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const DeviationPoint& point = points[i];
        area += point.area_mm2;
        weighted += point.area_mm2 * point.deviation_mm;
        if (std::abs(point.deviation_mm) <= tolerance_mm) within += point.area_mm2;
        if (-point.deviation_mm > sum.overcut_max_mm) {
            sum.overcut_max_mm = -point.deviation_mm;
            sum.deepest = i;
        }
        if (point.deviation_mm > sum.undercut_max_mm) {
            sum.undercut_max_mm = point.deviation_mm;
            sum.highest = i;
        }
    }
    if (area > 0.0) {
        sum.mean_mm = weighted / area;
        sum.within_tolerance_percent = 100.0 * within / area;
    }
    return sum;
}

}  // namespace

StockDeviation stockDeviation(const Stock& stock, const geometry::NominalShape& nominal, double tolerance_mm,
                              std::size_t stride) {
    stride = std::max<std::size_t>(1, stride);
    const std::vector<SpanEnd> ends = endsOf(stock, stride);
    std::vector<Vector3> queries;
    queries.reserve(ends.size());
    for (const SpanEnd& end : ends) queries.push_back(end.position);
    std::vector<Footpoint> footpoints(queries.size());
    nominal.closest(queries, footpoints, false);

    StockDeviation out;
    double uncut = 0.0;
    const Vector3 step = static_cast<double>(stride) * stock.lattice().step_mm;
    for (std::size_t i = 0; i < ends.size(); ++i) {
        const Footpoint& foot = footpoints[i];
        if (foot.on_boundary) continue;
        if (ends[i].move == DexelSpan::no_cut) {
            uncut = std::max(uncut, foot.distance_mm);
            continue;
        }
        // Rays along k meet the surface |n_k| times per cell of theirs: weighted by |n_k|, the three directions add up to
        // the area once.
        const int axis = ends[i].axis;
        const double cell = step[(axis + 1) % 3] * step[(axis + 2) % 3];
        out.points.push_back({ends[i].position, foot.distance_mm, cell * std::abs(foot.normal[axis]), ends[i].move});
    }
    out.summary = summaryOf(out.points, tolerance_mm);
    out.summary.uncut_max_mm = uncut;
    return out;
}

}  // namespace cusp::simulation
