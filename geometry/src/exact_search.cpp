// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// |S − query|² is a quotient of two polynomials, |N|² / w². With all weights positive it is at least the smallest quotient
// of their Bernstein coefficients; the gap shrinks with the square of the piece's size. Unlike bounds by boxes, this one is
// exact where the distance is constant: a query at the centre of a sphere is answered at once.
#include "exact_search.hpp"

#include "distance_polynomial.hpp"
#include "patch_bounds.hpp"
#include "patch_cells.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <utility>

namespace cusp::geometry::detail {
namespace {

/// A piece that may still hold something nearer; its net is taken about the query.
struct Piece {
    BezierPatch net;
    ParameterBox box;
    DistancePolynomial distance;

    Piece(BezierPatch part, const ParameterBox& where) : net(std::move(part)), box(where), distance(net) {}
    bool operator<(const Piece& other) const {
        return distance.least_squared_mm2 > other.distance.least_squared_mm2;  // the nearest first
    }
};

bool canImprove(double least_squared, double limit_squared) {
    constexpr double rounding = 4e-15;
    const double enough = std::max(0.0, std::sqrt(limit_squared) * (1.0 - rounding) - search_tolerance_mm);
    return least_squared < enough * enough;
}

class Search {
public:
    Search(const BezierPatch& patch, const Vector3& query, double limit_squared, const SearchRules& rules)
        : patch_(patch), query_(query), limit_(limit_squared), rules_(rules) {}

    void run(const ParameterBox& box) {
        open_.emplace(partOf(patch_, box).about(patch_.origin() + query_), box);
        while (!open_.empty() && canImprove(open_.top().distance.least_squared_mm2, limit_)) {
            const Piece piece = open_.top();
            open_.pop();
            if (const auto bounds = boundsUnlessSettled(piece)) branch(piece, *bounds);
        }
    }

private:
    void offer(const PatchFoot& foot) {
        if (foot.squared_mm2 < limit_) limit_ = rules_.take(foot);
    }

    /// Tries to finish with the piece; whatever is found on the way lowers the limit. Nothing when it is done with, else what
    /// is known of it.
    std::optional<PatchBounds> boundsUnlessSettled(const Piece& piece) {
        const auto [s, t] = piece.distance.likelyPlace();
        const double u = piece.box.low_u + s * (piece.box.high_u - piece.box.low_u);
        const double v = piece.box.low_v + t * (piece.box.high_v - piece.box.low_v);
        const PatchFoot foot = newtonInBox(patch_, piece.box, query_, u, v);
        offer(foot);
        if (!canImprove(piece.distance.least_squared_mm2, limit_)) return std::nullopt;
        const PatchBounds bounds = boundPatch(piece.net);
        // The origin of the net is the query.
        if (foot.converged && bounds.isConvexFor(Vector3::Zero())) return std::nullopt;
        const bool partly = rules_.coverage && rules_.coverage(piece.box) == Coverage::Partly;
        if (2.0 * bounds.radius_mm < (partly ? edge_width_mm : search_tolerance_mm)) return std::nullopt;
        return bounds;
    }

    void branch(const Piece& piece, const PatchBounds& bounds) {
        const bool by_length = piece.distance.bend_u == piece.distance.bend_v;
        const bool along_u =
            by_length ? bounds.length_u_mm >= bounds.length_v_mm : piece.distance.bend_u > piece.distance.bend_v;
        auto [left, right] = along_u ? piece.net.splitU() : piece.net.splitV();
        ParameterBox first = piece.box;
        ParameterBox second = piece.box;
        (along_u ? first.high_u : first.high_v) = along_u ? piece.box.middleU() : piece.box.middleV();
        (along_u ? second.low_u : second.low_v) = along_u ? piece.box.middleU() : piece.box.middleV();
        push(std::move(left), first);
        push(std::move(right), second);
    }

    void push(BezierPatch part, const ParameterBox& box) {
        if (rules_.coverage && rules_.coverage(box) == Coverage::Outside) return;
        Piece piece(std::move(part), box);
        if (canImprove(piece.distance.least_squared_mm2, limit_)) open_.push(std::move(piece));
    }

    const BezierPatch& patch_;
    Vector3 query_;
    double limit_;
    const SearchRules& rules_;
    std::priority_queue<Piece> open_;
};

}  // namespace

void searchExactly(const BezierPatch& patch, const ParameterBox& box, const Vector3& query, double limit_squared,
                   const SearchRules& rules) {
    Search(patch, query, limit_squared, rules).run(box);
}

}  // namespace cusp::geometry::detail
