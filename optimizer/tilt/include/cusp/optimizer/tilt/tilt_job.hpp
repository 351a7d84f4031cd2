// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A tilting job as data: part, tool, machine, starting path, and how the tilt point is searched for.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/base/toml_schema.hpp>
#include <cusp/geometry/cutter.hpp>
#include <cusp/optimizer/tilt/part_shape.hpp>
#include <cusp/optimizer/tilt/three_axis_path.hpp>
#include <cusp/optimizer/tilt/tilted_path.hpp>
#include <cusp/simulation/tool_assembly.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::tilt {

/// A ball end mill with what must not touch; lengths in mm.
struct TiltTool {
    std::int64_t number = 1;
    std::string name = "BALL";
    double diameter_mm = 0.0;
    double cutting_height_mm = 0.0;
    /// Rings from the cutting height upwards: height, lower and upper diameter; then the holder on the shank.
    std::vector<std::array<double, 3>> shank_mm;
    std::vector<std::array<double, 3>> holder_mm;
    double clearance_mm = 0.0;  ///< kept around shank and holder

    [[nodiscard]] geometry::Cutter cutter() const;
    /// From the tip to the lower end of the holder; and to its upper end, where the spindle begins.
    [[nodiscard]] double stickOutMm() const;
    [[nodiscard]] double lengthMm() const;
    /// With the holder moved towards the tip until it begins at `stick_out_mm`.
    [[nodiscard]] base::Result<simulation::ToolAssembly> assembly(double stick_out_mm) const;
};

struct TiltSearch {
    std::array<double, 3> center_mm{};  ///< of the cube in which tilt points are searched for
    double cube_mm = 80.0;              ///< its edge
    std::int64_t seed = 1;
    std::int64_t offspring = 50;  ///< the paper's population
    std::int64_t survivors = 25;
    std::int64_t generations = 50;
    std::int64_t most_points = 3;  ///< tilt points; more than one only where fewer find no way free of collision
    double coarse_mm =
        1.0;  ///< cell of the field of distances candidates are looked up in, and spacing of the first looks
    double proof_mm = 0.2;  ///< resolution of the simulation that proves the winner
};

struct TiltJob {
    std::int64_t schema = 1;
    std::string name;
    std::string description;
    std::string machine;  ///< path or name
    std::array<double, 3> origin_mm{};
    PartShape part;
    TiltTool tool;
    std::optional<std::string> cl_file;
    std::optional<ThreeAxisOptions> path;
    double longest_cut_mm = 2.0;
    TiltArea area;
    std::vector<std::array<double, 3>> tilt_points_mm;  ///< given by hand: nothing is searched for
    TiltSearch search;
};

/// The field table of a job file, with its checks (`tilt.*` at the key they speak of).
[[nodiscard]] const base::Section<TiltJob>& tiltJobSection();

/// Errors: those of `TomlDocument`, `toml.*`, `tilt.*`; all of them at once.
[[nodiscard]] base::Result<TiltJob> readTiltJobFile(const std::string& path);
[[nodiscard]] base::Result<TiltJob> readTiltJob(std::string_view text, const std::string& file_name);

}  // namespace cusp::tilt
