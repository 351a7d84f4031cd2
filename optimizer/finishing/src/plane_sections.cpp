// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Marching squares on a grid of heights, each point then brought onto the plane by Newton's method.
#include "plane_sections.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace cusp::finishing {

namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
constexpr int cells_per_patch = 32;
constexpr int cells_at_most = 160;

std::vector<double> gridOf(const std::vector<double>& breaks) {
    const auto patches = static_cast<int>(breaks.size()) - 1;
    const int cells = std::max(2, std::min(cells_per_patch, cells_at_most / patches));
    std::vector<double> out;
    for (std::size_t p = 0; p + 1 < breaks.size(); ++p)
        for (int i = 0; i < cells; ++i)
            out.push_back(breaks[p] + (breaks[p + 1] - breaks[p]) * static_cast<double>(i) / cells);
    out.push_back(breaks.back());
    return out;
}

}  // namespace

PlaneSections::PlaneSections(const geometry::SurfaceFace& face, const Vector3& normal)
    : face_(&face), normal_(normal), grid_u_(gridOf(face.breaksU())), grid_v_(gridOf(face.breaksV())) {
    heights_.reserve(grid_u_.size() * grid_v_.size());
    for (const double u : grid_u_)
        for (const double v : grid_v_) heights_.push_back(heightOf({u, v}));
    refineRange();
}

double PlaneSections::heightOf(const FaceParameters& uv) const {
    return normal_.dot(face_->evaluate(uv[0], uv[1]).position);
}

/// Climbs from the highest and lowest corner by halving steps: an extremum inside a cell lies within one step of a corner.
void PlaneSections::refineRange() {
    for (const double sign : {-1.0, 1.0}) {
        std::size_t best = 0;
        for (std::size_t k = 1; k < heights_.size(); ++k)
            if (sign * heights_[k] > sign * heights_[best]) best = k;
        FaceParameters at = cornerOf(best);
        double height = heights_[best];
        for (double share = 1.0; share > 1e-9; share /= 2.0) {
            const double du = share * (grid_u_[1] - grid_u_[0]);
            const double dv = share * (grid_v_[1] - grid_v_[0]);
            for (const FaceParameters& step : {FaceParameters{du, 0.0}, {-du, 0.0}, {0.0, dv}, {0.0, -dv}}) {
                const FaceParameters next{std::clamp(at[0] + step[0], grid_u_.front(), grid_u_.back()),
                                          std::clamp(at[1] + step[1], grid_v_.front(), grid_v_.back())};
                const double there = heightOf(next);
                if (sign * there <= sign * height) continue;
                at = next;
                height = there;
            }
        }
        range_[sign > 0.0 ? 1 : 0] = height;
    }
}

FaceParameters PlaneSections::cornerOf(std::size_t corner) const {
    return {grid_u_[corner / grid_v_.size()], grid_v_[corner % grid_v_.size()]};
}

// Edges are numbered by the corner they start at: 2c runs along u, 2c + 1 along v.
std::array<std::size_t, 2> PlaneSections::endsOf(std::size_t edge) const {
    const std::size_t corner = edge / 2;
    return {corner, edge % 2 == 0 ? corner + grid_v_.size() : corner + 1};
}

FaceParameters PlaneSections::onPlane(FaceParameters uv, double height_mm) const {
    constexpr double close_mm = 1e-10;
    for (int i = 0; i < 12; ++i) {
        const auto at = face_->evaluate(uv[0], uv[1]);
        const double miss = normal_.dot(at.position) - height_mm;
        if (std::abs(miss) < close_mm) break;
        // The steepest way down the surface, so that a sample does not slide along the section.
        const double e = at.du.squaredNorm();
        const double f = at.du.dot(at.dv);
        const double g = at.dv.squaredNorm();
        const double a = normal_.dot(at.du);
        const double b = normal_.dot(at.dv);
        const double det = e * g - f * f;
        if (!(det > 0.0)) break;
        const double su = (g * a - f * b) / det;
        const double sv = (e * b - f * a) / det;
        const double slope = a * su + b * sv;
        if (!(slope > 1e-14)) break;
        uv = {std::clamp(uv[0] - miss * su / slope, grid_u_.front(), grid_u_.back()),
              std::clamp(uv[1] - miss * sv / slope, grid_v_.front(), grid_v_.back())};
    }
    return uv;
}

FaceParameters PlaneSections::crossing(std::size_t edge, double height_mm) const {
    const auto ends = endsOf(edge);
    const FaceParameters from = cornerOf(ends[0]);
    const FaceParameters to = cornerOf(ends[1]);
    double low = 0.0;
    double high = 1.0;
    const bool above = heights_[ends[0]] >= height_mm;
    double x = (height_mm - heights_[ends[0]]) / (heights_[ends[1]] - heights_[ends[0]]);
    FaceParameters at{};
    for (int i = 0; i < 60; ++i) {
        at = {std::lerp(from[0], to[0], x), std::lerp(from[1], to[1], x)};
        const double miss = heightOf(at) - height_mm;
        if (std::abs(miss) < 1e-10) break;
        ((miss >= 0.0) == above ? low : high) = x;
        // Newton along the edge, halving where it leaves the bracket.
        const auto point = face_->evaluate(at[0], at[1]);
        const double slope = normal_.dot((to[0] - from[0]) * point.du + (to[1] - from[1]) * point.dv);
        const double next = slope != 0.0 ? x - miss / slope : low;
        x = next > low && next < high ? next : (low + high) / 2.0;
    }
    return at;
}

void PlaneSections::joinCell(std::size_t i, std::size_t j, double height_mm,
                             std::vector<std::array<std::size_t, 2>>& neighbours) const {
    const std::size_t rows = grid_v_.size();
    const std::size_t corner = i * rows + j;
    // Around the cell; edge k joins corner k to corner k + 1.
    const std::array<std::size_t, 4> corners{corner, corner + rows, corner + rows + 1, corner + 1};
    const std::array<std::size_t, 4> edges{2 * corner, 2 * (corner + rows) + 1, 2 * (corner + 1), 2 * corner + 1};
    std::array<std::size_t, 4> cut{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k)
        if ((heights_[corners[k]] >= height_mm) != (heights_[corners[(k + 1) % 4]] >= height_mm)) cut[count++] = k;
    const auto join = [&](std::size_t a, std::size_t b) {
        for (const auto& [from, to] : {std::pair{edges[a], edges[b]}, {edges[b], edges[a]}})
            neighbours[from][neighbours[from][0] == none ? 0 : 1] = to;
    };
    if (count == 2) return join(cut[0], cut[1]);
    if (count != 4) return;
    // A saddle: the middle says which corners belong together.
    const FaceParameters low = cornerOf(corners[0]);
    const FaceParameters high = cornerOf(corners[2]);
    const bool middle = heightOf({(low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0}) >= height_mm;
    if (middle == (heights_[corners[0]] >= height_mm)) {
        join(0, 1);
        join(2, 3);
    } else {
        join(3, 0);
        join(1, 2);
    }
}

std::vector<PlaneSections::Chain> PlaneSections::chains(double height_mm) const {
    std::vector<std::array<std::size_t, 2>> neighbours(2 * heights_.size(), {none, none});
    for (std::size_t i = 0; i + 1 < grid_u_.size(); ++i)
        for (std::size_t j = 0; j + 1 < grid_v_.size(); ++j) joinCell(i, j, height_mm, neighbours);
    std::vector<bool> seen(neighbours.size(), false);
    std::vector<Chain> out;
    const auto walk = [&](std::size_t start) {
        Chain chain;
        std::size_t before = none;
        for (std::size_t at = start; at != none && !seen[at];) {
            seen[at] = true;
            chain.push_back(crossing(at, height_mm));
            const auto& next = neighbours[at];
            const std::size_t onward = next[0] != before && next[0] != none ? next[0] : next[1];
            before = at;
            at = onward;
            if (at == start) chain.push_back(chain.front());
        }
        out.push_back(std::move(chain));
    };
    for (std::size_t edge = 0; edge < neighbours.size(); ++edge)  // open curves from an end, then closed ones
        if (neighbours[edge][0] != none && neighbours[edge][1] == none && !seen[edge]) walk(edge);
    for (std::size_t edge = 0; edge < neighbours.size(); ++edge)
        if (neighbours[edge][0] != none && !seen[edge]) walk(edge);
    return out;
}

/// How far along a chain each of its points is: by the parameter of the face that ascends or descends all along it (the one
/// that covers more of the face, where both do), as on a pass along a parameter; by length where neither does.
std::vector<double> PlaneSections::measure(const Chain& chain) const {
    const std::array<double, 2> widths{grid_u_.back() - grid_u_.front(), grid_v_.back() - grid_v_.front()};
    std::optional<std::size_t> by;
    for (std::size_t k = 0; k < 2; ++k) {
        const double sign = chain.back()[k] >= chain.front()[k] ? 1.0 : -1.0;
        bool steady = true;
        for (std::size_t i = 1; i < chain.size(); ++i) steady = steady && sign * (chain[i][k] - chain[i - 1][k]) > 0.0;
        const auto covered = [&](std::size_t j) { return std::abs(chain.back()[j] - chain.front()[j]) / widths[j]; };
        if (steady && (!by || covered(k) > covered(*by))) by = k;
    }
    std::vector<double> along(chain.size(), 0.0);
    for (std::size_t i = 1; i < chain.size(); ++i) {
        const auto place = [&](std::size_t at) { return face_->evaluate(chain[at][0], chain[at][1]).position; };
        along[i] = along[i - 1] + (by ? std::abs(chain[i][*by] - chain[i - 1][*by]) : (place(i) - place(i - 1)).norm());
    }
    return along;
}

PlaneSections::Chain PlaneSections::evenly(const Chain& chain, double height_mm, std::size_t samples,
                                           double least_mm) const {
    double length = 0.0;
    for (std::size_t i = 1; i < chain.size(); ++i)
        length += (face_->evaluate(chain[i][0], chain[i][1]).position -
                   face_->evaluate(chain[i - 1][0], chain[i - 1][1]).position)
                      .norm();
    if (!(length > least_mm)) return {};
    const std::vector<double> along = measure(chain);
    Chain out;
    std::size_t k = 0;
    for (std::size_t s = 0; s < samples; ++s) {
        const double wanted = along.back() * static_cast<double>(s) / static_cast<double>(samples - 1);
        while (k + 2 < chain.size() && along[k + 1] < wanted) ++k;
        const double step = along[k + 1] - along[k];
        const double x = step > 0.0 ? std::clamp((wanted - along[k]) / step, 0.0, 1.0) : 0.0;
        const FaceParameters guess{std::lerp(chain[k][0], chain[k + 1][0], x),
                                   std::lerp(chain[k][1], chain[k + 1][1], x)};
        const bool end = s == 0 || s + 1 == samples;  // on the boundary of the face, and stays there
        out.push_back(end ? (s == 0 ? chain.front() : chain.back()) : onPlane(guess, height_mm));
    }
    return out;
}

std::vector<std::vector<FaceParameters>> PlaneSections::at(double height_mm, std::size_t samples,
                                                           double least_mm) const {
    std::vector<std::vector<FaceParameters>> out;
    for (const Chain& chain : chains(height_mm)) {
        if (chain.size() < 2) continue;
        Chain curve = evenly(chain, height_mm, samples, least_mm);
        if (!curve.empty()) out.push_back(std::move(curve));
    }
    return out;
}

}  // namespace cusp::finishing
