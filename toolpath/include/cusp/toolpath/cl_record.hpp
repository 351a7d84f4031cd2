// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a CL file says, in the house's own words: one record per statement that means something, in file order.
#pragma once

#include <cusp/geometry/cutter.hpp>
#include <cusp/geometry/frames.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace cusp::toolpath {

/// A tool pose in the programming frame: tip in mm, unit axis from the tip to the spindle.
struct CutterLocation {
    geometry::Vector3 tip_mm = geometry::Vector3::Zero();
    geometry::Vector3 axis = geometry::Vector3::UnitZ();
};

enum class MotionKind : std::uint8_t { Rapid, Feed };

/// GOTO: a straight move of the tip to `location`. APT's RAPID holds for one move; feed is modal.
struct LinearMotion {
    CutterLocation location;
    MotionKind kind = MotionKind::Feed;
};

/// A circular move of the tip at the feed that holds, from where the tool stands to `end`. The tool axis is the same at
/// both ends. It is a helix when `end` lies off the plane of the start: the height grows evenly with the angle.
struct ArcMotion {
    CutterLocation end;
    /// On the axis of the arc, in the plane through the start that is perpendicular to `normal`.
    geometry::Vector3 center_mm = geometry::Vector3::Zero();
    /// Unit vector; the motion is right-handed about it: counter-clockwise seen from its tip.
    geometry::Vector3 normal = geometry::Vector3::UnitZ();
    /// As the file says it, else the distance of the start. Start and end lie on the circle within `arc_tolerance_mm`.
    double radius_mm = 0.0;
    /// One whole turn: the end is above, below or at the start. Else the arc turns by less than 360°.
    bool full_circle = false;
};

/// How far the start and the end of an arc may be off its circle: the rounding of the file. A 840D refuses more
/// (MD21000 CIRCLE_ERROR_CONST, 0.01 mm as delivered).
inline constexpr double arc_tolerance_mm = 0.01;

/// NURBS with its KNOT and CNTRL statements (NX): the numbers as the file writes them, in its unit. What they mean beyond
/// that is not documented well enough to drive the curve from them; whoever needs the motion refuses it by name. Where the
/// curve ends is not known either.
struct SplineMotion {
    std::vector<double> parameters;             ///< of NURBS/
    std::vector<double> knots;                  ///< of every KNOT/, in file order
    std::vector<std::vector<double>> controls;  ///< one for each CNTRL/
};

/// INTOL, OUTTOL: how far the CAM system let the path be from the part surface. Modal.
struct PathTolerance {
    bool outside = false;  ///< OUTTOL: material is left; else INTOL: the part is cut into
    double value_mm = 0.0;
};

/// FROM: where the tool stands before the first move. It moves nothing.
struct StartPosition {
    CutterLocation location;
};

/// GOHOME: to the machine's home position, which the file does not know.
struct HomeReturn {};

/// FEDRAT. Modal until the next.
struct FeedRate {
    enum class Unit : std::uint8_t { MmPerS, MmPerRev };
    double value = 0.0;
    Unit unit = Unit::MmPerS;

    bool operator==(const FeedRate&) const = default;
};

/// CYCLE/…: from here to `CycleEnd` every location is a hole. Heights are above the hole's location, along the tool
/// axis; the depth is below it.
struct CycleStart {
    enum class Kind : std::uint8_t {
        Drill,      ///< to depth in one go, dwell
        Deep,       ///< in pecks, out of the hole after each
        BreakChip,  ///< in pecks, with a short lift after each
        Bore,       ///< as Drill, out at the feed
        Tap         ///< the spindle turns back on the way out
    };
    Kind kind = Kind::Drill;
    double depth_mm = 0.0;                ///< > 0, location to the bottom that the tip reaches
    std::optional<double> clearance_mm;   ///< where the feed begins
    std::optional<double> retract_mm;     ///< where the tool ends; absent: the clearance
    std::optional<FeedRate> feed;         ///< absent: the feed that holds
    std::optional<double> first_peck_mm;  ///< absent: as `peck_mm`
    std::optional<double> peck_mm;
    std::optional<double> dwell_s;  ///< at the bottom
};

/// A GOTO while a cycle is on: the tool works a hole here, and ends above it.
struct HoleLocation {
    CutterLocation location;
};

/// CYCLE/OFF.
struct CycleEnd {};

/// CUTCOM: the control offsets the path to the side, seen in the direction of the feed.
struct CutterCompensation {
    enum class Side : std::uint8_t { Off, Left, Right };
    Side side = Side::Off;
    std::optional<std::int64_t> offset_number;
};

/// SPINDL. Directions as seen from the spindle towards the workpiece: CLW is clockwise (M3).
struct SpindleCommand {
    enum class Turn : std::uint8_t { Off, Clockwise, CounterClockwise };
    enum class Unit : std::uint8_t { Rpm, SurfaceMPerMin };
    Turn turn = Turn::Off;
    std::optional<double> speed;  ///< in `unit`; absent in SPINDL/ON and SPINDL/OFF
    Unit unit = Unit::Rpm;
};

struct CoolantCommand {
    enum class Kind : std::uint8_t { Off, Flood, Mist, Through };
    Kind kind = Kind::Off;
};

/// A tool is called: LOADTL, LOAD/TOOL, or NX's `TOOL PATH/…,TOOL,NAME` when the name changes. What the file told of the
/// tool up to here comes with it.
struct ToolCall {
    std::optional<std::int64_t> number;
    std::string name;
    std::optional<geometry::Cutter> cutter;
};

/// An operation begins (NX `TOOL PATH/NAME`, CATIA `$$ OPERATION NAME : NAME`).
struct OperationStart {
    std::string name;
};

/// Where the frame of the following points lies (NX MSYS, CATIA `$$*CATIA0`). The points are already in this frame.
struct ProgrammingFrame {
    geometry::RigidTransform part_from_programming = geometry::RigidTransform::Identity();
};

/// The plane of the following operation in the programming frame (SolidWorks CAM CSYS): its Z is the tool axis of 3+2
/// machining. Points and axes stay in the programming frame.
struct WorkPlane {
    geometry::RigidTransform programming_from_plane = geometry::RigidTransform::Identity();
};

/// Text for people: PARTNO, PPRINT, INSERT.
struct Remark {
    enum class Kind : std::uint8_t { PartName, Message, Insert };
    Kind kind = Kind::Message;
    std::string text;
};

/// STOP and OPSTOP.
struct ProgramStop {
    bool optional = false;
};

struct Dwell {
    double seconds = 0.0;
};

/// FINI, END, END-OF-PATH at the end of the file.
struct ProgramEnd {};

using ClStatement =
    std::variant<LinearMotion, FeedRate, SpindleCommand, CoolantCommand, ToolCall, OperationStart, ProgrammingFrame,
                 Remark, ProgramStop, Dwell, ProgramEnd, ArcMotion, StartPosition, HomeReturn, CycleStart, HoleLocation,
                 CycleEnd, CutterCompensation, WorkPlane, SplineMotion, PathTolerance>;

/// A statement and the line of the CL file it began on (from 1).
struct ClRecord {
    ClStatement statement;
    std::uint32_t line = 0;
};

}  // namespace cusp::toolpath
