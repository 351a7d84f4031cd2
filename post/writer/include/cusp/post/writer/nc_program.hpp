// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// An NC program as data, before any control's spelling: what golden tests print and a control's writer turns into text.
#pragma once

#include <cusp/geometry/frames.hpp>
#include <cusp/kinematics/machine.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace cusp::post {

/// Text for people, no effect on the machine.
struct Comment {
    std::string text;
};

/// A block as the machine file spells it.
struct Literal {
    std::string text;
};

/// The control's modal defaults, so that nothing is left over from the program before.
struct ModalStart {};

/// Rapid to the machine's home in machine coordinates: the retract axis alone first, with the tool offset off, then the
/// rest. Transformations are off.
struct GoHome {};

struct ChangeTool {
    std::optional<std::int64_t> number;
    std::string name;  ///< preferred when not empty
};

/// Path smoothing with the control's tolerances (CYCLE832 on an 840D).
struct Smoothing {
    bool on = true;
};

/// The operator's line on the screen.
struct ScreenMessage {
    std::string text;
};

/// The settable frame by its name; empty: the machine file's.
struct SelectWorkOffset {
    std::string name;
};

struct Spindle {
    toolpath::SpindleCommand::Turn turn = toolpath::SpindleCommand::Turn::Off;
    double speed_rpm = 0.0;
};

struct Coolant {
    toolpath::CoolantCommand::Kind kind = toolpath::CoolantCommand::Kind::Off;
};

using kinematics::RotaryValues;

/// Rapid of the rotary axes alone, in machine coordinates, at home height.
struct PositionRotary {
    RotaryValues rotary_rad{};
};

/// Tool-tip programming (TRAORI on an 840D): from here points are the tip in the workpiece frame, and the control turns
/// the rotary axes to where they are told, or to where they give the tool axis that is told.
struct TipProgramming {
    bool on = true;
    bool vectors = false;
    std::string work_offset = {};  ///< called again behind it; empty: the machine file's
};

/// The frame tilted and the tool set along its Z (CYCLE800 on an 840D): from here points are the tip in the plane's frame.
/// The angles turn about X, then the new Y, then the new Z.
struct TiltedPlane {
    std::array<double, 3> angles_rad{};
    geometry::Vector3 origin_mm = geometry::Vector3::Zero();  ///< of the plane, workpiece frame
    RotaryValues rotary_rad{};  ///< where the axes are expected to go; the control chooses

    [[nodiscard]] geometry::RigidTransform workpieceFromPlane() const;
};
struct PlaneOff {};

/// The control offsets the path sideways by the radius of the tool, from the next straight move on.
struct RadiusCompensation {
    toolpath::CutterCompensation::Side side = toolpath::CutterCompensation::Side::Off;
    std::optional<std::int64_t> offset_number;  ///< another D than the tool's first
};

/// No transformation: from here points are positions of the linear axes, shifted so that they are the tip while all rotary
/// axes are at zero. They hold for this tool length and this place of the work offset.
struct AxisProgramming {
    double tool_length_mm = 0.0;                                  ///< gauge point to tip
    geometry::Vector3 wcs_origin_mm = geometry::Vector3::Zero();  ///< machine frame, all axes at zero
};

/// To the first point with a tool: rapid in the plane at home height, then down, at feed when the CL file feeds there.
///
/// Points of motions are as programmed: the tip in the workpiece frame, but for TiltedPlane and AxisProgramming.
struct Approach {
    geometry::Vector3 point_mm = geometry::Vector3::Zero();
    RotaryValues rotary_rad{};
    toolpath::MotionKind kind = toolpath::MotionKind::Rapid;
    toolpath::FeedRate feed;                              ///< meaningful when kind is Feed
    geometry::Vector3 axis = geometry::Vector3::UnitZ();  ///< unit, workpiece frame
};

/// A straight move with the rotary axes moving along.
struct Move {
    geometry::Vector3 point_mm = geometry::Vector3::Zero();
    RotaryValues rotary_rad{};
    toolpath::MotionKind kind = toolpath::MotionKind::Feed;
    toolpath::FeedRate feed;                              ///< meaningful when kind is Feed
    geometry::Vector3 axis = geometry::Vector3::UnitZ();  ///< unit, workpiece frame
    double moves_per_min = 0.0;                           ///< > 0: the feed as inverse time instead
};

/// A circular or helical move in the XY plane of the points; the rotary axes stand still. Arcs in other planes become
/// straight moves before they get here: a change of plane would turn the tool length into another axis.
struct ArcMove {
    geometry::Vector3 end_mm = geometry::Vector3::Zero();
    geometry::Vector3 center_from_start_mm = geometry::Vector3::Zero();
    bool clockwise = false;  ///< seen from +Z
    RotaryValues rotary_rad{};
    toolpath::FeedRate feed;
    double moves_per_min = 0.0;  ///< as of a Move
};

/// From here every `HolePosition` is a hole along Z, until `HoleCycleOff`. Heights are absolute.
struct HoleCycle {
    toolpath::CycleStart::Kind kind = toolpath::CycleStart::Kind::Drill;
    double retract_z_mm = 0.0;
    double surface_z_mm = 0.0;
    double clearance_mm = 0.0;  ///< above the surface, where the feed begins
    double depth_mm = 0.0;      ///< below the surface
    double dwell_s = 0.0;
    double first_peck_mm = 0.0;
    double peck_mm = 0.0;
    double pitch_mm = 0.0;  ///< of a tapped thread, > 0 right-hand, < 0 left-hand
    double speed_rpm = 0.0;
    toolpath::FeedRate feed;

    bool operator==(const HoleCycle&) const = default;
};

struct HolePosition {
    double x_mm = 0.0;
    double y_mm = 0.0;
    RotaryValues rotary_rad{};
};

struct HoleCycleOff {};

struct Pause {
    double seconds = 0.0;
};

struct Stop {
    bool optional = false;
};

using NcItem =
    std::variant<Comment, Literal, ModalStart, GoHome, ChangeTool, Smoothing, ScreenMessage, SelectWorkOffset, Spindle,
                 Coolant, PositionRotary, TipProgramming, TiltedPlane, PlaneOff, AxisProgramming, RadiusCompensation,
                 Approach, Move, ArcMove, HoleCycle, HolePosition, HoleCycleOff, Pause, Stop>;

/// One step of the program and the CL line it stands for (0: none).
struct NcStep {
    NcItem item;
    std::uint32_t cl_line = 0;
};

/// Takes the steps in order. A control's writer is one; a collector for tests another.
class NcSink {
public:
    virtual ~NcSink() = default;
    virtual void step(const NcStep& step) = 0;
};

/// One line of text, lengths in mm, angles in degrees, the same on every machine: "move feed X1.0000 … C10.0000 A5.0000".
[[nodiscard]] std::string toText(const NcStep& step, const std::vector<std::string>& rotary_names);

}  // namespace cusp::post
