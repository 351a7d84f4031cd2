// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Faces as a nominal shape: the certified nearest point on any number of polynomial and rational faces.
#pragma once

#include <cusp/geometry/closest_point.hpp>
#include <cusp/geometry/surface_face.hpp>
#include <cusp/geometry/trim_edge.hpp>

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace cusp::geometry {

/// The answer is within 1e-10 mm of the least distance, wherever the query is: a cell of the surface is left out only when
/// a bound proves that it holds nothing nearer, and Newton's method is trusted only where the squared distance is proved
/// convex; what is left is searched by branch and bound. Footpoint::face counts the faces, u and v are the face's parameters.
///
/// The sign of the distance follows the outward normal at the footpoint. Where faces meet there (an edge, a corner), it is
/// that of the face whose tangent plane is farther from the query, which is right on both sides of a sharp edge.
class ParametricSurface : public NominalShape {
public:
    explicit ParametricSurface(std::vector<SurfaceFace> faces);
    /// Faces that end at edges. Of a trimmed face only what its edges leave is part of the shape; the nearest point may lie on
    /// an edge, on the curve in space that the edge is.
    ParametricSurface(std::vector<SurfaceFace> faces, std::vector<TrimEdge> edges);
    ParametricSurface(ParametricSurface&&) noexcept;
    ParametricSurface& operator=(ParametricSurface&&) noexcept;
    ParametricSurface(const ParametricSurface&) = delete;
    ParametricSurface& operator=(const ParametricSurface&) = delete;
    ~ParametricSurface() override;

    [[nodiscard]] Footpoint closest(const Vector3& query) const override;
    void closest(std::span<const Vector3> queries, std::span<Footpoint> footpoints, bool warm) const override;
    [[nodiscard]] Eigen::AlignedBox3d bounds() const override;

    [[nodiscard]] const std::vector<SurfaceFace>& faces() const;
    /// How many faces do not fill their rectangle of parameters.
    [[nodiscard]] std::size_t trimmedFaces() const;

private:
    class Index;
    std::unique_ptr<const Index> index_;
};

}  // namespace cusp::geometry
