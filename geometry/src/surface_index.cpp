// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Building the index, and the search: nearest first, Newton where the distance is convex, branch and bound where not.
#include "surface_index.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cusp::geometry {

using detail::PatchCell;
using detail::PatchFoot;

namespace {

/// An earlier answer must pass its own bound: it may be off by rounding, and an edge by the tolerance of its file.
constexpr double warm_slack_mm = 1e-5;

Eigen::AlignedBox3d hullOf(const BezierCurve& curve) {
    Eigen::AlignedBox3d box;
    for (const BezierCurve::Vector4& p : curve.net()) box.extend(Vector3(p.head<3>() / p[3]));
    return box;
}

}  // namespace

ParametricSurface::Index::Index(std::vector<SurfaceFace> faces, std::vector<TrimEdge> edges)
    : faces_(std::move(faces)), edges_(std::move(edges)) {
    Eigen::AlignedBox3d all;
    for (const SurfaceFace& face : faces_) {
        for (const BezierPatch& patch : face.patches()) {
            for (const BezierPatch::Vector4& point : patch.net()) {
                all.extend(patch.origin() + point.head<3>() / point[3]);
            }
        }
    }
    origin_ = all.center();
    for (std::size_t f = 0; f < faces_.size(); ++f) addFace(f);
    findRegions();
    prepareQuickSearch();
    collectItems();
}

void ParametricSurface::Index::addFace(std::size_t f) {
    const std::vector<BezierPatch>& patches = faces_[f].patches();
    const std::size_t columns = faces_[f].breaksV().size() - 1;
    for (std::size_t i = 0; i < patches.size(); ++i) {
        const BezierPatch about = patches[i].about(origin_);
        patches_.emplace_back(about.degreeU(), about.degreeV(), about.net(), Vector3::Zero());
        places_.push_back({f, i / columns, i % columns});
        detail::cutIntoCells(patches_.back(), static_cast<std::uint32_t>(patches_.size() - 1), cells_);
    }
}

void ParametricSurface::Index::findRegions() {
    std::vector<std::vector<const CurvePieces*>> outlines(faces_.size());
    for (const TrimEdge& edge : edges_) {
        for (const EdgeUse& use : edge.uses) outlines[use.face].push_back(&use.parameters);
    }
    for (std::size_t f = 0; f < faces_.size(); ++f) regions_.emplace_back(faces_[f], outlines[f]);
    for (std::size_t e = 0; e < edges_.size(); ++e) {
        const std::vector<EdgeUse>& uses = edges_[e].uses;
        // An edge whose face goes on beyond it (a seam), and one of whole faces only, which end at their patches' borders.
        const bool seam = uses.size() == 2 && uses[0].face == uses[1].face;
        const bool cuts =
            std::any_of(uses.begin(), uses.end(), [&](const EdgeUse& use) { return !regions_[use.face].isWhole(); });
        if (seam || !cuts) continue;
        const CurvePieces& curve = edges_[e].curve;
        for (std::size_t i = 0; i < curve.pieces.size(); ++i) {
            edge_pieces_.push_back({curve.pieces[i].about(origin_), e, curve.breaks[i], curve.breaks[i + 1]});
        }
    }
}

std::array<double, 2> ParametricSurface::Index::faceParameters(std::size_t patch, double u, double v) const {
    const detail::PatchPlace& place = places_[patch];
    const SurfaceFace& face = faces_[place.face];
    return face.faceParameters(place.row * (face.breaksV().size() - 1) + place.column, u, v);
}

bool ParametricSurface::Index::isInRegion(std::size_t patch, double u, double v) const {
    const detail::TrimRegion& region = regions_[places_[patch].face];
    if (region.isWhole()) return true;
    const auto at = faceParameters(patch, u, v);
    return region.contains(at[0], at[1]);
}

detail::Coverage ParametricSurface::Index::coverageOf(std::size_t patch, const detail::ParameterBox& box) const {
    const detail::TrimRegion& region = regions_[places_[patch].face];
    if (region.isWhole()) return detail::Coverage::Wholly;
    const auto low = faceParameters(patch, box.low_u, box.low_v);
    const auto high = faceParameters(patch, box.high_u, box.high_v);
    if (region.mayCross({low[0], high[0], low[1], high[1]})) return detail::Coverage::Partly;
    return region.contains(0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])) ? detail::Coverage::Wholly
                                                                               : detail::Coverage::Outside;
}

void ParametricSurface::Index::collectItems() {
    std::vector<Eigen::AlignedBox3d> boxes;
    for (std::size_t c = 0; c < cells_.size(); ++c) {
        if (coverageOf(cells_[c].patch, cells_[c].box) == detail::Coverage::Outside) continue;
        items_.push_back(static_cast<std::uint32_t>(c));
        boxes.push_back(cells_[c].hull);
    }
    for (std::size_t e = 0; e < edge_pieces_.size(); ++e) {
        items_.push_back(static_cast<std::uint32_t>(cells_.size() + e));
        boxes.push_back(hullOf(edge_pieces_[e].curve));
    }
    tree_ = detail::BoxTree(boxes);
    for (const Eigen::AlignedBox3d& box : boxes) {
        bounds_.extend(Eigen::AlignedBox3d(box.min() + origin_, box.max() + origin_));
    }
}

void ParametricSurface::Index::prepareQuickSearch() {
    // All cells, also those outside of trimmed faces: bounds of derivatives have to hold between any two points.
    std::vector<Eigen::AlignedBox3d> boxes;
    boxes.reserve(cells_.size());
    for (const PatchCell& cell : cells_) boxes.push_back(cell.hull);
    const detail::BoxTree tree(boxes);
    const detail::ReachFinder finder(faces_, places_, cells_, tree, boxes);
    std::vector<double> reaches(cells_.size());
    tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t c) {
        if (detail::CellPolynomial::canHold(patches_[cells_[c].patch])) reaches[c] = finder.reachOf(c);
    });
    std::vector<const BezierPatch*> patches;
    patches.reserve(patches_.size());
    for (const BezierPatch& patch : patches_) patches.push_back(&patch);
    quick_ = detail::QuickSearch(patches, cells_, reaches);
}

std::size_t ParametricSurface::Index::trimmedFaces() const {
    return static_cast<std::size_t>(
        std::count_if(regions_.begin(), regions_.end(), [](const auto& region) { return !region.isWhole(); }));
}

double ParametricSurface::Index::boundFrom(const Footpoint& earlier, const Vector3& query) const {
    const bool usable = earlier.face >= 0 && static_cast<std::size_t>(earlier.face) < faces_.size() &&
                        std::isfinite(earlier.u) && std::isfinite(earlier.v);
    if (!usable) return std::numeric_limits<double>::infinity();
    const auto f = static_cast<std::size_t>(earlier.face);
    const double u = std::clamp(earlier.u, faces_[f].breaksU().front(), faces_[f].breaksU().back());
    const double v = std::clamp(earlier.v, faces_[f].breaksV().front(), faces_[f].breaksV().back());
    if (!regions_[f].contains(u, v)) return std::numeric_limits<double>::infinity();
    const double distance = (faces_[f].evaluate(u, v).position - query).norm() + warm_slack_mm;
    return distance * distance;
}

ParametricSurface::Index::Nearest ParametricSurface::Index::search(const Vector3& local, double limit_squared) const {
    Nearest best;
    best.foot.squared_mm2 = limit_squared;
    const auto limit = [&] { return best.foot.squared_mm2; };
    tree_.visitNear(local, limit, [&](std::size_t i) {
        const std::size_t item = items_[i];
        if (item >= cells_.size()) {
            const EdgePiece& piece = edge_pieces_[item - cells_.size()];
            detail::CurveFoot foot{0.0, best.foot.squared_mm2, Vector3::Zero()};
            if (!detail::searchCurve(piece.curve, local, foot)) return;
            best.foot.squared_mm2 = foot.squared_mm2;
            best.foot.point.position = foot.position;
            best.edge = piece.edge;
            best.t = piece.low_t + foot.t * (piece.high_t - piece.low_t);
            best.found = true;
            return;
        }
        const PatchCell& cell = cells_[item];
        searchCell(cell, local, best.foot.squared_mm2, [&](const PatchFoot& foot) {
            if (isInRegion(cell.patch, foot.u, foot.v)) {
                best.foot = foot;
                best.patch = cell.patch;
                best.edge.reset();
                best.found = true;
            }
            return best.foot.squared_mm2;
        });
    });
    return best;
}

Footpoint ParametricSurface::Index::closest(const Vector3& query, const Footpoint* earlier) const {
    if (!query.allFinite()) return noFootpoint();
    const Vector3 local = query - origin_;
    if (detail::QuickFoot quick; quick_.find(local, quick) && isInRegion(quick.patch, quick.u, quick.v)) {
        return footpointOf(quick, local);
    }
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Nearest best = search(local, earlier != nullptr ? boundFrom(*earlier, query) : infinity);
    if (!best.found) best = search(local, infinity);  // the guess was no point of the shape after all
    if (!best.found) return noFootpoint();
    return best.edge ? edgeFootpointOf(best, local) : footpointOf(best, local);
}

}  // namespace cusp::geometry
