// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Drop-cutter on triangles: facets and edges within a tree of boxes, best bound first.
#include "drop_profile.hpp"

#include <cusp/optimizer/tilt/drop_cutter.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace cusp::tilt {

using geometry::Vector3;

namespace {

constexpr double none = -std::numeric_limits<double>::infinity();
constexpr std::uint32_t leaf_triangles = 2;
constexpr std::size_t most_depth = 64;

/// A triangle with what a drop asks of it. Edge k goes from corner k to the next; of an edge that several triangles share
/// only one looks at it.
struct Facet {
    std::array<Vector3, 3> corner;
    Vector3 normal = Vector3::Zero();  ///< unit, up; zero where the triangle stands upright or has no area
    double top = 0.0;
    std::uint32_t id = 0;
    std::array<bool, 3> owns_edge{};
};

struct Node {
    double min_x = 0.0;
    double min_y = 0.0;
    double max_x = 0.0;
    double max_y = 0.0;
    double top = 0.0;
    std::uint32_t second = 0;  ///< the first child follows its parent; 0 in a leaf
    std::uint32_t first_facet = 0;
    std::uint32_t facets = 0;
};

double gap(double low, double value, double high) { return std::max({low - value, value - high, 0.0}); }

std::vector<Facet> facetsOf(const geometry::TriangleMesh& mesh) {
    std::vector<std::pair<std::array<std::uint32_t, 2>, std::uint32_t>> edges;
    edges.reserve(mesh.triangles.size() * 3);
    std::vector<Facet> facets(mesh.triangles.size());
    for (std::uint32_t id = 0; id < facets.size(); ++id) {
        const auto& triangle = mesh.triangles[id];
        Facet& facet = facets[id];
        facet.id = id;
        for (std::size_t k = 0; k < 3; ++k) {
            facet.corner[k] = mesh.vertices[triangle[k]];
            const auto [low, high] = std::minmax(triangle[k], triangle[(k + 1) % 3]);
            edges.push_back({{low, high}, static_cast<std::uint32_t>(3 * id + k)});
        }
        facet.top = std::max({facet.corner[0].z(), facet.corner[1].z(), facet.corner[2].z()});
        const Vector3 cross = (facet.corner[1] - facet.corner[0]).cross(facet.corner[2] - facet.corner[0]);
        // Seen from above such a triangle is a line: its edges say everything.
        constexpr double upright = 1e-12;
        if (std::abs(cross.z()) > upright * cross.norm()) facet.normal = cross / std::copysign(cross.norm(), cross.z());
    }
    std::sort(edges.begin(), edges.end());
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (i == 0 || edges[i].first != edges[i - 1].first)
            facets[edges[i].second / 3].owns_edge[edges[i].second % 3] = true;
    return facets;
}

}  // namespace

struct MeshDrop::Index {
    Index(const geometry::TriangleMesh& mesh, const geometry::Cutter& shape, detail::DropProfile lower_side)
        : cutter(shape), profile(lower_side), facets(facetsOf(mesh)) {
        nodes.reserve(2 * facets.size());
        for (const Facet& facet : facets)
            for (const Vector3& corner : facet.corner) box.extend(corner);
        build(0, static_cast<std::uint32_t>(facets.size()));
        place_of.resize(facets.size());
        for (std::uint32_t i = 0; i < facets.size(); ++i) place_of[facets[i].id] = i;
    }

    geometry::Cutter cutter;
    detail::DropProfile profile;
    std::vector<Facet> facets;
    std::vector<std::uint32_t> place_of;  ///< of a triangle of the mesh, in `facets`
    std::vector<Node> nodes;
    Eigen::AlignedBox3d box;

    void build(std::uint32_t first, std::uint32_t count) {
        Eigen::AlignedBox3d hull;
        Eigen::AlignedBox3d centers;
        for (std::uint32_t i = first; i < first + count; ++i) {
            for (const Vector3& corner : facets[i].corner) hull.extend(corner);
            centers.extend((facets[i].corner[0] + facets[i].corner[1] + facets[i].corner[2]) / 3.0);
        }
        const std::size_t here = nodes.size();
        nodes.push_back(
            {hull.min().x(), hull.min().y(), hull.max().x(), hull.max().y(), hull.max().z(), 0, first, count});
        if (count <= leaf_triangles) return;
        Eigen::Index axis = 0;
        centers.sizes().maxCoeff(&axis);
        const std::uint32_t half = count / 2;
        const auto begin = facets.begin() + first;
        std::nth_element(begin, begin + half, begin + count, [axis](const Facet& a, const Facet& b) {
            const double left = a.corner[0][axis] + a.corner[1][axis] + a.corner[2][axis];
            const double right = b.corner[0][axis] + b.corner[1][axis] + b.corner[2][axis];
            return left != right ? left < right : a.id < b.id;
        });
        build(first, half);
        nodes[here].second = static_cast<std::uint32_t>(nodes.size());
        build(first + half, count - half);
    }

    /// No tip can be stopped higher by anything in the node.
    [[nodiscard]] double bound(const Node& node, double x, double y) const {
        const double across = gap(node.min_x, x, node.max_x);
        const double along = gap(node.min_y, y, node.max_y);
        const double squared = across * across + along * along;
        if (squared > profile.radius() * profile.radius()) return none;
        return node.top - profile.height(std::sqrt(squared));
    }

    void onEdge(const Vector3& from, const Vector3& to, double x, double y, std::uint32_t id, DropContact& best) const;
    [[nodiscard]] bool onFacet(const Facet& facet, double x, double y, DropContact& best) const;
    void onTriangle(const Facet& facet, double x, double y, DropContact& best) const {
        if (onFacet(facet, x, y, best)) return;
        for (std::size_t k = 0; k < 3; ++k)
            if (facet.owns_edge[k]) onEdge(facet.corner[k], facet.corner[(k + 1) % 3], x, y, facet.id, best);
    }
    void search(double x, double y, DropContact& best) const;
};

/// The tip height over the points of an edge is concave, so the best point of the whole line, brought to the nearest end
/// of what of the edge lies below the cutter, is the best of the edge, corners included.
void MeshDrop::Index::onEdge(const Vector3& from, const Vector3& to, double x, double y, std::uint32_t id,
                             DropContact& best) const {
    const double dx = to.x() - from.x();
    const double dy = to.y() - from.y();
    const double length = std::sqrt(dx * dx + dy * dy);
    const double rise = to.z() - from.z();
    const auto take = [&](const Vector3& point, double rho) {
        const double tip = point.z() - profile.height(rho);
        if (tip > best.tip_z_mm) best = {tip, point, id};
    };
    const double fx = from.x() - x;
    const double fy = from.y() - y;
    const double radius = profile.radius();
    constexpr double upright_mm = 1e-12;
    if (length <= upright_mm) {
        const Vector3& higher = rise > 0.0 ? to : from;
        const double rho = std::hypot(higher.x() - x, higher.y() - y);
        if (rho <= radius) take(higher, rho);
        return;
    }
    const double aside = std::abs(fx * dy - fy * dx) / length;
    if (aside > radius) return;
    if (std::max(from.z(), to.z()) - profile.height(aside) <= best.tip_z_mm) return;
    const double start = (fx * dx + fy * dy) / length;
    const double half = std::sqrt((radius - aside) * (radius + aside));
    const double low = std::max(start, -half);
    const double high = std::min(start + length, half);
    if (low > high) return;
    const double slope = rise / length;
    const double s = std::clamp(std::copysign(profile.lineContact(aside, std::abs(slope)), slope), low, high);
    const double t = std::clamp((s - start) / length, 0.0, 1.0);
    take(from + t * (to - from), std::min(radius, std::sqrt(aside * aside + s * s)));
}

/// Whether the plane of the triangle is met within the triangle: then nothing else of it stops the cutter higher.
bool MeshDrop::Index::onFacet(const Facet& facet, double x, double y, DropContact& best) const {
    const Vector3& n = facet.normal;
    if (n.z() <= 0.0) return false;
    const double across = std::sqrt(n.x() * n.x() + n.y() * n.y());
    const double rho = profile.planeContact(across, n.z());
    Vector3 contact(x, y, 0.0);
    if (rho > 0.0) {
        contact.x() -= n.x() / across * rho;
        contact.y() -= n.y() / across * rho;
    }
    const Vector3& a = facet.corner[0];
    contact.z() = a.z() - ((contact.x() - a.x()) * n.x() + (contact.y() - a.y()) * n.y()) / n.z();
    const double tip = contact.z() - profile.height(rho);
    // Lower than what is known: whether inside or not, the plane bounds the triangle from above.
    if (tip <= best.tip_z_mm) return true;
    double turn = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector3& from = facet.corner[k];
        const Vector3& to = facet.corner[(k + 1) % 3];
        const double side =
            (to.x() - from.x()) * (contact.y() - from.y()) - (to.y() - from.y()) * (contact.x() - from.x());
        if (side * turn < 0.0) return false;
        if (side != 0.0) turn = side;
    }
    best = {tip, contact, facet.id};
    return true;
}

void MeshDrop::Index::search(double x, double y, DropContact& best) const {
    struct Open {
        std::uint32_t node;
        double bound;
    };
    std::array<Open, most_depth> stack;
    std::size_t open = 0;
    stack[open++] = {0, bound(nodes[0], x, y)};
    while (open > 0) {
        const Open here = stack[--open];
        if (here.bound <= best.tip_z_mm) continue;
        const Node& node = nodes[here.node];
        if (node.second == 0) {
            for (std::uint32_t i = node.first_facet; i < node.first_facet + node.facets; ++i)
                onTriangle(facets[i], x, y, best);
            continue;
        }
        Open left{here.node + 1, bound(nodes[here.node + 1], x, y)};
        Open right{node.second, bound(nodes[node.second], x, y)};
        if (left.bound > right.bound) std::swap(left, right);
        if (left.bound > best.tip_z_mm) stack[open++] = left;
        if (right.bound > best.tip_z_mm) stack[open++] = right;
    }
}

base::Result<MeshDrop> MeshDrop::make(const geometry::TriangleMesh& mesh, const geometry::Cutter& cutter) {
    auto profile = detail::DropProfile::make(cutter);
    if (!profile) return base::fail(profile.error());
    if (mesh.triangles.empty()) return base::fail("tilt.empty-mesh", "the mesh has no triangles");
    return MeshDrop(std::make_unique<const Index>(mesh, cutter, *profile));
}

MeshDrop::MeshDrop(std::unique_ptr<const Index> index) : index_(std::move(index)) {}
MeshDrop::MeshDrop(MeshDrop&&) noexcept = default;
MeshDrop& MeshDrop::operator=(MeshDrop&&) noexcept = default;
MeshDrop::~MeshDrop() = default;

std::optional<DropContact> MeshDrop::drop(double x_mm, double y_mm, std::uint32_t hint) const {
    DropContact best{none, Vector3::Zero(), DropContact::no_place};
    if (hint < index_->facets.size()) index_->onTriangle(index_->facets[index_->place_of[hint]], x_mm, y_mm, best);
    index_->search(x_mm, y_mm, best);
    if (best.place == DropContact::no_place) return std::nullopt;
    return best;
}

Eigen::AlignedBox3d MeshDrop::bounds() const { return index_->box; }
const geometry::Cutter& MeshDrop::cutter() const { return index_->cutter; }

}  // namespace cusp::tilt
