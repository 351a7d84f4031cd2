// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The one question that inspection, simulation and planning ask of a nominal shape: where on it is the nearest point?
#pragma once

#include <cusp/geometry/frames.hpp>

#include <Eigen/Geometry>

#include <cstdint>
#include <limits>
#include <span>

namespace cusp::geometry {

/// The nearest point of a nominal shape to a query point; lengths in mm, in the frame of the shape.
struct Footpoint {
    Vector3 position;          ///< on the shape
    Vector3 normal;            ///< unit, out of the material
    double distance_mm = 0.0;  ///< from the shape to the query, > 0 outside the material; |query − position| in size
    double u = 0.0;            ///< parameters on the face; of a mesh, barycentric
    double v = 0.0;            ///< likewise
    std::int32_t face = 0;     ///< which face, patch or triangle
    bool on_boundary = false;  ///< nearest at an edge where the shape ends: query − position is not along `normal`
};

/// What a query that is not finite gets: no number anywhere, face −1.
[[nodiscard]] inline Footpoint noFootpoint() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {Vector3::Constant(nan), Vector3::Constant(nan), nan, nan, nan, -1, false};
}

/// A shape to measure against. Answers are the global minimum, never a local one; all methods may be called from several
/// threads at once, and give the same bits in each.
class NominalShape {
public:
    virtual ~NominalShape() = default;

    [[nodiscard]] virtual Footpoint closest(const Vector3& query) const = 0;

    /// closest() of every query, in parallel; `footpoints` has the size of `queries`. Footpoints left from an earlier call
    /// (`warm`) are where the search starts: faster when the queries moved little, and never another answer, though on curved
    /// faces its last digits may differ (1e-10 mm; 1e-9 mm on trimmed faces).
    virtual void closest(std::span<const Vector3> queries, std::span<Footpoint> footpoints, bool warm) const = 0;

    /// Axis-parallel box that holds the shape.
    [[nodiscard]] virtual Eigen::AlignedBox3d bounds() const = 0;
};

}  // namespace cusp::geometry
