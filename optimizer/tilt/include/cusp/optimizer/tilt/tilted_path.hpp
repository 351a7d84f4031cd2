// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The manual step of Weinert & Stautner 2004, 2.1: the tool axis through a tilt point, the ball where it was.
//
// The paper keeps "the position of the tool tip" and says that the surface remains the same with ball end mills. That holds
// when the ball's centre stays: with the lowest point of the ball kept, the ball would move by up to its diameter. So the
// centre stays here, the axis passes through it and the tilt point, and the tip goes round it.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/base/toml_schema.hpp>
#include <cusp/geometry/cutter.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::tilt {

/// The part of the path that is tilted: tips within the box; around it the tilt fades out over `blend_mm`. Absent bounds do
/// not restrict.
struct TiltArea {
    std::optional<std::array<double, 3>> min_mm;
    std::optional<std::array<double, 3>> max_mm;
    double blend_mm = 5.0;

    /// 1 inside, 0 beyond the blend, smooth between.
    [[nodiscard]] double weight(const geometry::Vector3& tip_mm) const;
};

[[nodiscard]] const base::Section<TiltArea>& tiltAreaSection();

/// One tilt point, or several that the axis goes over between smoothly, evenly spread over the length of the path; mm.
struct TiltPlan {
    std::vector<geometry::Vector3> points;
    TiltArea area;

    /// The tilt point that holds at a share of the path's length, 0 to 1.
    [[nodiscard]] geometry::Vector3 pointAt(double share) const;
};

/// Unit axis along the line through the ball's centre and the tilt point, on its upper side: a point above is leaned towards (a cavity), one
/// below is leaned away from (a dome). +Z where both are the same point.
[[nodiscard]] geometry::Vector3 axisThrough(const geometry::Vector3& tilt_point_mm, const geometry::Vector3& center_mm);

/// A place of the starting path.
struct StartLocation {
    toolpath::CutterLocation location;
    toolpath::MotionKind kind = toolpath::MotionKind::Feed;
    std::uint32_t line = 0;
    double feed_mm_per_s = 0.0;  ///< of the move to it; 0 for rapid
    double share = 0.0;          ///< of the path's length up to here
    /// Where it stands above the place of a cut, at the end of a link: index of that place; it moves with that place's axis.
    std::optional<std::uint32_t> above;
};

/// A three-axis path, straight moves only, with one ball end mill.
struct StartPath {
    std::vector<StartLocation> locations;
    std::vector<toolpath::ClRecord> records;
    geometry::Cutter cutter;
    double spindle_rpm = 0.0;

    [[nodiscard]] double lengthMm() const;
    [[nodiscard]] geometry::Vector3 center(std::size_t i) const {
        return locations[i].location.tip_mm + cutter.diameter_mm / 2.0 * locations[i].location.axis;
    }
    /// Without the locations that are nearer than `spacing_mm` to the one before; the ends of cuts and of rapid moves stay. Its
    /// records are left out: it is for a first look.
    [[nodiscard]] StartPath coarse(double spacing_mm) const;
};

struct StartOptions {
    std::optional<geometry::Cutter> cutter;  ///< where the file says none
    double chord_tolerance_mm = 0.005;       ///< of the straight moves that arcs become
    /// Cuts longer than this are divided: while the axis turns along a straight move of the tip, the ball's centre leaves the
    /// straight way by R·θ²/8.
    double longest_cut_mm = 2.0;
};

/// Takes the path out of a CL file.
/// Errors, with the CL line: `tilt.not-a-ball` (only a ball end mill leaves the same surface when it is tilted; 2.),
/// `tilt.motion` (drilling cycles, splines, homing, work planes, frames other than the part's, more than one tool),
/// `tilt.no-path`.
[[nodiscard]] base::Result<StartPath> startPath(const std::vector<toolpath::ClRecord>& records, const std::string& file,
                                                const StartOptions& options = {});

/// How far the ball's centre leaves the way it has in the starting path, at most, over all moves of the tilted one: R·θ²/8
/// with θ the turn of the axis in the move; mm.
[[nodiscard]] double largestCenterError(const StartPath& path, const std::vector<toolpath::CutterLocation>& poses);

/// The tool poses of the tilted path, one for each location.
[[nodiscard]] std::vector<toolpath::CutterLocation> tilted(const StartPath& path, const TiltPlan& plan);

/// The CL file of the tilted path.
[[nodiscard]] std::vector<toolpath::ClRecord> tiltedRecords(const StartPath& path, const TiltPlan& plan);

}  // namespace cusp::tilt
