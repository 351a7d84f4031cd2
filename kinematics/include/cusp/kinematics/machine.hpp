// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A serial machine of three linear and up to two rotary axes: forward and closed-form inverse kinematics.
#pragma once

#include <cusp/geometry/frames.hpp>
#include <cusp/machine/machine_definition.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace cusp::kinematics {

using geometry::Matrix3;
using geometry::RigidTransform;
using geometry::Vector3;

/// Positions of the rotary axes in chain order: [0] is the one nearer the workpiece. Unused places are zero.
using RotaryValues = std::array<double, 2>;

/// Positions of all axes, linear and rotary each in chain order from workpiece to tool (`Machine::linearNames`).
struct AxisValues {
    Vector3 linear_mm = Vector3::Zero();
    RotaryValues rotary_rad{};
};

/// Travel of one axis. Endless axes have no ends.
struct AxisRange {
    bool endless = false;
    double min = 0.0;
    double max = 0.0;

    /// How far `value` lies beyond the range; 0 inside.
    [[nodiscard]] double excess(double value) const {
        if (endless) return 0.0;
        return value < min ? min - value : (value > max ? value - max : 0.0);
    }
};

/// The rotary positions that give a tool axis, windings left open: every angle is in (−π, π].
struct AxisSolutions {
    std::array<RotaryValues, 2> branch{};
    std::uint8_t count = 0;  ///< distinct branches, 1 or 2
    /// The tool axis lies along the first rotary axis: its angle is free (given as 0) and the one branch holds the other.
    bool pole = false;
    /// 0 when the axis is reached; else the angle by which it misses the machine's range, and the branches hold the
    /// nearest axis that is reached.
    double miss_rad = 0.0;
    /// What the first axis' angles are made of with two rotary axes: α − β for branch 0, α + β for branch 1. Off the pole
    /// β is continuous, in [−π, 0], and α turns by less than half a turn along any great circle shorter than that.
    double alpha_rad = 0.0;
    double beta_rad = 0.0;
    double gap_rad = std::numeric_limits<double>::infinity();  ///< as `branchGap`, with two rotary axes
};

/// Solutions for a whole pose.
struct PoseSolutions {
    std::vector<AxisValues> values;  ///< every branch in every winding within the limits of the rotary axes
    bool pole = false;               ///< the first rotary axis is free and given at 0 (or the limit nearest to it)
    double miss_rad = 0.0;           ///< as in AxisSolutions; `values` is empty when above the tolerance asked for
};

/// A machine ready to compute; constant once built, and safe to share between threads.
///
/// Frames: the workpiece frame and the tool frame both coincide in direction with the machine frame when all axes are at
/// zero; the workpiece frame also in origin, while the tool frame's origin is the tool tip. Every axis' direction is the
/// motion of the tool relative to the workpiece (ISO 841), so the pose is the product of the axes' motions along the
/// chain, whichever axes the table carries. Lengths in mm, angles in rad.
class Machine {
public:
    /// The definition must fulfil the checks of `machine::machineSection` (as every definition read from a file does).
    explicit Machine(machine::MachineDefinition definition);

    [[nodiscard]] const machine::MachineDefinition& definition() const { return definition_; }
    [[nodiscard]] const std::array<std::string, 3>& linearNames() const { return linear_names_; }
    [[nodiscard]] const std::vector<std::string>& rotaryNames() const { return rotary_names_; }
    [[nodiscard]] std::size_t rotaryCount() const { return rotary_names_.size(); }
    [[nodiscard]] const AxisRange& linearRange(std::size_t i) const { return linear_range_[i]; }
    [[nodiscard]] const AxisRange& rotaryRange(std::size_t i) const { return rotary_range_[i]; }
    [[nodiscard]] double rotaryVelocity(std::size_t i) const { return rotary_velocity_rad_per_s_[i]; }
    [[nodiscard]] RotaryValues rotaryHome() const { return rotary_home_rad_; }

    /// The tool frame in the workpiece frame. The tip is the gauge point less `tool_length_mm` along the spindle axis.
    [[nodiscard]] RigidTransform workpieceFromTool(const AxisValues& values, double tool_length_mm) const;
    /// Tip and tool axis in the workpiece frame.
    [[nodiscard]] toolpath::CutterLocation forward(const AxisValues& values, double tool_length_mm) const;
    /// The tool axis in the workpiece frame; linear axes do not matter to it.
    [[nodiscard]] Vector3 toolAxis(const RotaryValues& rotary_rad) const;

    /// Rotary positions for a unit tool axis in the workpiece frame, in closed form, limits not considered. An axis
    /// within `pole_tolerance_rad` of the first rotary axis counts as the pole, and is then missed by that much at most.
    [[nodiscard]] AxisSolutions solveAxis(const Vector3& axis, double pole_tolerance_rad = 1e-13) const;
    /// How far `axis` is from where the two branches meet: the pole, or either end of what the rotary axes reach. Negative
    /// beyond. Infinite on a machine without two branches.
    [[nodiscard]] double branchGap(const Vector3& axis) const;
    [[nodiscard]] const Vector3& rotaryDirection(std::size_t i) const { return rotary_direction_[i]; }
    /// Linear positions that bring the tip to `tip_mm` (workpiece frame) with the rotary axes where they are. Empty when
    /// a rotary axis between linear ones has turned them into one plane.
    [[nodiscard]] std::optional<Vector3> solveLinear(const Vector3& tip_mm, const RotaryValues& rotary_rad,
                                                     double tool_length_mm) const;
    /// Every solution for a pose within the rotary limits. Linear limits depend on where the workpiece is clamped, and
    /// are the caller's to judge (`linearRange`). A pose missed by up to `axis_tolerance_rad` is taken as its nearest.
    [[nodiscard]] PoseSolutions inverse(const toolpath::CutterLocation& location, double tool_length_mm,
                                        double axis_tolerance_rad = 1e-12) const;

    /// Every position `angle_rad` + 2πk within the range of rotary axis `i`, ascending. An endless axis has one.
    [[nodiscard]] std::vector<double> windings(std::size_t i, double angle_rad) const;

private:
    struct Joint {
        bool is_rotary = false;
        std::size_t index = 0;  ///< among the axes of its kind
        Vector3 direction;
        Vector3 point;
    };
    void prepareTwoRotaryAxes();
    [[nodiscard]] AxisSolutions solveTwo(const Vector3& axis, double pole_tolerance_rad) const;
    [[nodiscard]] AxisSolutions solveOne(const Vector3& axis, double pole_tolerance_rad) const;

    machine::MachineDefinition definition_;
    std::vector<Joint> chain_;
    std::array<std::string, 3> linear_names_;
    std::vector<std::string> rotary_names_;
    std::array<AxisRange, 3> linear_range_;
    std::array<AxisRange, 2> rotary_range_;
    RotaryValues rotary_velocity_rad_per_s_{1.0, 1.0};
    RotaryValues rotary_home_rad_{};
    std::array<Vector3, 2> rotary_direction_;
    Vector3 spindle_axis_;
    Vector3 gauge_point_;

    // Constants of the closed form, see README.md: e1 and e2 span the plane across the first rotary axis, e1 towards the
    // second; theta_* are the angles of the spherical triangle first axis – second axis – tool.
    Vector3 e1_ = Vector3::UnitX();
    Vector3 e2_ = Vector3::UnitY();
    double theta_12_ = 0.0;
    double theta_2t_ = 0.0;
    double theta_min_ = 0.0;
    double theta_max_ = 0.0;
    double phi_ = 0.0;
    bool orthogonal_ = false;
};

}  // namespace cusp::kinematics
