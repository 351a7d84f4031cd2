// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Programs without TRAORI: where the linear axes must be, and how far the tip strays between two positions of all axes.
#pragma once

#include <cusp/kinematics/machine.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <optional>
#include <vector>

namespace cusp::post {

/// The programmed point is what the control shows with the tool length active: the position of the linear axes, shifted so
/// that it is the tip in the work offset's frame while all rotary axes are at zero.
class MachineAxes {
public:
    /// `format`: the decimals the positions will be printed with.
    MachineAxes(const kinematics::Machine& machine, NumberFormat format);

    /// `tool_length_mm` from the gauge point to the tip; `wcs_origin_mm` of the work offset in the machine frame, all axes at
    /// zero.
    void setUp(double tool_length_mm, const geometry::Vector3& wcs_origin_mm);

    /// Whether a rotary axis carries the tool, so that its length matters.
    [[nodiscard]] bool needsToolLength() const { return needs_tool_length_; }
    /// Whether a rotary axis carries the workpiece or a linear axis, so that the place of the origin matters.
    [[nodiscard]] bool needsOrigin() const { return needs_origin_; }

    /// The positions as they will stand in the program.
    [[nodiscard]] kinematics::RotaryValues printed(const kinematics::RotaryValues& rotary_rad) const;
    [[nodiscard]] geometry::Vector3 printed(const geometry::Vector3& point_mm) const;
    /// Where a tip in the work offset's frame is programmed while the rotary axes stand still. Empty where the rotary axes
    /// have turned two linear axes into one direction.
    [[nodiscard]] std::optional<Eigen::Affine3d>
    programmedFromWorkpiece(const kinematics::RotaryValues& rotary_rad) const;

    /// All axes at one block end.
    struct Position {
        geometry::Vector3 point_mm = geometry::Vector3::Zero();
        kinematics::RotaryValues rotary_rad{};
    };
    /// No less than the largest distance between the tip, while all axes run linearly from one position to another, and the
    /// point at the same fraction of the straight line between the ends. With e(s) that difference, e(0) = e(1) = 0, the
    /// parabola through both and e(1/2) misses e by at most max|e'''| · max|s(s − 1/2)(s − 1)|/6 = max|e'''| · √3/216; and
    /// e''' is that of the tip, bounded joint by joint along the chain.
    [[nodiscard]] double chordError(const Position& from, const Position& to) const;
    /// How far printing the linear positions may put the tip off.
    [[nodiscard]] double printError() const { return print_error_mm_; }

private:
    struct Joint {
        bool rotary = false;
        Eigen::Index index = 0;
        geometry::Vector3 direction;
        geometry::Vector3 point;
    };
    [[nodiscard]] geometry::Vector3 linearPositions(const geometry::Vector3& point_mm) const;
    [[nodiscard]] geometry::Vector3 tip(const geometry::Vector3& linear_mm,
                                        const kinematics::RotaryValues& rotary_rad) const;
    [[nodiscard]] double thirdDerivative(const Position& from, const Position& to) const;

    std::vector<Joint> chain_;
    geometry::Vector3 spindle_axis_;
    geometry::Vector3 gauge_point_;
    geometry::Matrix3 directions_ = geometry::Matrix3::Identity();  ///< of the linear axes, all axes at zero
    geometry::Matrix3 positions_from_directions_ = geometry::Matrix3::Identity();
    geometry::Vector3 tip_at_zero_ = geometry::Vector3::Zero();
    geometry::Vector3 origin_ = geometry::Vector3::Zero();
    NumberFormat format_;
    double print_error_mm_ = 0.0;
    bool needs_tool_length_ = false;
    bool needs_origin_ = false;
};

}  // namespace cusp::post
