// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Surfaces written down in TOML: polynomials as a paper prints them, Bézier nets, B-splines.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/base/toml_schema.hpp>
#include <cusp/geometry/surface_face.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::geometry {

/// One `[[face]]` of a surface file as it is written; which keys count depends on `form`.
struct FaceDescription {
    enum class Form : std::uint8_t { Polynomial, Bezier, BSpline };
    /// Terms of a coordinate: `{"1" = 12.1, "u" = -50.8, "u^2 v" = 5.9}`.
    using Terms = std::map<std::string, double>;
    using Points = std::vector<std::vector<std::array<double, 3>>>;
    using Weights = std::vector<std::vector<double>>;

    Form form = Form::Polynomial;
    Outward outward = Outward::DuCrossDv;
    std::optional<Terms> x_mm;
    std::optional<Terms> y_mm;
    std::optional<Terms> z_mm;
    std::optional<std::array<double, 2>> u_range;
    std::optional<std::array<double, 2>> v_range;
    std::optional<Points> points_mm;
    std::optional<Weights> weights;
    std::optional<std::int64_t> degree_u;
    std::optional<std::int64_t> degree_v;
    std::optional<std::vector<double>> knots_u;
    std::optional<std::vector<double>> knots_v;
};

struct SurfaceFile {
    std::int64_t schema = 1;
    std::string name;
    std::string description;
    std::vector<FaceDescription> faces;
};

/// The field table of a surface file, with its checks: `surface.*` errors at the key they speak of.
[[nodiscard]] const base::Section<SurfaceFile>& surfaceFileSection();

/// The faces of a surface file. Errors: those of `TomlDocument`, `toml.*` of the field table, `surface.*`.
[[nodiscard]] base::Result<std::vector<SurfaceFace>> readSurfaceFile(const std::string& path);
/// The same from a text; `file_name` is for messages.
[[nodiscard]] base::Result<std::vector<SurfaceFace>> readSurface(std::string_view text, const std::string& file_name);

}  // namespace cusp::geometry
