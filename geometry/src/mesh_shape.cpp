// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Triangles in a box tree; pseudo-normals of edges and corners worked out beforehand.
#include "box_tree.hpp"
#include "triangle_point.hpp"

#include <cusp/geometry/mesh_shape.hpp>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>
#include <vector>

namespace cusp::geometry {
namespace {

using detail::TriangleFeature;
using detail::TrianglePoint;

/// How far off its normal a query may stand and still count as standing on it, and as much per millimetre of distance.
constexpr double along_normal_mm = 1e-9;

/// What lies at each side of a triangle, side k from corner k to the next.
struct Sides {
    std::array<Vector3, 3> pseudo_normal;
    std::array<bool, 3> open{};
};

struct Candidate {
    std::size_t triangle = 0;
    TrianglePoint point;
    Vector3 position;
    double squared_mm2 = std::numeric_limits<double>::infinity();
};

}  // namespace

class MeshShape::Index {
public:
    explicit Index(TriangleMesh mesh) : mesh_(std::move(mesh)) {
        for (const Vector3& vertex : mesh_.vertices) bounds_.extend(vertex);
        origin_ = bounds_.center();
        local_.reserve(mesh_.vertices.size());
        for (const Vector3& vertex : mesh_.vertices) local_.emplace_back(vertex - origin_);
        std::vector<Eigen::AlignedBox3d> boxes;
        boxes.reserve(mesh_.triangles.size());
        for (const TriangleMesh::Triangle& t : mesh_.triangles) {
            boxes.emplace_back(local_[t[0]]);
            boxes.back().extend(local_[t[1]]);
            boxes.back().extend(local_[t[2]]);
        }
        tree_ = detail::BoxTree(boxes);
        findNormals();
        joinSides();
    }

    [[nodiscard]] const TriangleMesh& mesh() const { return mesh_; }
    [[nodiscard]] const Eigen::AlignedBox3d& bounds() const { return bounds_; }

    /// `earlier`, if any, is a guess of the answer.
    [[nodiscard]] Footpoint closest(const Vector3& query, const Footpoint* earlier) const {
        if (!query.allFinite()) return noFootpoint();
        const Vector3 local = query - origin_;
        Candidate best;
        double limit = std::numeric_limits<double>::infinity();
        if (earlier != nullptr && earlier->face >= 0 &&
            static_cast<std::size_t>(earlier->face) < mesh_.triangles.size()) {
            // A little more, so that rounding cannot shut the same triangle out.
            limit = pointOf(static_cast<std::size_t>(earlier->face), local).squared_mm2 * (1.0 + 1e-9) + 1e-18;
        }
        tree_.visitNear(
            local, [&] { return std::min(limit, best.squared_mm2); },
            [&](std::size_t t) {
                const Candidate found = pointOf(t, local);
                // Of equally near triangles the first in the file: no start then changes the answer.
                if (std::tie(found.squared_mm2, found.triangle) < std::tie(best.squared_mm2, best.triangle)) {
                    best = found;
                }
            });
        return footpointOf(best, local);
    }

private:
    [[nodiscard]] Candidate pointOf(std::size_t triangle, const Vector3& local) const {
        const TriangleMesh::Triangle& t = mesh_.triangles[triangle];
        const Vector3& a = local_[t[0]];
        Candidate out;
        out.triangle = triangle;
        out.point = detail::nearestOnTriangle(local, a, local_[t[1]], local_[t[2]]);
        out.position = a + out.point.second * (local_[t[1]] - a) + out.point.third * (local_[t[2]] - a);
        out.squared_mm2 = (local - out.position).squaredNorm();
        return out;
    }

    [[nodiscard]] Footpoint footpointOf(const Candidate& best, const Vector3& local) const {
        const TriangleMesh::Triangle& t = mesh_.triangles[best.triangle];
        const TriangleFeature& feature = best.point.feature;
        Footpoint out;
        out.face = static_cast<std::int32_t>(best.triangle);
        out.u = best.point.second;
        out.v = best.point.third;
        out.position = origin_ + best.position;
        bool open = false;
        if (feature.kind == TriangleFeature::Kind::Inside) {
            out.normal = normals_[best.triangle];
        } else if (feature.kind == TriangleFeature::Kind::Edge) {
            out.normal = sides_[best.triangle].pseudo_normal[feature.index];
            open = sides_[best.triangle].open[feature.index];
        } else {
            out.normal = corner_normals_[t[feature.index]];
            open = corner_open_[t[feature.index]];
        }
        const Vector3 offset = local - best.position;
        const double along = offset.dot(out.normal);
        out.distance_mm = std::copysign(offset.norm(), along);
        out.on_boundary = open && (offset - along * out.normal).norm() > along_normal_mm * (1.0 + offset.norm());
        return out;
    }

    /// Of triangles, and of corners by the angles of the triangles that meet there.
    void findNormals() {
        corner_normals_.assign(local_.size(), Vector3::Zero());
        corner_open_.assign(local_.size(), false);
        for (const TriangleMesh::Triangle& t : mesh_.triangles) {
            const Vector3 cross = (local_[t[1]] - local_[t[0]]).cross(local_[t[2]] - local_[t[0]]);
            normals_.push_back(cross.norm() > 0.0 ? Vector3(cross.normalized()) : Vector3::Zero());
            for (std::size_t k = 0; k < 3; ++k) {
                const Vector3 to_next = local_[t[(k + 1) % 3]] - local_[t[k]];
                const Vector3 to_last = local_[t[(k + 2) % 3]] - local_[t[k]];
                corner_normals_[t[k]] += angleBetween(to_next, to_last) * normals_.back();
            }
        }
        for (Vector3& normal : corner_normals_) normal = orUpwards(normal);
    }

    /// A unit vector in any case: where opposite triangles cancel, the sign has no meaning anyway.
    static Vector3 orUpwards(const Vector3& normal) {
        return normal.norm() > 0.0 ? Vector3(normal.normalized()) : Vector3(Vector3::UnitZ());
    }

    void joinSides() {
        struct Side {
            std::uint32_t low;
            std::uint32_t high;
            std::size_t triangle;
            std::size_t side;
        };
        std::vector<Side> all;
        all.reserve(3 * mesh_.triangles.size());
        for (std::size_t i = 0; i < mesh_.triangles.size(); ++i) {
            const TriangleMesh::Triangle& t = mesh_.triangles[i];
            for (std::size_t k = 0; k < 3; ++k) {
                all.push_back({std::min(t[k], t[(k + 1) % 3]), std::max(t[k], t[(k + 1) % 3]), i, k});
            }
        }
        std::sort(all.begin(), all.end(), [](const Side& a, const Side& b) {
            return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
        });
        sides_.resize(mesh_.triangles.size());
        for (std::size_t i = 0; i < all.size();) {
            std::size_t end = i;
            Vector3 sum = Vector3::Zero();
            for (; end < all.size() && all[end].low == all[i].low && all[end].high == all[i].high; ++end) {
                sum += normals_[all[end].triangle];
            }
            const bool open = end - i == 1;
            for (; i < end; ++i) {
                sides_[all[i].triangle].pseudo_normal[all[i].side] = orUpwards(sum);
                sides_[all[i].triangle].open[all[i].side] = open;
                if (open) corner_open_[all[i].low] = corner_open_[all[i].high] = true;
            }
        }
        for (Vector3& normal : normals_) normal = orUpwards(normal);
    }

    TriangleMesh mesh_;
    Eigen::AlignedBox3d bounds_;
    /// Distances are worked out about this point, so that a mesh far from the origin of its frame loses no digits.
    Vector3 origin_ = Vector3::Zero();
    std::vector<Vector3> local_;
    detail::BoxTree tree_;
    std::vector<Vector3> normals_;
    std::vector<Vector3> corner_normals_;
    std::vector<bool> corner_open_;
    std::vector<Sides> sides_;
};

MeshShape::MeshShape(TriangleMesh mesh) : index_(std::make_unique<const Index>(std::move(mesh))) {}
MeshShape::MeshShape(MeshShape&&) noexcept = default;
MeshShape& MeshShape::operator=(MeshShape&&) noexcept = default;
MeshShape::~MeshShape() = default;

Footpoint MeshShape::closest(const Vector3& query) const { return index_->closest(query, nullptr); }

void MeshShape::closest(std::span<const Vector3> queries, std::span<Footpoint> footpoints, bool warm) const {
    assert(queries.size() == footpoints.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries.size(), 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            footpoints[i] = index_->closest(queries[i], warm ? &footpoints[i] : nullptr);
        }
    });
}

Eigen::AlignedBox3d MeshShape::bounds() const { return index_->bounds(); }

const TriangleMesh& MeshShape::mesh() const { return index_->mesh(); }

}  // namespace cusp::geometry
