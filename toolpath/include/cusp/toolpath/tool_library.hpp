// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Tools of the shop: cutter, shank, holder and gauge length, from a TOML file.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/base/toml_schema.hpp>
#include <cusp/geometry/cutter.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::toolpath {

/// A cylinder of a profile: its height along the tool axis and its diameter; or a cone: height, lower and upper diameter.
using ToolRing = std::vector<double>;

struct Tool {
    enum class Shape : std::uint8_t { Flat, Ball, Toroidal, Tapered };

    std::optional<std::int64_t> number;
    std::string name;
    Shape shape = Shape::Flat;
    double diameter_mm = 0.0;  ///< APT's d: where bottom and flank would meet without the corner
    std::optional<double> corner_radius_mm;
    std::optional<double> taper_rad;  ///< of the flank against the tool axis
    double cutting_height_mm = 0.0;
    double gauge_length_mm = 0.0;  ///< tip to the spindle's gauge plane
    /// From the cutting height upwards, one ring on the other; then the holder on the shank.
    std::vector<ToolRing> shank_mm;
    std::vector<ToolRing> holder_mm;

    /// APT's seven values.
    [[nodiscard]] geometry::Cutter cutter() const;
};

struct ToolLibrary {
    std::int64_t schema = 1;
    std::string name;
    std::string description;
    std::vector<Tool> tools;

    /// Null when the library has no such tool.
    [[nodiscard]] const Tool* findNumber(std::int64_t wanted) const;
    [[nodiscard]] const Tool* findName(std::string_view wanted) const;
};

/// The field table of a library file, with its checks: `tool.*` errors at the key they speak of.
[[nodiscard]] const base::Section<ToolLibrary>& toolLibrarySection();

/// Errors: those of `TomlDocument`, `toml.*` of the field table, `tool.*`; all of them at once.
[[nodiscard]] base::Result<ToolLibrary> readToolLibraryFile(const std::string& path);
/// The same from a text; `file_name` is for messages.
[[nodiscard]] base::Result<ToolLibrary> readToolLibrary(std::string_view text, const std::string& file_name);

}  // namespace cusp::toolpath
