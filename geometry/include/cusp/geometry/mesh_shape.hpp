// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A triangle mesh as a nominal shape.
#pragma once

#include <cusp/geometry/closest_point.hpp>
#include <cusp/geometry/triangle_mesh.hpp>

#include <memory>
#include <span>

namespace cusp::geometry {

/// Footpoint::face counts the triangles; u and v are the barycentric coordinates of its second and third corner. At edges and
/// corners the normal is the angle-weighted pseudo-normal (Bærentzen & Aanæs 2005, eq. 4), which gives the sign of the
/// distance right on every closed, consistently oriented mesh. A point is `on_boundary` when it lies on an edge of one
/// triangle only and the query does not stand on the normal.
class MeshShape : public NominalShape {
public:
    /// The mesh has at least one triangle; its corners are vertices that exist.
    explicit MeshShape(TriangleMesh mesh);
    MeshShape(MeshShape&&) noexcept;
    MeshShape& operator=(MeshShape&&) noexcept;
    MeshShape(const MeshShape&) = delete;
    MeshShape& operator=(const MeshShape&) = delete;
    ~MeshShape() override;

    [[nodiscard]] Footpoint closest(const Vector3& query) const override;
    void closest(std::span<const Vector3> queries, std::span<Footpoint> footpoints, bool warm) const override;
    [[nodiscard]] Eigen::AlignedBox3d bounds() const override;

    [[nodiscard]] const TriangleMesh& mesh() const;

private:
    class Index;
    std::unique_ptr<const Index> index_;
};

}  // namespace cusp::geometry
