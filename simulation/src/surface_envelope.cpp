// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Each tile of the grid against the moves that can reach it.
#include <cusp/simulation/surface_envelope.hpp>

#include "move_index.hpp"

#include <cusp/simulation/cutter_body.hpp>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cusp::simulation {
namespace {

using geometry::Vector3;

/// Measures the points of one tile one after another: what was found at one is where the search begins at the next.
class TileSearch {
public:
    TileSearch(const MoveIndex& moves, double band_mm) : moves_(moves), band_mm_(band_mm) {}

    void begin(const GridTile& tile) {
        center_ = tile.center;
        moves_.near(tile.center, tile.radius_mm + band_mm_, near_);
        first_ = 0;
    }

    [[nodiscard]] EnvelopePoint measure(const GridPoint& point) {
        EnvelopePoint out{band_mm_, EnvelopePoint::no_move};
        if (near_.empty()) return out;
        const NormalLine line{point.position, point.normal};
        const std::size_t begin = first_;
        look(line, begin, out);
        for (std::size_t i = 0; i < near_.size(); ++i)
            if (i != begin) look(line, i, out);
        return out;
    }

private:
    void look(const NormalLine& line, std::size_t candidate, EnvelopePoint& out) {
        MoveIndex::Near& near = near_[candidate];
        const Vector3 highest = line.origin + (out.deviation_mm - SweptMove::search_tolerance_mm) * line.direction;
        // Along the line the distance may be less before the highest point of interest than there: the plane says where.
        const double rise = std::max(0.0, near.nearness.gradient.dot(line.direction)) * (out.deviation_mm + band_mm_);
        if (near.nearness.boundAt(highest - center_) - rise - near.nearness.bend * (out.deviation_mm + band_mm_) > 0.0)
            return;
        const SweptMove& move = moves_[near.move];
        if (!move.lowerEntry(line, -band_mm_, out.deviation_mm, near.nearness.time)) return;
        out.move = move.move();
        first_ = candidate;
    }

    const MoveIndex& moves_;
    double band_mm_;
    Vector3 center_ = Vector3::Zero();
    std::vector<MoveIndex::Near> near_;
    std::size_t first_ = 0;
};

base::Result<std::vector<CutterBody>> bodiesOf(const CutterPath& path) {
    std::vector<CutterBody> bodies;
    for (const geometry::Cutter& cutter : path.cutters) {
        auto body = CutterBody::make(cutter);
        if (!body) return base::fail(body.error());
        bodies.push_back(*body);
    }
    return bodies;
}

base::Result<void> check(const CutterPath& path, const EnvelopeOptions& options) {
    base::Diagnostics report;
    if (!(options.spacing_mm > 0.0))
        report.error("simulation.option",
                     fmt::format("the grid spacing is {} mm; it must be positive", options.spacing_mm));
    if (!(options.band_mm > 0.0))
        report.error("simulation.option", fmt::format("the band is {} mm; it must be positive", options.band_mm));
    if (path.moves.empty()) report.error("simulation.no-moves", "the path has no moves of a tool whose shape is known");
    if (report.hasErrors()) return base::fail(std::move(report));
    return {};
}

}  // namespace

base::Result<SurfaceEnvelope> surfaceEnvelope(const CutterPath& path, std::span<const geometry::SurfaceFace> faces,
                                              const EnvelopeOptions& options) {
    if (const auto ok = check(path, options); !ok) return base::fail(ok.error());
    return surfaceEnvelope(path, surfaceGrid(faces, options.spacing_mm), options);
}

base::Result<SurfaceEnvelope> surfaceEnvelope(const CutterPath& path, SurfaceGrid grid,
                                              const EnvelopeOptions& options) {
    if (const auto ok = check(path, options); !ok) return base::fail(ok.error());
    const auto bodies = bodiesOf(path);
    if (!bodies) return base::fail(bodies.error());
    std::vector<SweptMove> swept;
    for (std::size_t i = 0; i < path.moves.size(); ++i)
        SweptMove::split(path.moves[i], static_cast<std::uint32_t>(i), (*bodies)[path.moves[i].cutter], swept);
    const MoveIndex moves(std::move(swept));

    SurfaceEnvelope out;
    out.band_mm = options.band_mm;
    out.grid = std::move(grid);
    out.points.resize(out.grid.points.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, out.grid.tiles.size()), [&](const auto& range) {
        TileSearch search(moves, options.band_mm);
        for (std::size_t t = range.begin(); t < range.end(); ++t) {
            const GridTile& tile = out.grid.tiles[t];
            search.begin(tile);
            for (std::size_t i = tile.first; i < tile.first + tile.count; ++i)
                out.points[i] = search.measure(out.grid.points[i]);
        }
    });
    return out;
}

EnvelopeSummary summaryOf(const SurfaceEnvelope& envelope, double tolerance_mm) {
    EnvelopeSummary sum;
    sum.points = envelope.points.size();
    double area = 0.0;
    double reached_area = 0.0;
    double within_area = 0.0;
    double weighted = 0.0;
    for (std::size_t i = 0; i < envelope.points.size(); ++i) {
        const EnvelopePoint& point = envelope.points[i];
        const double share = envelope.grid.points[i].area_mm2;
        area += share;
        if (!point.reached()) continue;
        ++sum.reached;
        reached_area += share;
        weighted += share * point.deviation_mm;
        if (std::abs(point.deviation_mm) <= tolerance_mm) within_area += share;
        if (point.deviation_mm <= -envelope.band_mm) ++sum.beyond;
        if (-point.deviation_mm > sum.overcut_max_mm) {
            sum.overcut_max_mm = -point.deviation_mm;
            sum.deepest = i;
        }
        if (point.deviation_mm > sum.undercut_max_mm) {
            sum.undercut_max_mm = point.deviation_mm;
            sum.highest = i;
        }
    }
    if (reached_area > 0.0) {
        sum.mean_mm = weighted / reached_area;
        sum.within_tolerance_percent = 100.0 * within_area / reached_area;
    }
    if (area > 0.0) sum.reached_percent = 100.0 * reached_area / area;
    return sum;
}

}  // namespace cusp::simulation
