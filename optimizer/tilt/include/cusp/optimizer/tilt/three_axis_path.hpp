// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Three-axis finishing of any shape a cutter can be dropped on: zig-zag and z-level passes, and the CL file they make.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/base/toml_schema.hpp>
#include <cusp/optimizer/tilt/drop_cutter.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::tilt {

/// The part of the XY plane in which the tip may cut; what is absent does not restrict. Lengths in mm.
struct PathArea {
    std::optional<std::array<double, 2>> min_mm;
    std::optional<std::array<double, 2>> max_mm;
    std::array<double, 2> center_mm{};
    std::optional<double> radius_mm;
    std::optional<double> inner_radius_mm;

    [[nodiscard]] bool contains(double x_mm, double y_mm) const;
};

struct ThreeAxisOptions {
    enum class Strategy : std::uint8_t { ZigZag, ZLevel };

    Strategy strategy = Strategy::ZigZag;
    double step_over_mm = 0.5;         ///< between rows of a zig-zag
    double step_down_mm = 0.5;         ///< between z-levels
    double direction_rad = 0.0;        ///< of the rows, from +X towards +Y
    double sample_mm = 0.25;           ///< the shape is looked at as densely as this at least
    double tolerance_mm = 0.005;       ///< of the straight moves against what the dropped cutter follows
    std::optional<double> highest_mm;  ///< z-levels: of the tip
    std::optional<double> lowest_mm;
    double link_mm = 2.0;        ///< passes whose ends are nearer than this are linked at feed over the shape
    double clearance_mm = 10.0;  ///< of rapid moves above the highest point of the shape
    double feed_mm_per_s = 25.0;
    double plunge_feed_mm_per_s = 5.0;
    double spindle_rpm = 12000.0;
    PathArea area;

    /// Errors (`tilt.option`) name the option, its value and what it must be.
    [[nodiscard]] base::Diagnostics check() const;
};

/// The field table of a job's `[path]`.
[[nodiscard]] const base::Section<ThreeAxisOptions>& threeAxisSection();

/// Tip positions of one cut, feed all the way.
using Pass = std::vector<geometry::Vector3>;

struct ThreeAxisPath {
    std::vector<Pass> passes;
    double clearance_z_mm = 0.0;

    [[nodiscard]] std::size_t locations() const;
};

/// Passes are computed in parallel and come out the same at any number of threads. The tip is nowhere below where the
/// dropped cutter stops, except on the straight way between two locations, by `tolerance_mm` at most where the shape has no
/// detail finer than `sample_mm`. Passes nearer than `link_mm` are linked at feed over the shape, others over the clearance plane.
/// Errors: `tilt.option`; `tilt.no-path` when the cutter meets the shape nowhere in the area.
[[nodiscard]] base::Result<ThreeAxisPath> planThreeAxis(const DropShape& shape, const ThreeAxisOptions& options);

/// The CL file: tool call with CUTTER's seven values, spindle, rapid links, feeds.
[[nodiscard]] std::vector<toolpath::ClRecord> clRecords(const ThreeAxisPath& path, const ThreeAxisOptions& options,
                                                        const std::string& name, const toolpath::ToolCall& tool);

}  // namespace cusp::tilt
