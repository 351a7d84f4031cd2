// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A nominal shape with its material on the other side: for surfaces whose file has the normal the wrong way round.
#pragma once

#include <cusp/geometry/closest_point.hpp>

#include <memory>
#include <utility>

namespace cusp::geometry {

/// The same points, nearest points and edges; normals and the signs of distances are turned round.
class TurnedShape : public NominalShape {
public:
    explicit TurnedShape(std::unique_ptr<NominalShape> shape) : shape_(std::move(shape)) {}

    [[nodiscard]] Footpoint closest(const Vector3& query) const override {
        Footpoint out = shape_->closest(query);
        turn(out);
        return out;
    }
    void closest(std::span<const Vector3> queries, std::span<Footpoint> footpoints, bool warm) const override {
        if (warm)
            for (Footpoint& footpoint : footpoints) turn(footpoint);
        shape_->closest(queries, footpoints, warm);
        for (Footpoint& footpoint : footpoints) turn(footpoint);
    }
    [[nodiscard]] Eigen::AlignedBox3d bounds() const override { return shape_->bounds(); }

private:
    static void turn(Footpoint& footpoint) {
        footpoint.normal = -footpoint.normal;
        footpoint.distance_mm = -footpoint.distance_mm;
    }
    std::unique_ptr<NominalShape> shape_;
};

}  // namespace cusp::geometry
