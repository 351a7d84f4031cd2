// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A machine as data: what its TOML file says, nothing that moves. The post's writer and its independent reader share
// this and nothing else.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/base/toml_schema.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace cusp::machine {

/// A direction of unit length. Reading normalises what the file says and refuses a zero vector, so nobody after the
/// reader has to.
struct Direction : std::array<double, 3> {};

/// Positions of rotary axes by name, in rad; axes left out are at zero.
struct RotaryPose : std::map<std::string, double> {};

/// Directions follow ISO 841: the motion of the *tool relative to the workpiece* for a positive move, whichever of the
/// two the axis really carries. So one product along the chain gives the pose, and a table's C turns the other way.
struct LinearAxis {
    Direction direction{{0.0, 0.0, 1.0}};  ///< machine frame
    double min_mm = 0.0;
    double max_mm = 0.0;
    double home_mm = 0.0;
    double max_velocity_mm_per_s = 0.0;
    double max_acceleration_mm_per_s2 = 0.0;
    double max_jerk_mm_per_s3 = 0.0;
};

struct RotaryAxis {
    enum class Winding { Limited, Endless };
    Direction direction{{0.0, 0.0, 1.0}};           ///< machine frame, all axes at zero; right-handed
    std::array<double, 3> point_mm{0.0, 0.0, 0.0};  ///< a point on the axis, machine frame, all axes at zero
    Winding winding = Winding::Limited;
    std::optional<double> min_rad;  ///< given exactly when winding is Limited
    std::optional<double> max_rad;
    double home_rad = 0.0;
    double max_velocity_rad_per_s = 0.0;
    double max_acceleration_rad_per_s2 = 0.0;
    double max_jerk_rad_per_s3 = 0.0;
};

struct Spindle {
    Direction axis{{0.0, 0.0, 1.0}};                      ///< from the tip to the spindle, all axes at zero
    std::array<double, 3> gauge_point_mm{0.0, 0.0, 0.0};  ///< where the tool's gauge length starts, all axes at zero
    double max_speed_rpm = 0.0;
};

/// A pose known from outside cusp (a real program, a manual): FK∘IK cannot see a wrong sign, this can.
struct Anchor {
    std::string source;
    RotaryPose rotary_rad;                 ///< key `rotary_deg`
    Direction tool_axis{{0.0, 0.0, 1.0}};  ///< in the workpiece frame
    double tolerance_rad = 0.0;            ///< as well as the outside source is known
};

/// Says where a value comes from; every value no source speaks of is assumed, and `machine check` says so.
struct Source {
    std::vector<std::string> keys;  ///< dotted key paths; "rotary.A" covers everything below it
    std::string text;
};

struct MachineDefinition {
    std::int64_t schema = 1;
    std::string name;
    std::string description;
    /// From workpiece to tool: "workpiece", axis names, "base" (the standing part) once among them, "tool".
    std::vector<std::string> chain;
    std::map<std::string, LinearAxis> linear;
    std::map<std::string, RotaryAxis> rotary;
    Spindle spindle;
    std::vector<Anchor> anchors;
    std::vector<Source> sources;

    /// Axis names in chain order, without "workpiece", "base" and "tool".
    [[nodiscard]] std::vector<std::string> axisNames() const;
    /// Whether the axis moves the workpiece (stands before "base" in the chain).
    [[nodiscard]] bool carriesWorkpiece(const std::string& axis) const;
};

/// The dotted keys whose values no `[[source]]` speaks of: they are assumed. A table none of whose keys is covered is
/// named once ("rotary.A"), else its uncovered keys one by one ("rotary.A.max_jerk_deg_per_s3").
[[nodiscard]] std::vector<std::string> unknownProvenance(const MachineDefinition& definition);

/// The field table of the machine file's part that describes the machine (root keys other than `control`).
[[nodiscard]] const base::Section<MachineDefinition>& machineSection();

}  // namespace cusp::machine
