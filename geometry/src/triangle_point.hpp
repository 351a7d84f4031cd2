// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The nearest point of one triangle, and whether it lies inside, on an edge or at a corner.
#pragma once

#include <cusp/geometry/frames.hpp>

#include <cstddef>
#include <cstdint>

namespace cusp::geometry::detail {

/// `index`: of the corner, or of the edge from corner `index` to the next.
struct TriangleFeature {
    enum class Kind : std::uint8_t { Inside, Edge, Corner };
    Kind kind = Kind::Inside;
    std::size_t index = 0;
};

struct TrianglePoint {
    double second = 0.0;  ///< barycentric coordinate of the second corner
    double third = 0.0;   ///< likewise of the third
    TriangleFeature feature;
};

/// Voronoi regions of the triangle's features (Ericson 2005, 5.1.5). Also for a triangle without area.
[[nodiscard]] TrianglePoint nearestOnTriangle(const Vector3& query, const Vector3& a, const Vector3& b,
                                              const Vector3& c);

}  // namespace cusp::geometry::detail
