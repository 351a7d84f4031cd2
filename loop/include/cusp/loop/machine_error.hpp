// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a machine may have wrong, by name, and the machine that has it.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/dynamics/axis_limits.hpp>
#include <cusp/geometry/cutter.hpp>
#include <cusp/kinematics/machine.hpp>

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::loop {

using geometry::Vector3;

/// One thing a machine may have wrong. The name ends in its unit (mm, deg, ms); values are in that unit everywhere, since
/// they are read, written and reported under that name and computed with in `realMachine` only.
struct ErrorParameter {
    enum class Kind { ToolLength, ToolRadius, PivotLength, AxisPoint, AxisTilt, AxisZero, Squareness, Lag };
    std::string name;
    Kind kind = Kind::ToolLength;
    std::size_t axis = 0;   ///< rotary or linear axis by its place in the chain; of lags by place in AxisVector
    std::size_t other = 0;  ///< of squareness: the axis it leans towards
    Vector3 direction = Vector3::Zero();  ///< of points: where to; of tilts: about which direction
    double typical = 0.0;                 ///< what a machine in use may have: scales columns, draws hidden errors
    std::string meaning;                  ///< one line for people
};

/// Every parameter of a machine, without those that are another one in other words: the pivot length stands for the last
/// tool-side rotary axis' place along the spindle, the first rotary axis' zero for the second one's tilt about it.
///
/// pivot_length_mm, tool_length_mm, tool_radius_mm; axis_A_y_mm (place of a rotary axis), axis_A_about_y_deg (its direction),
/// zero_A_deg; square_XY_deg (the angle of Y from the square, towards X); lag_X_ms (servo lag, first order).
[[nodiscard]] std::vector<ErrorParameter> errorParameters(const kinematics::Machine& machine);

/// Errors by parameter name; what is not named is zero.
using MachineErrors = std::map<std::string, double>;

/// A file `[error]` of names and values. Errors: those of TOML, `machine-error.unknown` (lists the names this machine has).
[[nodiscard]] base::Result<MachineErrors> readMachineErrors(const std::string& path,
                                                            const kinematics::Machine& machine);
[[nodiscard]] base::Result<MachineErrors> parseMachineErrors(std::string_view text, const std::string& file_name,
                                                             const kinematics::Machine& machine);
[[nodiscard]] std::string toToml(const MachineErrors& errors);

/// How the workpiece and the tool are set: what the control believes.
struct CuttingSetup {
    double tool_length_mm = 100.0;            ///< gauge point to tip
    Vector3 wcs_origin_mm = Vector3::Zero();  ///< of the work offset, machine frame
};

/// A machine with errors, and what the same axis positions really do on it.
struct RealMachine {
    kinematics::Machine model;
    double tool_length_mm = 0.0;
    double tool_radius_error_mm = 0.0;
    dynamics::AxisVector lag_s{};
    kinematics::RotaryValues zero_rad{};
    /// The datum is touched with this machine and this tool: at the work offset's origin, rotary axes at zero, the tip is
    /// where the control believes it. workpiece = forward(axes) − origin.
    Vector3 origin_mm = Vector3::Zero();

    /// Tip and axis in the frame of the work offset.
    [[nodiscard]] toolpath::CutterLocation place(const dynamics::AxisVector& axes) const;
    /// The tool's frame there: origin at the tip, parallel to the machine's with the rotary axes at zero.
    [[nodiscard]] geometry::RigidTransform wcsFromTool(const dynamics::AxisVector& axes) const;
    [[nodiscard]] geometry::Cutter cutter(const geometry::Cutter& nominal) const;
};

/// Errors: `machine-error.unknown`, `machine-error.range` (lengths beyond 5 mm, angles beyond 2°, lags outside 0 … 100 ms:
/// no machine that works).
[[nodiscard]] base::Result<RealMachine> realMachine(const machine::MachineDefinition& nominal,
                                                    const MachineErrors& errors, const CuttingSetup& setup);

/// The same machine and tool behind a control that believes another definition, setup and zeros of its rotary axes than
/// `nominal`, `nominal_setup` and none, which the errors are counted from: what a machine is after its data were corrected.
[[nodiscard]] base::Result<RealMachine>
realMachineBehind(const machine::MachineDefinition& nominal, const CuttingSetup& nominal_setup,
                  const MachineErrors& errors, const machine::MachineDefinition& believed,
                  const CuttingSetup& believed_setup, const kinematics::RotaryValues& believed_zero_rad);

/// The definition with the errors in it: as it really is. Lengths of tools, zeros and lags are no part of a definition.
[[nodiscard]] machine::MachineDefinition withErrors(const machine::MachineDefinition& nominal,
                                                    const MachineErrors& errors);

}  // namespace cusp::loop
