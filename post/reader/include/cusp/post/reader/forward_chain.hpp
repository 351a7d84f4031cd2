// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From rotary axis values to the tool axis, straight from the machine file's data.
#pragma once

#include <cusp/machine/machine_definition.hpp>
#include <cusp/post/reader/vector3.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace cusp::post::reader {

/// More than any machine file may have, so that positions need no allocation.
inline constexpr std::size_t max_rotary_axes = 3;
using RotaryValues = std::array<double, max_rotary_axes>;

/// What a program does not say, and the shop knows.
struct MachineSetup {
    std::optional<double> tool_length_mm;                ///< of D1, from the gauge point to the tip
    std::optional<std::array<double, 3>> wcs_origin_mm;  ///< of the work offset, machine frame, all axes at zero
};

/// Because the machine file gives every direction as the motion of the tool relative to the workpiece (ISO 841), tables
/// and heads are the same thing here: one product of rotations in the order of the chain.
class ForwardChain {
public:
    explicit ForwardChain(const machine::MachineDefinition& machine, const MachineSetup& setup = {});

    [[nodiscard]] std::size_t rotaryCount() const { return joints_.size(); }
    /// Names in chain order, from workpiece to tool; `RotaryValues` has the same order.
    [[nodiscard]] const std::string& rotaryName(std::size_t index) const { return joints_[index].name; }
    [[nodiscard]] const machine::RotaryAxis& rotaryAxis(std::size_t index) const { return joints_[index].axis; }

    /// Unit vector from the tip to the spindle in the workpiece frame, rotary values in rad.
    [[nodiscard]] Vector3 toolAxis(const RotaryValues& rotary_rad) const;

    /// Whether `tip` can be told: the tool length is known and, where a linear axis is carried by a rotary one (a rotary
    /// table), the origin too.
    [[nodiscard]] bool placesTip() const { return places_tip_; }
    /// The tip without TRAORI, in the frame of the work offset, for programmed X, Y, Z in mm: machine positions, shifted so
    /// that they are the tip while all rotary axes are at zero.
    [[nodiscard]] Vector3 tip(const Vector3& programmed_mm, const RotaryValues& rotary_rad) const;

    /// A bound on the second derivative of `tip` by the fraction of a motion in which all axes run evenly from one
    /// position to the other, mm: between samples 1/n apart the tip is at most an eighth of it by n² off their chords.
    [[nodiscard]] double tipBend(const Vector3& from_mm, const RotaryValues& from_rad, const Vector3& to_mm,
                                 const RotaryValues& to_rad) const;

    /// Whether some position of the rotary axes within their limits points the tool along `axis` (unit). Solved here
    /// by itself, for up to two rotary axes; nothing for more.
    [[nodiscard]] std::optional<bool> reaches(const Vector3& axis) const;

private:
    struct Joint {
        std::string name;
        machine::RotaryAxis axis;
        Vector3 direction;
    };
    /// One place of the whole chain: a rotary axis by its index, or a linear one by its direction.
    struct Place {
        std::optional<std::size_t> rotary;
        Vector3 point_mm;
        std::size_t linear = 0;
    };
    /// How far each linear axis stands from zero.
    [[nodiscard]] std::array<double, 3> linearValues(const Vector3& programmed_mm) const;
    [[nodiscard]] bool withinLimits(std::size_t joint, double angle_rad) const;

    std::vector<Joint> joints_;
    std::vector<Place> places_;
    std::vector<Vector3> linear_directions_;
    Vector3 spindle_axis_;
    Vector3 tip_at_zero_mm_;
    Vector3 origin_mm_;
    bool places_tip_ = false;
};

}  // namespace cusp::post::reader
