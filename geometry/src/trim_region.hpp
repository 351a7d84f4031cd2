// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The part of a face's rectangle of parameters that its edges leave.
#pragma once

#include "box_newton.hpp"

#include <cusp/geometry/surface_face.hpp>
#include <cusp/geometry/trim_edge.hpp>

#include <vector>

namespace cusp::geometry::detail {

/// Without outlines, the whole rectangle.
class TrimRegion {
public:
    TrimRegion() = default;
    /// Outlines that run along the border of the rectangle and nowhere else leave the face whole.
    TrimRegion(const SurfaceFace& face, const std::vector<const CurvePieces*>& outlines);

    [[nodiscard]] bool isWhole() const { return crossings_.empty(); }
    [[nodiscard]] bool contains(double u, double v) const;
    /// Whether an edge may run through the box, so that it is neither inside nor outside as a whole.
    [[nodiscard]] bool mayCross(const ParameterBox& box) const;

private:
    /// A piece of an outline with its extent.
    struct Crossing {
        BezierCurve curve;
        double low_x;
        double high_x;
        double low_y;
        double high_y;
    };
    [[nodiscard]] Vector3 turned(double u, double v) const;
    void addCrossing(const BezierCurve& piece);
    [[nodiscard]] bool touches(const Crossing& outline, const ParameterBox& box) const;
    [[nodiscard]] static bool isCrossed(const Crossing& crossing, double x, double y);
    [[nodiscard]] static Crossing withExtent(BezierCurve curve);

    double low_u_ = 0.0;
    double low_v_ = 0.0;
    double scale_u_ = 1.0;
    double scale_v_ = 1.0;
    std::vector<Crossing> crossings_;  ///< turned and scaled
    std::vector<Crossing> outlines_;   ///< the same pieces as the file has them
};

}  // namespace cusp::geometry::detail
