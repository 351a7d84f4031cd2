// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Parts that OCCT builds, writes to STEP and IGES, and measures: the other opinion on trimmed faces.
#pragma once

#include <cusp/geometry/frames.hpp>

#include <memory>
#include <string>
#include <vector>

namespace cusp::geometry::test {

class OcctPart {
public:
    [[nodiscard]] static OcctPart plateWithHole();
    [[nodiscard]] static OcctPart cylinder();
    [[nodiscard]] static OcctPart cone();
    [[nodiscard]] static OcctPart torus();
    [[nodiscard]] static OcctPart sphere();
    [[nodiscard]] static OcctPart sphereSlice();
    [[nodiscard]] static OcctPart freeFormFace();
    [[nodiscard]] static OcctPart drilledBlock();
    [[nodiscard]] static std::vector<OcctPart> all();

    [[nodiscard]] const std::string& name() const { return name_; }
    /// `unit` as OCCT names it: "MM", "INCH", "M".
    [[nodiscard]] bool writeStep(const std::string& path, const char* unit) const;
    [[nodiscard]] bool writeIges(const std::string& path) const;
    /// To the nearest point of the faces, unsigned (BRepExtrema_DistShapeShape).
    [[nodiscard]] double distance(const Vector3& query) const;
    [[nodiscard]] bool isSolid() const;
    [[nodiscard]] bool isInside(const Vector3& query) const;
    /// Corners of the box that holds the part.
    [[nodiscard]] Eigen::AlignedBox3d bounds() const;

private:
    struct Shape;
    OcctPart(std::string name, std::shared_ptr<const Shape> shape) : name_(std::move(name)), shape_(std::move(shape)) {}

    std::string name_;
    std::shared_ptr<const Shape> shape_;
};

}  // namespace cusp::geometry::test
