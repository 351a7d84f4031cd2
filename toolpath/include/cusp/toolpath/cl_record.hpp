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

/// FEDRAT. Modal until the next.
struct FeedRate {
    enum class Unit : std::uint8_t { MmPerS, MmPerRev };
    double value = 0.0;
    Unit unit = Unit::MmPerS;
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

using ClStatement = std::variant<LinearMotion, FeedRate, SpindleCommand, CoolantCommand, ToolCall, OperationStart,
                                 ProgrammingFrame, Remark, ProgramStop, Dwell, ProgramEnd>;

/// A statement and the line of the CL file it began on (from 1).
struct ClRecord {
    ClStatement statement;
    std::uint32_t line = 0;
};

}  // namespace cusp::toolpath
