// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Meshes by rasterising triangles across the rays; other shapes by walking along them.
#include "solid_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cusp::simulation {

using geometry::Vector3;

namespace {

/// A triangle seen along the rays.
struct Flat {
    std::array<std::uint32_t, 3> corner;
    std::array<double, 3> u, v, height;
};

/// > 0 when the point is to the left of the edge. Both triangles at an edge compute the same number with opposite signs, and
/// 0 goes to one of them: the edge is always taken from its lower vertex.
bool leftOf(const Flat& flat, std::size_t k, double u, double v) {
    std::size_t a = k;
    std::size_t b = (k + 1) % 3;
    const bool swap = flat.corner[a] > flat.corner[b];
    if (swap) std::swap(a, b);
    const double side = (flat.u[b] - flat.u[a]) * (v - flat.v[a]) - (flat.v[b] - flat.v[a]) * (u - flat.u[a]);
    return (side >= 0.0) != swap;
}

/// First and end of the nodes between two coordinates.
std::pair<std::size_t, std::size_t> nodesBetween(const DexelLattice& lattice, int axis, double low, double high) {
    const double base = lattice.box.min()[axis];
    const double step = lattice.step_mm[axis];
    const auto bounded = [&](double i) {
        return static_cast<std::size_t>(std::clamp(i, 0.0, static_cast<double>(lattice.count[axis])));
    };
    // One node more on each side; the exact test decides.
    return {bounded(std::floor((low - base) / step - 0.5)), bounded(std::ceil((high - base) / step - 0.5) + 1.0)};
}

}  // namespace

template <class Visit>
void MeshRays::rasterise(const geometry::TriangleMesh& mesh, const DexelLattice& lattice, const Visit& visit) const {
    const int u = (axis_ + 1) % 3;
    const int v = (axis_ + 2) % 3;
    for (const auto& triangle : mesh.triangles) {
        Flat flat;
        flat.corner = triangle;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3& at = mesh.vertices[triangle[k]];
            flat.u[k] = at[u];
            flat.v[k] = at[v];
            flat.height[k] = at[axis_];
        }
        const double double_area =
            (flat.u[1] - flat.u[0]) * (flat.v[2] - flat.v[0]) - (flat.v[1] - flat.v[0]) * (flat.u[2] - flat.u[0]);
        const auto [first_u, end_u] = nodesBetween(lattice, u, *std::min_element(flat.u.begin(), flat.u.end()),
                                                   *std::max_element(flat.u.begin(), flat.u.end()));
        const auto [first_v, end_v] = nodesBetween(lattice, v, *std::min_element(flat.v.begin(), flat.v.end()),
                                                   *std::max_element(flat.v.begin(), flat.v.end()));
        for (std::size_t i = first_u; i < end_u; ++i)
            for (std::size_t j = first_v; j < end_v; ++j) {
                const double at_u = lattice.node(u, i);
                const double at_v = lattice.node(v, j);
                const bool left = leftOf(flat, 0, at_u, at_v);
                if (leftOf(flat, 1, at_u, at_v) != left || leftOf(flat, 2, at_u, at_v) != left) continue;
                double height = flat.height[0];
                if (double_area != 0.0) {
                    const double b =
                        ((at_u - flat.u[0]) * (flat.v[2] - flat.v[0]) - (at_v - flat.v[0]) * (flat.u[2] - flat.u[0])) /
                        double_area;
                    const double c =
                        ((flat.u[1] - flat.u[0]) * (at_v - flat.v[0]) - (flat.v[1] - flat.v[0]) * (at_u - flat.u[0])) /
                        double_area;
                    height += b * (flat.height[1] - flat.height[0]) + c * (flat.height[2] - flat.height[0]);
                }
                const auto [low, high] = std::minmax_element(flat.height.begin(), flat.height.end());
                // Counter-clockwise seen against the rays: they leave the material here.
                visit(i * across_ + j, Crossing{std::clamp(height, *low, *high), left ? -1 : 1});
            }
    }
}

MeshRays::MeshRays(const geometry::TriangleMesh& mesh, const DexelLattice& lattice, int axis)
    : axis_(axis), across_(lattice.count[(axis + 2) % 3]), first_(lattice.count[(axis + 1) % 3] * across_ + 1) {
    rasterise(mesh, lattice, [&](std::size_t ray, const Crossing&) { ++first_[ray + 1]; });
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    crossings_.resize(first_.back());
    std::vector<std::uint64_t> next(first_.begin(), first_.end() - 1);
    rasterise(mesh, lattice, [&](std::size_t ray, const Crossing& crossing) { crossings_[next[ray]++] = crossing; });
    for (std::size_t ray = 0; ray + 1 < first_.size(); ++ray)
        std::sort(crossings_.begin() + static_cast<std::ptrdiff_t>(first_[ray]),
                  crossings_.begin() + static_cast<std::ptrdiff_t>(first_[ray + 1]),
                  [](const Crossing& a, const Crossing& b) {
                      return std::pair(a.at_mm, -a.turn) < std::pair(b.at_mm, -b.turn);
                  });
}

void MeshRays::spans(std::size_t u, std::size_t v, std::vector<DexelSpan>& out) const {
    const std::size_t ray = u * across_ + v;
    int inside = 0;
    double from = 0.0;
    for (std::uint64_t i = first_[ray]; i < first_[ray + 1]; ++i) {
        const Crossing& crossing = crossings_[i];
        if (inside == 0 && crossing.turn > 0) from = crossing.at_mm;
        inside += crossing.turn;
        if (inside != 0 || crossing.turn > 0 || !(crossing.at_mm > from)) continue;
        if (!out.empty() && out.back().to_mm == from)
            out.back().to_mm = crossing.at_mm;
        else
            out.push_back({from, crossing.at_mm, DexelSpan::no_cut, DexelSpan::no_cut});
    }
}

void shapeSpans(const geometry::NominalShape& shape, const DexelLattice& lattice, int axis, const Vector3& origin,
                std::vector<DexelSpan>& out) {
    const double end = lattice.box.max()[axis];
    const double least = 1e-3 * lattice.step_mm[axis];
    const auto distance = [&](double s) {
        Vector3 at = origin;
        at[axis] = s;
        return shape.closest(at).distance_mm;
    };
    double s = lattice.box.min()[axis];
    double here = distance(s);
    double from = s;
    while (s < end) {
        const double next = std::min(end, s + std::max(std::abs(here), least));
        const double there = distance(next);
        if ((here < 0.0) != (there < 0.0)) {
            // The change lies in a stretch no longer than the distance at its start: secant, kept between both ends.
            double low = s;
            double high = next;
            double at_low = here;
            double at_high = there;
            for (int i = 0; i < 40 && high - low > 1e-9; ++i) {
                const double share = i % 3 == 2 ? 0.5 : std::clamp(at_low / (at_low - at_high), 0.01, 0.99);
                const double middle = low + share * (high - low);
                const double value = distance(middle);
                ((value < 0.0) == (here < 0.0) ? low : high) = middle;
                ((value < 0.0) == (here < 0.0) ? at_low : at_high) = value;
                if (std::abs(value) < 1e-9) break;
            }
            const double change = 0.5 * (low + high);
            if (here < 0.0)
                out.push_back({from, change, DexelSpan::no_cut, DexelSpan::no_cut});
            else
                from = change;
        }
        s = next;
        here = there;
    }
    if (here < 0.0 && end > from) out.push_back({from, end, DexelSpan::no_cut, DexelSpan::no_cut});
}

}  // namespace cusp::simulation
