// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a program makes the machine do, in order: motions and events, as the reader hands them out.
#pragma once

#include <cusp/post/reader/forward_chain.hpp>
#include <cusp/post/reader/vector3.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cusp::post::reader {

struct BlockPlace {
    std::size_t line = 0;                       ///< of the program file, from 1
    std::optional<std::uint64_t> block_number;  ///< N word
};

enum class MotionCode : std::uint8_t { Rapid, Linear, ArcClockwise, ArcCounterClockwise };

/// How the tool axis runs between block ends under TRAORI (G groups 25 and 51, whichever MD21104 lets act; PGA p. 7-7).
enum class OrientationPath : std::uint8_t { RotaryLinear, GreatCircle };

struct Feed {
    enum class Mode : std::uint8_t { PerMinute, PerRevolution, InverseTime };
    Mode mode = Mode::PerMinute;
    /// mm/min, mm per revolution, or 1/min.
    std::optional<double> value;
};

enum class SpindleTurn : std::uint8_t { Off, Clockwise, CounterClockwise };

/// G40, G41, G42: the side of the programmed contour the control keeps the tool on.
enum class RadiusCompensation : std::uint8_t { Off, Left, Right };

/// The state a motion runs in.
struct ModalSnapshot {
    Feed feed;
    SpindleTurn spindle = SpindleTurn::Off;
    double spindle_rpm = 0.0;
    std::string tool;  ///< name or number in the spindle as written ("5", "BALL_10"); empty before any M6
    std::optional<int> cutting_edge;  ///< D; absent until the program or a tool change sets it
    bool mist = false;                ///< M7
    bool flood = false;               ///< M8
    std::string_view plane = "G17";   ///< G18, G19
    /// With it on, poses are those of the programmed contour: the tool's own path is off it by a radius the program does
    /// not tell.
    RadiusCompensation compensation = RadiusCompensation::Off;
    std::string work_offset;  ///< "G54" …; empty until the program sets it
    /// G60 (as delivered) or G9: the block ends at rest. CYCLE832 smooths all the same.
    bool exact_stop = true;
    std::optional<double> contour_tolerance_mm;       ///< CTOL
    std::optional<double> orientation_tolerance_rad;  ///< OTOL
};

/// Values the program has determined; an absent one is known to the control only.
struct AxisPositions {
    std::array<std::optional<double>, 3>
        linear_mm;  ///< X, Y, Z as programmed, in the active frame: tip under TRAORI; machine axes under SUPA
    std::array<std::optional<double>, max_rotary_axes> rotary_rad;  ///< chain order
};

/// Tip in mm and unit tool axis in the workpiece frame (that of the active work offset).
struct ToolPose {
    Vector3 tip_mm;
    Vector3 axis{0.0, 0.0, 1.0};
};

/// A circular or helical tip path. The radius runs linearly from `start_radius_mm` to `end_radius_mm`, which differ only
/// by what the control tolerates (MD21000).
struct Arc {
    Vector3 center_mm;  ///< at the height of the start point
    /// Unit vectors of the plane, first × second = normal (G17: X, Y; G18: Z, X; G19: Y, Z of the frame that is active).
    Vector3 first{1.0, 0.0, 0.0};
    Vector3 second{0.0, 1.0, 0.0};
    Vector3 normal{0.0, 0.0, 1.0};
    double start_angle_rad = 0.0;
    double sweep_rad = 0.0;  ///< counter-clockwise positive, full turns included
    double start_radius_mm = 0.0;
    double end_radius_mm = 0.0;
    double height_mm = 0.0;  ///< along the normal
};

struct ExecutedMotion {
    BlockPlace place;
    MotionCode code = MotionCode::Rapid;
    bool transformation = false;       ///< TRAORI is active
    bool machine_coordinates = false;  ///< SUPA, G53 or G153 in this block
    bool vector_programmed = false;    ///< A3, B3, C3 in this block: rotary values are the control's choice
    OrientationPath orientation_path = OrientationPath::GreatCircle;
    AxisPositions start;
    AxisPositions end;
    /// Absent where the program alone does not determine it: machine coordinates, an axis never programmed in this frame,
    /// rotary axes off zero without TRAORI.
    std::optional<ToolPose> start_pose;
    std::optional<ToolPose> end_pose;
    /// The ends of the programmed path in the frame of the work offset, where the poses are known: the tips, or, without
    /// TRAORI and with rotary axes away from zero, what the linear axes run between (`joint_linear`).
    Vector3 path_start_mm;
    Vector3 path_end_mm;
    bool joint_linear = false;
    Placement placement;    ///< of the tool and the work offset, as far as they are known
    bool in_cycle = false;  ///< made by a drilling cycle
    std::optional<Arc> arc;
    /// Valid during the call only.
    const ModalSnapshot* state = nullptr;
};

struct ToolChange {
    std::string tool;
};
struct SpindleStart {
    SpindleTurn turn = SpindleTurn::Clockwise;
    double rpm = 0.0;
};
struct SpindleStop {};
struct CoolantChange {
    bool mist = false;
    bool flood = false;
};
struct TransformationSwitch {
    bool on = false;
};
/// G4: one of the two is set.
struct DwellTime {
    std::optional<double> seconds;
    std::optional<double> revolutions;
};
struct MachineStop {
    bool optional = false;  ///< M1
};
struct OperatorMessage {
    std::string text;
};
/// CYCLE832 with the arguments as written; none switches it off.
struct HighSpeedSetting {
    std::vector<std::string> arguments;
};
struct ProgramEnd {
    int m_function = 30;
};

using ExecutedEvent = std::variant<ToolChange, SpindleStart, SpindleStop, CoolantChange, TransformationSwitch,
                                   DwellTime, MachineStop, OperatorMessage, HighSpeedSetting, ProgramEnd>;

/// Receives a program as it runs.
class ProgramSink {
public:
    ProgramSink() = default;
    ProgramSink(const ProgramSink&) = delete;
    ProgramSink& operator=(const ProgramSink&) = delete;
    ProgramSink(ProgramSink&&) = delete;
    ProgramSink& operator=(ProgramSink&&) = delete;
    virtual ~ProgramSink() = default;

    virtual void motion(const ExecutedMotion& motion) = 0;
    virtual void event(const BlockPlace& place, const ExecutedEvent& event) = 0;
};

}  // namespace cusp::post::reader
