// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Everything ParametricSurface looks up: cells and edges in a box tree, regions of trimmed faces, the quick way.
#pragma once

#include "box_tree.hpp"
#include "cell_reach.hpp"
#include "curve_search.hpp"
#include "exact_search.hpp"
#include "patch_cells.hpp"
#include "quick_search.hpp"
#include "trim_region.hpp"

#include <cusp/geometry/parametric_surface.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace cusp::geometry {

class ParametricSurface::Index {
public:
    Index(std::vector<SurfaceFace> faces, std::vector<TrimEdge> edges);

    [[nodiscard]] const std::vector<SurfaceFace>& faces() const { return faces_; }
    [[nodiscard]] const Eigen::AlignedBox3d& bounds() const { return bounds_; }
    [[nodiscard]] std::size_t trimmedFaces() const;
    /// `earlier`, if any, is a guess of the answer.
    [[nodiscard]] Footpoint closest(const Vector3& query, const Footpoint* earlier) const;

private:
    /// A Bézier piece of a trim edge in the coordinates of the index.
    struct EdgePiece {
        BezierCurve curve;
        std::size_t edge;
        double low_t;
        double high_t;
    };
    /// What is nearest so far: a place on a patch, or on an edge.
    struct Nearest {
        detail::PatchFoot foot;
        std::size_t patch = 0;
        std::optional<std::size_t> edge;
        double t = 0.0;
        bool found = false;
    };
    /// An answer in the making, and what the sign still depends on.
    struct Place {
        Vector3 position;  ///< in the coordinates of the index
        Vector3 offset;    ///< from there to the query
        double slack_mm;   ///< how far off its normal the query may stand and still count as standing on it
    };

    void addFace(std::size_t f);
    void findRegions();
    void collectItems();
    void prepareQuickSearch();
    [[nodiscard]] detail::Coverage coverageOf(std::size_t patch, const detail::ParameterBox& box) const;
    [[nodiscard]] std::array<double, 2> faceParameters(std::size_t patch, double u, double v) const;
    [[nodiscard]] const SurfaceFace& faceOfPatch(std::size_t patch) const { return faces_[places_[patch].face]; }
    [[nodiscard]] bool isInRegion(std::size_t patch, double u, double v) const;

    [[nodiscard]] double boundFrom(const Footpoint& earlier, const Vector3& query) const;
    [[nodiscard]] Nearest search(const Vector3& local, double limit_squared) const;
    template <class Take>
    void searchCell(const detail::PatchCell& cell, const Vector3& local, double limit_squared, Take take) const;

    [[nodiscard]] Footpoint footpointOf(const detail::QuickFoot& quick, const Vector3& local) const;
    [[nodiscard]] Footpoint footpointOf(const Nearest& best, const Vector3& local) const;
    [[nodiscard]] Footpoint edgeFootpointOf(const Nearest& best, const Vector3& local) const;
    void locate(std::size_t patch, double u, double v, Footpoint& out) const;
    void finish(const Place& place, bool at_border, const Vector3& local, Footpoint& out) const;
    [[nodiscard]] std::vector<Vector3> normalsAt(const Place& place, const Vector3& local) const;

    std::vector<SurfaceFace> faces_;
    std::vector<TrimEdge> edges_;
    Eigen::AlignedBox3d bounds_;
    /// The index works about this point, so that a shape far from the origin of its frame loses no digits.
    Vector3 origin_ = Vector3::Zero();
    std::vector<BezierPatch> patches_;
    std::vector<detail::PatchPlace> places_;
    std::vector<detail::PatchCell> cells_;
    std::vector<detail::TrimRegion> regions_;  ///< of each face
    std::vector<EdgePiece> edge_pieces_;
    std::vector<std::uint32_t> items_;  ///< of the tree: a cell, or behind the cells an edge piece
    detail::BoxTree tree_;
    detail::QuickSearch quick_;
};

template <class Take>
void ParametricSurface::Index::searchCell(const detail::PatchCell& cell, const Vector3& local, double limit_squared,
                                          Take take) const {
    if (cell.bounds.squaredDistance(local) > limit_squared) return;
    const BezierPatch& patch = patches_[cell.patch];
    if (cell.bounds.isConvexFor(local)) {
        const detail::PatchFoot foot =
            detail::newtonInBox(patch, cell.box, local, cell.box.middleU(), cell.box.middleV());
        if (foot.squared_mm2 < limit_squared) limit_squared = take(foot);
        // Also where `take` refused it, as outside of a trimmed face: what is nearest inside then lies on the edge, or is the
        // foot of another cell.
        if (foot.converged) return;
    }
    detail::SearchRules rules{take, {}};
    if (!regions_[places_[cell.patch].face].isWhole()) {
        rules.coverage = [&](const detail::ParameterBox& box) { return coverageOf(cell.patch, box); };
    }
    detail::searchExactly(patch, cell.box, local, limit_squared, rules);
}

}  // namespace cusp::geometry
