// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Near points are bounded through derivatives, far ones through boxes.
//
// Let the window be a rectangle of parameters around the cell, without kinks. In parameters scaled to unit columns at the
// middle of the cell, J = J₀ + E there with |E| ≤ δ, and |S″| ≤ κ. For x, y in the window and Δ between their parameters,
// |y − x| = |∫JΔ| ≥ (σ − δ)|Δ| with σ² = 1 − |cos(du, dv)|, and |n·(y − x)| ≤ κ|Δ|²/2 because n·J(x) = 0. Federer's
// quotient is then at least (σ − δ)²/κ. Half of it is promised, so that Newton's method is well inside its domain.
// For y outside the window the quotient is at least |y − x|/2.
#include "cell_reach.hpp"

#include "bernstein.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace cusp::geometry::detail {
namespace {

using Vector4 = BezierPatch::Vector4;

/// Whether the derivative across the border of two neighbours agrees all along it. Differences of this relative size
/// can hide points no farther than 1e-12 of the query's distance from the foot.
constexpr double smooth_enough = 1e-12;

/// The border two patches share, and the derivative across it on either side, as Bernstein coefficients (N, w).
struct Border {
    std::vector<Vector4> curve;
    std::vector<Vector4> left;
    std::vector<Vector4> right;
};

Border borderOf(const BezierPatch& a, double width_a, const BezierPatch& b, double width_b, bool along_u) {
    Border border;
    const int count = along_u ? a.degreeV() : a.degreeU();
    const int degree = along_u ? a.degreeU() : a.degreeV();
    for (int k = 0; k <= count; ++k) {
        const auto point = [&](const BezierPatch& p, int i) { return along_u ? p.at(i, k) : p.at(k, i); };
        border.curve.push_back(point(b, 0));
        border.left.emplace_back(degree * (point(a, degree) - point(a, degree - 1)) / width_a);
        border.right.emplace_back(degree * (point(b, 1) - point(b, 0)) / width_b);
    }
    // About the middle of the border, where rounding is least.
    const Vector4 middle = border.curve[border.curve.size() / 2];
    const Vector3 origin = middle.head<3>() / middle[3];
    for (auto* const row : {&border.curve, &border.left, &border.right}) {
        for (Vector4& p : *row) p.head<3>() -= p[3] * origin;
    }
    return border;
}

/// The jump of the derivative is (w ΔN′ − N Δw′)/w², and its numerator lies in the hull of its Bernstein coefficients, which
/// are means of the products below.
bool joinsSmoothly(const BezierPatch& a, double width_a, const BezierPatch& b, double width_b, bool along_u) {
    const Border border = borderOf(a, width_a, b, width_b, along_u);
    const std::size_t n = border.curve.size() - 1;
    double jump = 0.0;
    double size = 0.0;
    for (std::size_t k = 0; k <= 2 * n; ++k) {
        Vector3 numerator = Vector3::Zero();
        double total = 0.0;
        for (std::size_t i = k > n ? k - n : 0; i <= std::min(k, n); ++i) {
            const double share = binomial(n, i) * binomial(n, k - i);
            const Vector4 step = border.right[k - i] - border.left[k - i];
            numerator += share * (border.curve[i][3] * step.head<3>() - step[3] * border.curve[i].head<3>());
            total += share;
        }
        jump = std::max(jump, numerator.norm() / total);
    }
    double least_weight = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k <= n; ++k) {
        size = std::max({size, border.left[k].head<3>().norm(), border.right[k].head<3>().norm()});
        least_weight = std::min(least_weight, border.curve[k][3]);
    }
    return jump <= smooth_enough * size * least_weight * least_weight;
}

std::vector<bool> smoothBreaks(const SurfaceFace& face, bool along_u) {
    const std::vector<double>& breaks = along_u ? face.breaksU() : face.breaksV();
    const std::size_t columns = face.breaksV().size() - 1;
    const std::size_t across = (along_u ? face.breaksV() : face.breaksU()).size() - 1;
    std::vector<bool> smooth;
    for (std::size_t i = 0; i + 2 < breaks.size(); ++i) {
        bool all = true;
        for (std::size_t k = 0; k < across && all; ++k) {
            const std::size_t a = along_u ? i * columns + k : k * columns + i;
            const std::size_t b = along_u ? a + columns : a + 1;
            all = joinsSmoothly(face.patches()[a], breaks[i + 1] - breaks[i], face.patches()[b],
                                breaks[i + 2] - breaks[i + 1], along_u);
        }
        smooth.push_back(all);
    }
    return smooth;
}

/// Range of spans [first, last] that [low, high] touches without crossing a break that is not smooth, starting at `home`;
/// low and high are cut back to it.
std::pair<std::size_t, std::size_t> spansOf(const std::vector<double>& breaks, const std::vector<bool>& smooth,
                                            std::size_t home, double& low, double& high) {
    std::size_t first = home;
    std::size_t last = home;
    while (first > 0 && breaks[first] > low && smooth[first - 1]) --first;
    while (last + 2 < breaks.size() && breaks[last + 1] < high && smooth[last]) ++last;
    low = std::max(low, breaks[first]);
    high = std::min(high, breaks[last + 1]);
    return {first, last};
}

}  // namespace

struct ReachFinder::Window {
    std::size_t face;
    ParameterBox box;  ///< in the face's parameters
    std::size_t first_row;
    std::size_t last_row;
    std::size_t first_column;
    std::size_t last_column;
};

ReachFinder::ReachFinder(std::span<const SurfaceFace> faces, std::span<const PatchPlace> places,
                         std::span<const PatchCell> cells, const BoxTree& tree,
                         std::span<const Eigen::AlignedBox3d> boxes)
    : faces_(faces), places_(places), cells_(cells), tree_(tree), boxes_(boxes) {
    for (std::size_t c = 0; c < cells.size(); ++c) face_boxes_.push_back(faceBoxOf(c));
    first_cell_.assign(places.size() + 1, cells.size());
    for (std::size_t c = cells.size(); c-- > 0;) first_cell_[cells[c].patch] = c;
    first_patch_.assign(faces.size(), places.size());
    for (std::size_t p = places.size(); p-- > 0;) first_patch_[places[p].face] = p;
    for (const SurfaceFace& face : faces) {
        smooth_u_.push_back(smoothBreaks(face, true));
        smooth_v_.push_back(smoothBreaks(face, false));
    }
}

ParameterBox ReachFinder::faceBoxOf(std::size_t cell) const {
    const PatchPlace& place = places_[cells_[cell].patch];
    const SurfaceFace& face = faces_[place.face];
    const double u = face.breaksU()[place.row];
    const double v = face.breaksV()[place.column];
    const double width_u = face.breaksU()[place.row + 1] - u;
    const double width_v = face.breaksV()[place.column + 1] - v;
    const ParameterBox& box = cells_[cell].box;
    return {u + box.low_u * width_u, u + box.high_u * width_u, v + box.low_v * width_v, v + box.high_v * width_v};
}

ReachFinder::Window ReachFinder::windowAround(std::size_t cell, double half_widths) const {
    const PatchPlace& place = places_[cells_[cell].patch];
    const SurfaceFace& face = faces_[place.face];
    const ParameterBox& box = face_boxes_[cell];
    const double half_u = 0.5 * (box.high_u - box.low_u) * half_widths;
    const double half_v = 0.5 * (box.high_v - box.low_v) * half_widths;
    Window w{
        place.face, {box.middleU() - half_u, box.middleU() + half_u, box.middleV() - half_v, box.middleV() + half_v},
        0,          0,
        0,          0};
    std::tie(w.first_row, w.last_row) =
        spansOf(face.breaksU(), smooth_u_[place.face], place.row, w.box.low_u, w.box.high_u);
    std::tie(w.first_column, w.last_column) =
        spansOf(face.breaksV(), smooth_v_[place.face], place.column, w.box.low_v, w.box.high_v);
    return w;
}

std::vector<std::size_t> ReachFinder::cellsTouching(const Window& window) const {
    const std::size_t columns = faces_[window.face].breaksV().size() - 1;
    std::vector<std::size_t> out;
    for (std::size_t row = window.first_row; row <= window.last_row; ++row) {
        for (std::size_t column = window.first_column; column <= window.last_column; ++column) {
            const std::size_t patch = first_patch_[window.face] + row * columns + column;
            for (std::size_t c = first_cell_[patch]; c < first_cell_[patch + 1]; ++c) {
                const ParameterBox& box = face_boxes_[c];
                if (box.low_u <= window.box.high_u && box.high_u >= window.box.low_u &&
                    box.low_v <= window.box.high_v && box.high_v >= window.box.low_v) {
                    out.push_back(c);
                }
            }
        }
    }
    return out;
}

std::vector<std::size_t> ReachFinder::cellsInside(const Window& window, std::vector<std::size_t> touching) const {
    const double slack_u = 1e-12 * (window.box.high_u - window.box.low_u);
    const double slack_v = 1e-12 * (window.box.high_v - window.box.low_v);
    std::erase_if(touching, [&](std::size_t c) {
        const ParameterBox& box = face_boxes_[c];
        return box.low_u < window.box.low_u - slack_u || box.high_u > window.box.high_u + slack_u ||
               box.low_v < window.box.low_v - slack_v || box.high_v > window.box.high_v + slack_v;
    });
    return touching;
}

double ReachFinder::curvatureReach(std::size_t cell, const std::vector<std::size_t>& touching) const {
    const PatchBounds& home = cells_[cell].bounds;
    const double size_u = home.du.norm();
    const double size_v = home.dv.norm();
    if (!(size_u > 0.0 && size_v > 0.0)) return 0.0;
    const ParameterBox& home_box = face_boxes_[cell];
    const double width_u = home_box.high_u - home_box.low_u;
    const double width_v = home_box.high_v - home_box.low_v;
    double deviation = 0.0;
    double kappa = 0.0;
    for (const std::size_t c : touching) {
        const PatchBounds& b = cells_[c].bounds;
        const ParameterBox& box = face_boxes_[c];
        // From widths of that cell to parameters scaled by the columns at home.
        const double scale_u = width_u / (box.high_u - box.low_u) / size_u;
        const double scale_v = width_v / (box.high_v - box.low_v) / size_v;
        const double column_u =
            (scale_u * b.du - home.du / size_u).norm() + 0.5 * scale_u * (b.duu.largest + b.duv.largest);
        const double column_v =
            (scale_v * b.dv - home.dv / size_v).norm() + 0.5 * scale_v * (b.duv.largest + b.dvv.largest);
        deviation = std::max(deviation, std::hypot(column_u, column_v));
        kappa = std::max(kappa, std::max(scale_u * scale_u * b.duu.largest, scale_v * scale_v * b.dvv.largest) +
                                    scale_u * scale_v * b.duv.largest);
    }
    const double sigma = std::sqrt(std::max(0.0, 1.0 - std::abs(home.du.dot(home.dv)) / (size_u * size_v)));
    if (!(sigma > deviation)) return 0.0;
    return 0.5 * (sigma - deviation) * (sigma - deviation) / kappa;
}

double ReachFinder::distanceToOthers(const Eigen::AlignedBox3d& box, const std::vector<std::size_t>& inside) const {
    double least = std::numeric_limits<double>::infinity();
    const auto limit = [&] { return least; };
    tree_.visitNear(box, limit, [&](std::size_t c) {
        if (!std::binary_search(inside.begin(), inside.end(), c)) {
            least = std::min(least, box.squaredExteriorDistance(boxes_[c]));
        }
    });
    return std::sqrt(least);
}

Eigen::AlignedBox3d ReachFinder::scopeBox(std::size_t cell, const std::vector<std::size_t>& touching) const {
    const PatchBounds& home = cells_[cell].bounds;
    const ParameterBox& home_box = face_boxes_[cell];
    double duu = 0.0;
    double duv = 0.0;
    double dvv = 0.0;
    for (const std::size_t c : touching) {
        const PatchBounds& b = cells_[c].bounds;
        const ParameterBox& box = face_boxes_[c];
        const double ratio_u = (home_box.high_u - home_box.low_u) / (box.high_u - box.low_u);
        const double ratio_v = (home_box.high_v - home_box.low_v) / (box.high_v - box.low_v);
        duu = std::max(duu, ratio_u * ratio_u * b.duu.largest);
        duv = std::max(duv, ratio_u * ratio_v * b.duv.largest);
        dvv = std::max(dvv, ratio_v * ratio_v * b.dvv.largest);
    }
    // Taylor's formula about the middle; the scope ends `a` widths from it.
    constexpr double a = 0.5 * reach_scope;
    const double rest = 0.5 * a * a * (duu + 2.0 * duv + dvv);
    const Vector3 extent = a * (home.du.cwiseAbs() + home.dv.cwiseAbs()) + Vector3::Constant(rest);
    return {home.center - extent, home.center + extent};
}

double ReachFinder::reachOf(std::size_t cell) const {
    const Eigen::AlignedBox3d scope = scopeBox(cell, cellsTouching(windowAround(cell, reach_scope)));
    double reach = 0.0;
    // A wide window leaves fewer others near, a narrow one bends less.
    for (const double half_widths : {3.0, 5.0, 7.0, 11.0}) {
        const Window window = windowAround(cell, half_widths);
        const std::vector<std::size_t> touching = cellsTouching(window);
        const double bent = curvatureReach(cell, touching);
        if (bent <= reach) break;
        reach = std::max(reach, std::min(bent, 0.5 * distanceToOthers(scope, cellsInside(window, touching))));
    }
    return reach;
}

}  // namespace cusp::geometry::detail
