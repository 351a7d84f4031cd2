// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The CL file as the verifier needs it: points in order, each with the process state it is reached in.
#pragma once

#include <cusp/post/reader/executed_program.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::post::verify {

struct ExpectedProcess {
    std::optional<toolpath::FeedRate> feed;
    /// Absent until the CL file speaks of the spindle: then the speed is the programmer's choice.
    std::optional<toolpath::SpindleCommand::Turn> turn;
    std::optional<double> rpm;  ///< absent when the CL file gives none, or a cutting speed
    std::optional<toolpath::CoolantCommand::Kind> coolant;
    toolpath::CutterCompensation::Side compensation = toolpath::CutterCompensation::Side::Off;
    std::optional<std::int64_t> edge;  ///< D, where CUTCOM names one
    /// Which programming frame the points are in, in the order these come in.
    std::size_t frame = 0;
    std::optional<std::int64_t> tool_number;
    std::string tool_name;
};

/// A circular or helical way from one point to the next.
struct ExpectedArc {
    reader::Vector3 start_mm;
    reader::Vector3 center_mm;  ///< at the height of the start
    reader::Vector3 normal;     ///< the motion is right-handed about it
    double sweep_rad = 0.0;     ///< > 0, a whole turn at most
    double end_radius_mm = 0.0;
    double height_mm = 0.0;  ///< along the normal

    [[nodiscard]] reader::Vector3 at(double fraction) const;
    /// Of the nearest point of the arc.
    [[nodiscard]] double fractionOf(const reader::Vector3& point) const;
    [[nodiscard]] double length() const;
    /// A bound on the second derivative of `at`, mm.
    [[nodiscard]] double bend() const;
};

/// What a drilling cycle of the CL file asks of the way to the bottom of each hole.
struct ExpectedCycle {
    double approach_mm = 0.0;                ///< from where the feed begins down to the location
    double depth_mm = 0.0;                   ///< from the location to the bottom
    std::optional<double> smallest_peck_mm;  ///< the last one may be smaller; absent: in one go
    std::optional<double> largest_peck_mm;
    bool comes_out = false;         ///< of the hole after each peck
    std::optional<double> dwell_s;  ///< at the bottom
};

inline constexpr std::uint32_t none = 0xFFFFFFFF;

struct ExpectedPoint {
    reader::ToolPose pose;
    std::uint32_t line = 0;
    std::uint32_t process = 0;  ///< index into `ExpectedPath::processes`
    bool rapid = false;
    std::uint32_t arc = none;    ///< index into `ExpectedPath::arcs`: the way to this point
    std::uint32_t cycle = none;  ///< index into `ExpectedPath::cycles`: this is the bottom of a hole
    bool leaves_hole = false;    ///< the way to this point begins at the bottom of a hole
    bool optional = false;       ///< a program may leave it out: a height the cycle passes on its way
    bool lifts = false;          ///< up to the retract plane of the next hole, before going across to it
    bool opens = false;          ///< first of an operation or after a tool call or stop: the program may link before it
};

struct ExpectedPath {
    std::vector<ExpectedPoint> points;
    std::vector<ExpectedProcess> processes;
    std::vector<ExpectedArc> arcs;
    std::vector<ExpectedCycle> cycles;
};

[[nodiscard]] ExpectedPath expectedPath(const toolpath::ToolPath& path);

}  // namespace cusp::post::verify
