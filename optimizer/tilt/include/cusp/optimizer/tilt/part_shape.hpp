// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A part written down in a few lines of TOML: a block with pockets and bosses, as a closed mesh.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/base/toml_schema.hpp>
#include <cusp/geometry/triangle_mesh.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::tilt {

/// Lengths in mm. The outline is a rectangle with rounded corners, and lies at the foot: where the wall meets the floor of
/// a pocket, or the ground a boss stands on, if there were no fillet.
struct PartFeature {
    enum class Kind : std::uint8_t { Pocket, Boss };

    Kind kind = Kind::Pocket;
    std::array<double, 2> center_mm{};
    std::array<double, 2> size_mm{};  ///< full widths along X and Y
    double corner_radius_mm = 0.0;    ///< of the outline; half the smaller width makes it round
    double turn_rad = 0.0;            ///< of the outline about Z
    double level_mm = 0.0;            ///< Z of the floor of a pocket, of the top of a boss
    std::optional<double> foot_mm;    ///< of a boss: Z of the ground it stands on; absent: the face of the block
    double draft_rad = 0.0;           ///< of the wall against Z; the walls lean back
    double fillet_mm = 0.0;           ///< radius of the fillet along the foot
    /// Radius of the sphere the top of a boss, or the floor of a pocket, is part of; absent: level. Its highest (or lowest)
    /// point is at the center.
    std::optional<double> crown_radius_mm;
};

/// A file, or a block with features, in the order in which they are made.
struct PartShape {
    std::optional<std::string> file;  ///< STL, PLY, STEP, IGES or surface file
    std::optional<std::array<double, 3>> min_mm;
    std::optional<std::array<double, 3>> max_mm;
    std::optional<double> face_mm;  ///< Z of the face the features are cut into or stand on; absent: max_mm's
    double spacing_mm = 0.5;        ///< of the mesh
    std::vector<PartFeature> features;

    /// Z of the upper side; (x, y) within the block.
    [[nodiscard]] double height(double x_mm, double y_mm) const;
};

/// The field table of a job's `[part]`, with its checks (`tilt.part`).
[[nodiscard]] const base::Section<PartShape>& partSection();

/// Of a block with features: a closed mesh with vertices `spacing_mm` apart.
[[nodiscard]] geometry::TriangleMesh partMesh(const PartShape& part);

}  // namespace cusp::tilt
