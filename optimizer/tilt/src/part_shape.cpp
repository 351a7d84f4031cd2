// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Heights of a block with pockets and bosses, its mesh, and its field table.
#include <cusp/optimizer/tilt/part_shape.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cusp::tilt {

using geometry::TriangleMesh;
using geometry::Vector3;

namespace {

constexpr std::size_t most_vertices = 20'000'000;

/// Signed distance to the outline, negative inside.
double outlineDistance(const PartFeature& feature, double x_mm, double y_mm) {
    const double x = x_mm - feature.center_mm[0];
    const double y = y_mm - feature.center_mm[1];
    const double cosine = std::cos(feature.turn_rad);
    const double sine = std::sin(feature.turn_rad);
    const double corner = feature.corner_radius_mm;
    const double dx = std::abs(cosine * x + sine * y) - feature.size_mm[0] / 2.0 + corner;
    const double dy = std::abs(cosine * y - sine * x) - feature.size_mm[1] / 2.0 + corner;
    return std::hypot(std::max(dx, 0.0), std::max(dy, 0.0)) + std::min(std::max(dx, dy), 0.0) - corner;
}

/// Rise above the floor at the distance `into` into the wall's side of the foot: floor, fillet tangent to both, wall.
double wallRise(double into, double draft_rad, double fillet_mm) {
    const double tangent = std::tan(draft_rad);
    const double begin = fillet_mm * (tangent - 1.0 / std::cos(draft_rad));
    if (into <= begin) return 0.0;
    const double x = into - begin;
    if (x < fillet_mm * std::cos(draft_rad)) return fillet_mm - std::sqrt(fillet_mm * fillet_mm - x * x);
    return into / tangent;
}

double crown(const PartFeature& feature, double x_mm, double y_mm) {
    if (!feature.crown_radius_mm) return 0.0;
    const double r = *feature.crown_radius_mm;
    const double x = x_mm - feature.center_mm[0];
    const double y = y_mm - feature.center_mm[1];
    return r - std::sqrt(std::max(0.0, r * r - x * x - y * y));
}

bool isUpright(const PartFeature& feature) {
    constexpr double upright_rad = 1e-3;
    return feature.draft_rad < upright_rad;
}

void checkFeature(const PartFeature& feature, const base::TomlNode& node, base::Diagnostics& report) {
    const double narrow = std::min(feature.size_mm[0], feature.size_mm[1]);
    const auto wrong = [&](const char* key, const std::string& message) {
        const auto at = node.at(key);
        report.error("tilt.part", message, at ? at->where() : node.whereKey(key));
    };
    if (!(narrow > 0.0)) wrong("size_mm", "both widths must be above 0");
    if (feature.corner_radius_mm > narrow / 2.0)
        wrong("corner_radius_mm", fmt::format("it is {} mm; at most half the smaller width, {} mm, is possible",
                                              feature.corner_radius_mm, narrow / 2.0));
    if (isUpright(feature)) wrong("draft_deg", "the walls must lean back by at least 0.06°");
    if (feature.crown_radius_mm && *feature.crown_radius_mm < std::hypot(feature.size_mm[0], feature.size_mm[1]) / 2.0)
        wrong("crown_radius_mm",
              fmt::format("it is {} mm; the sphere must reach over the whole outline: at least {:g} mm",
                          *feature.crown_radius_mm, std::hypot(feature.size_mm[0], feature.size_mm[1]) / 2.0));
}

void checkPart(const PartShape& part, const base::TomlNode& node, base::Diagnostics& report) {
    const bool block = part.min_mm && part.max_mm;
    if (part.file ? part.min_mm || part.max_mm || !part.features.empty() : !block) {
        report.error("tilt.part", "a part is either a file, or a block (min_mm and max_mm) with features",
                     node.where());
        return;
    }
    if (!block) return;
    double vertices = 1.0;
    for (std::size_t k = 0; k < 3; ++k) {
        if ((*part.min_mm)[k] >= (*part.max_mm)[k])
            report.error("tilt.part",
                         fmt::format("min_mm {} must lie below max_mm {} along {}", (*part.min_mm)[k],
                                     (*part.max_mm)[k], "XYZ"[k]),
                         node.where());
        if (k < 2) vertices *= ((*part.max_mm)[k] - (*part.min_mm)[k]) / part.spacing_mm + 1.0;
    }
    if (vertices > static_cast<double>(most_vertices))
        report.error("tilt.part",
                     fmt::format("spacing_mm {} would need more than 20 million vertices", part.spacing_mm),
                     node.where());
    for (const PartFeature& feature : part.features)
        if (feature.level_mm <= (*part.min_mm)[2] || feature.level_mm > (*part.max_mm)[2])
            report.error(
                "tilt.part",
                fmt::format("a feature's level_mm is {}; it must lie within the block, above {} and up to {} mm",
                            feature.level_mm, (*part.min_mm)[2], (*part.max_mm)[2]),
                node.where());
}

}  // namespace

double PartShape::height(double x_mm, double y_mm) const {
    const double face = face_mm.value_or((*max_mm)[2]);
    double z = face;
    for (const PartFeature& feature : features) {
        const double outside = outlineDistance(feature, x_mm, y_mm);
        if (feature.kind == PartFeature::Kind::Pocket) {
            z = std::min(z, feature.level_mm + crown(feature, x_mm, y_mm) +
                                wallRise(outside, feature.draft_rad, feature.fillet_mm));
            continue;
        }
        const double rise = wallRise(-outside, feature.draft_rad, feature.fillet_mm);
        if (rise > 0.0)
            z = std::max(
                z, std::min(feature.foot_mm.value_or(face) + rise, feature.level_mm - crown(feature, x_mm, y_mm)));
    }
    return std::max(z, (*min_mm)[2] + spacing_mm);
}

TriangleMesh partMesh(const PartShape& part) {
    const auto& low = *part.min_mm;
    const auto& high = *part.max_mm;
    const auto cells = [&](std::size_t k) {
        return std::max<std::uint32_t>(1,
                                       static_cast<std::uint32_t>(std::lround((high[k] - low[k]) / part.spacing_mm)));
    };
    const std::uint32_t columns = cells(0) + 1;
    const std::uint32_t rows = cells(1) + 1;
    TriangleMesh mesh;
    for (std::uint32_t j = 0; j < rows; ++j)
        for (std::uint32_t i = 0; i < columns; ++i) {
            const double x = low[0] + (high[0] - low[0]) * i / (columns - 1);
            const double y = low[1] + (high[1] - low[1]) * j / (rows - 1);
            mesh.vertices.emplace_back(x, y, part.height(x, y));
        }
    const auto at = [columns](std::uint32_t i, std::uint32_t j) { return j * columns + i; };
    for (std::uint32_t j = 0; j + 1 < rows; ++j)
        for (std::uint32_t i = 0; i + 1 < columns; ++i) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
            mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
        }
    // The rim, counter-clockwise seen from above, is let down to the bottom; the bottom is a fan about its middle.
    std::vector<std::uint32_t> rim;
    for (std::uint32_t i = 0; i + 1 < columns; ++i) rim.push_back(at(i, 0));
    for (std::uint32_t j = 0; j + 1 < rows; ++j) rim.push_back(at(columns - 1, j));
    for (std::uint32_t i = columns - 1; i > 0; --i) rim.push_back(at(i, rows - 1));
    for (std::uint32_t j = rows - 1; j > 0; --j) rim.push_back(at(0, j));
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const std::uint32_t corner : rim)
        mesh.vertices.emplace_back(mesh.vertices[corner].x(), mesh.vertices[corner].y(), low[2]);
    const auto middle = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.emplace_back((low[0] + high[0]) / 2.0, (low[1] + high[1]) / 2.0, low[2]);
    const auto count = static_cast<std::uint32_t>(rim.size());
    for (std::uint32_t k = 0; k < count; ++k) {
        const std::uint32_t next = (k + 1) % count;
        mesh.triangles.push_back({rim[k], first + k, first + next});
        mesh.triangles.push_back({rim[k], first + next, rim[next]});
        mesh.triangles.push_back({middle, first + next, first + k});
    }
    return mesh;
}

const base::Section<PartShape>& partSection() {
    constexpr base::FieldRules above_zero = base::positive();
    constexpr base::FieldRules not_negative{.min = 0.0};
    constexpr base::FieldRules lean{.min = 0.0, .max = 80.0};
    using Feature = PartFeature;
    static const auto feature =
        base::Section<Feature>("A pocket in the block, or a boss on it; its outline lies at the foot of its walls.")
            .choice("kind", &Feature::kind, {{"pocket", Feature::Kind::Pocket}, {"boss", Feature::Kind::Boss}},
                    "What it is.", base::required())
            .field("center_mm", &Feature::center_mm, "Middle of the outline.")
            .field("size_mm", &Feature::size_mm, "Full widths of the outline along X and Y.", base::required())
            .field("corner_radius_mm", &Feature::corner_radius_mm,
                   "Of the outline; half the smaller width makes it round.", not_negative)
            .field("turn_deg", &Feature::turn_rad, "Of the outline about Z.")
            .field("level_mm", &Feature::level_mm, "Z of the floor of a pocket, of the top of a boss.",
                   base::required())
            .field("foot_mm", &Feature::foot_mm, "Z of the ground a boss stands on; absent: the face of the block.")
            .field("draft_deg", &Feature::draft_rad, "Of the walls against Z; they lean back.", lean)
            .field("fillet_mm", &Feature::fillet_mm, "Radius of the fillet along the foot.", not_negative)
            .field("crown_radius_mm", &Feature::crown_radius_mm,
                   "Radius of the sphere that the top of a boss, or the floor of a pocket, is part of; absent: level.",
                   above_zero)
            .check(checkFeature);
    static const auto section =
        base::Section<PartShape>("The finished part: what must not be hit.")
            .field("file", &PartShape::file, "STL or PLY mesh, STEP, IGES or surface file; relative to the job file.")
            .field("min_mm", &PartShape::min_mm, "Lower corner of a block.")
            .field("max_mm", &PartShape::max_mm, "Upper corner of it.")
            .field("face_mm", &PartShape::face_mm,
                   "Z of the face that features are cut into; absent: the upper corner's.")
            .field("spacing_mm", &PartShape::spacing_mm, "Of the mesh made of the block.", above_zero)
            .tables("feature", &PartShape::features, feature)
            .check(checkPart);
    return section;
}

}  // namespace cusp::tilt
