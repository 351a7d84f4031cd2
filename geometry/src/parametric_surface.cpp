// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cells in a box tree, nearest first; Newton where the distance is convex, branch and bound where it is not.
#include "box_newton.hpp"
#include "box_tree.hpp"
#include "cell_reach.hpp"
#include "exact_search.hpp"
#include "patch_cells.hpp"
#include "quick_search.hpp"

#include <cusp/geometry/parametric_surface.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>

namespace cusp::geometry {

using detail::PatchCell;
using detail::PatchFoot;

namespace {

/// Feet of one place on several faces differ by rounding, and by the gaps between faces as CAD systems leave them.
constexpr double same_place_mm = 1e-6;
/// How far off its normal a query may stand and still count as standing on it: this, and as much per millimetre of distance.
constexpr double along_normal_mm = 1e-9;

struct Nearest {
    PatchFoot foot;
    std::size_t patch = 0;
};

}  // namespace

class ParametricSurface::Index {
public:
    explicit Index(std::vector<SurfaceFace> faces) : faces_(std::move(faces)) {
        for (const SurfaceFace& face : faces_) {
            for (const BezierPatch& patch : face.patches()) {
                for (const BezierPatch::Vector4& point : patch.net()) {
                    bounds_.extend(patch.origin() + point.head<3>() / point[3]);
                }
            }
        }
        origin_ = bounds_.center();
        for (std::size_t f = 0; f < faces_.size(); ++f) addFace(f);
        std::vector<Eigen::AlignedBox3d> boxes;
        boxes.reserve(cells_.size());
        for (const PatchCell& cell : cells_) boxes.push_back(cell.hull);
        tree_ = detail::BoxTree(boxes);
        prepareQuickSearch(boxes);
    }

    [[nodiscard]] const std::vector<SurfaceFace>& faces() const { return faces_; }
    [[nodiscard]] const Eigen::AlignedBox3d& bounds() const { return bounds_; }

    /// `earlier`, if any, is a guess of the answer.
    [[nodiscard]] Footpoint closest(const Vector3& query, const Footpoint* earlier) const {
        if (!query.allFinite()) return noFootpoint();
        const Vector3 local = query - origin_;
        if (detail::QuickFoot quick; quick_.find(local, quick)) return footpointOf(quick, local);
        const double limit_squared =
            earlier != nullptr ? boundFrom(*earlier, query) : std::numeric_limits<double>::infinity();
        Nearest best;
        best.foot.squared_mm2 = limit_squared;
        const auto limit = [&] { return best.foot.squared_mm2; };
        tree_.visitNear(local, limit, [&](std::size_t c) {
            searchCell(cells_[c], local, best.foot.squared_mm2, [&](const PatchFoot& foot) {
                best.foot = foot;
                best.patch = cells_[c].patch;
                return foot.squared_mm2;
            });
        });
        return footpointOf(best, local);
    }

private:
    /// A bound of the squared distance from an earlier answer, rounded up so that the same answer still passes.
    [[nodiscard]] double boundFrom(const Footpoint& earlier, const Vector3& query) const {
        const bool usable = earlier.face >= 0 && static_cast<std::size_t>(earlier.face) < faces_.size() &&
                            std::isfinite(earlier.u) && std::isfinite(earlier.v);
        if (!usable) return std::numeric_limits<double>::infinity();
        const SurfaceFace& face = faces_[static_cast<std::size_t>(earlier.face)];
        const double distance = (face.evaluate(earlier.u, earlier.v).position - query).norm();
        return (distance + same_place_mm) * (distance + same_place_mm);
    }

    void addFace(std::size_t f) {
        const std::vector<BezierPatch>& patches = faces_[f].patches();
        for (std::size_t i = 0; i < patches.size(); ++i) {
            const BezierPatch about = patches[i].about(origin_);
            patches_.emplace_back(about.degreeU(), about.degreeV(), about.net(), Vector3::Zero());
            const std::size_t columns = faces_[f].breaksV().size() - 1;
            places_.push_back({f, i / columns, i % columns});
            detail::cutIntoCells(patches_.back(), static_cast<std::uint32_t>(patches_.size() - 1), cells_);
        }
    }

    void prepareQuickSearch(const std::vector<Eigen::AlignedBox3d>& boxes) {
        const detail::ReachFinder finder(faces_, places_, cells_, tree_, boxes);
        std::vector<double> reaches(cells_.size());
        tbb::parallel_for(std::size_t{0}, cells_.size(), [&](std::size_t c) {
            if (detail::CellPolynomial::canHold(patches_[cells_[c].patch])) reaches[c] = finder.reachOf(c);
        });
        std::vector<const BezierPatch*> patches;
        for (const BezierPatch& patch : patches_) patches.push_back(&patch);
        quick_ = detail::QuickSearch(patches, cells_, reaches);
    }

    /// Calls `take` with feet on the cell that are nearer than the limit, which `take` returns anew.
    template <class Take>
    void searchCell(const PatchCell& cell, const Vector3& local, double limit_squared, Take take) const {
        if (cell.bounds.squaredDistance(local) > limit_squared) return;
        const BezierPatch& patch = patches_[cell.patch];
        if (cell.bounds.isConvexFor(local)) {
            const PatchFoot foot = detail::newtonInBox(patch, cell.box, local, cell.box.middleU(), cell.box.middleV());
            if (foot.squared_mm2 < limit_squared) limit_squared = take(foot);
            if (foot.converged) return;
        }
        detail::searchExactly(patch, cell.box, local, limit_squared, take);
    }

    /// Face and parameters of a point of a patch.
    void locate(std::size_t patch, double u, double v, Footpoint& out) const {
        const detail::PatchPlace& place = places_[patch];
        const SurfaceFace& face = faces_[place.face];
        const std::size_t columns = face.breaksV().size() - 1;
        const auto parameters = face.faceParameters(place.row * columns + place.column, u, v);
        out.face = static_cast<std::int32_t>(place.face);
        out.u = parameters[0];
        out.v = parameters[1];
    }

    [[nodiscard]] const SurfaceFace& faceOfPatch(std::size_t patch) const { return faces_[places_[patch].face]; }

    [[nodiscard]] Footpoint footpointOf(const detail::QuickFoot& quick, const Vector3& local) const {
        Footpoint out;
        locate(quick.patch, quick.u, quick.v, out);
        out.position = origin_ + quick.position;
        out.normal = faceOfPatch(quick.patch).outwardSign() * quick.ds.cross(quick.dt).normalized();
        const Vector3 offset = local - quick.position;
        out.distance_mm = std::copysign(offset.norm(), offset.dot(out.normal));
        return out;
    }

    [[nodiscard]] Footpoint footpointOf(const Nearest& best, const Vector3& local) const {
        const SurfaceFace& face = faceOfPatch(best.patch);
        Footpoint out;
        locate(best.patch, best.foot.u, best.foot.v, out);
        out.position = origin_ + best.foot.point.position;
        out.normal = face.outwardSign() * crossNormal(best.foot.point);
        if (out.normal.isZero()) out.normal = face.normal(out.u, out.v);
        const Vector3 offset = local - best.foot.point.position;
        const double along = offset.dot(out.normal);
        out.distance_mm = std::copysign(offset.norm(), along);
        const PatchFoot& foot = best.foot;
        const bool at_border = foot.u <= 0.0 || foot.u >= 1.0 || foot.v <= 0.0 || foot.v >= 1.0;
        if (at_border && (offset - along * out.normal).norm() > slackOf(foot)) settleAtEdge(best, local, out);
        return out;
    }

    /// The query does not stand on the normal: the foot is at an edge. Faces that meet there decide the sign together.
    void settleAtEdge(const Nearest& best, const Vector3& local, Footpoint& out) const {
        const Vector3 offset = local - best.foot.point.position;
        std::vector<Vector3> normals{out.normal};
        const double reach = offset.norm() + same_place_mm;
        tree_.visitNear(
            local, [&] { return reach * reach; },
            [&](std::size_t c) {
                PatchFoot near;
                near.squared_mm2 = reach * reach;
                searchCell(cells_[c], local, reach * reach, [&](const PatchFoot& foot) {
                    near = foot;
                    return foot.squared_mm2;
                });
                if (!near.point.du.isZero() &&
                    (near.point.position - best.foot.point.position).norm() <= same_place_mm) {
                    normals.push_back(faceOfPatch(cells_[c].patch).outwardSign() * crossNormal(near.point));
                }
            });
        for (const Vector3& normal : normals) {
            if (std::abs(offset.dot(normal)) > std::abs(offset.dot(out.normal))) out.normal = normal;
        }
        out.distance_mm = std::copysign(offset.norm(), offset.dot(out.normal));
        out.on_boundary = leavesSpan(offset, normals, slackOf(best.foot));
    }

    /// How far off its normal the query may stand and still count as standing on it. At a pole the search cannot tell points
    /// apart whose distances differ by less than its tolerance.
    static double slackOf(const PatchFoot& foot) {
        const double distance_mm = std::sqrt(foot.squared_mm2);
        const double at_pole = crossNormal(foot.point).isZero() ? std::sqrt(detail::search_tolerance_mm) : 0.0;
        return along_normal_mm * (1.0 + distance_mm) + 4.0 * at_pole * std::sqrt(1.0 + distance_mm);
    }

    /// Whether the offset has a part that no combination of the normals explains: then the shape ends at the foot.
    static bool leavesSpan(const Vector3& offset, const std::vector<Vector3>& normals, double slack_mm) {
        // Faces that meet smoothly have one normal; beyond this angle two normals span a plane.
        constexpr double sharp_rad = 1e-3;
        std::vector<Vector3> basis;
        for (const Vector3& normal : normals) {
            Vector3 rest = normal;
            for (const Vector3& axis : basis) rest -= rest.dot(axis) * axis;
            if (rest.norm() > sharp_rad) basis.push_back(rest.normalized());
        }
        Vector3 rest = offset;
        for (const Vector3& axis : basis) rest -= rest.dot(axis) * axis;
        return rest.norm() > slack_mm;
    }

    std::vector<SurfaceFace> faces_;
    Eigen::AlignedBox3d bounds_;
    /// The index works about this point, so that a shape far from the origin of its frame loses no digits.
    Vector3 origin_ = Vector3::Zero();
    std::vector<BezierPatch> patches_;
    std::vector<detail::PatchPlace> places_;
    std::vector<PatchCell> cells_;
    detail::BoxTree tree_;
    detail::QuickSearch quick_;
};

ParametricSurface::ParametricSurface(std::vector<SurfaceFace> faces)
    : index_(std::make_unique<const Index>(std::move(faces))) {}
ParametricSurface::ParametricSurface(ParametricSurface&&) noexcept = default;
ParametricSurface& ParametricSurface::operator=(ParametricSurface&&) noexcept = default;
ParametricSurface::~ParametricSurface() = default;

Footpoint ParametricSurface::closest(const Vector3& query) const { return index_->closest(query, nullptr); }

void ParametricSurface::closest(std::span<const Vector3> queries, std::span<Footpoint> footpoints, bool warm) const {
    assert(queries.size() == footpoints.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries.size(), 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            footpoints[i] = index_->closest(queries[i], warm ? &footpoints[i] : nullptr);
        }
    });
}

Eigen::AlignedBox3d ParametricSurface::bounds() const { return index_->bounds(); }

const std::vector<SurfaceFace>& ParametricSurface::faces() const { return index_->faces(); }

}  // namespace cusp::geometry
