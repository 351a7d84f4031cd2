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

/// What a program does not say, and the shop knows: of the tool and the work offset that are active.
struct Placement {
    std::optional<double> tool_length_mm;  ///< from the gauge point to the tip
    std::optional<Vector3> origin_mm;      ///< of the work offset, machine frame, all axes at zero
};

/// Because the machine file gives every direction as the motion of the tool relative to the workpiece (ISO 841), tables
/// and heads are the same thing here: one product of rotations in the order of the chain.
class ForwardChain {
public:
    explicit ForwardChain(const machine::MachineDefinition& machine);

    [[nodiscard]] std::size_t rotaryCount() const { return joints_.size(); }
    /// Names in chain order, from workpiece to tool; `RotaryValues` has the same order.
    [[nodiscard]] const std::string& rotaryName(std::size_t index) const { return joints_[index].name; }
    [[nodiscard]] const machine::RotaryAxis& rotaryAxis(std::size_t index) const { return joints_[index].axis; }

    /// Unit vector from the tip to the spindle in the workpiece frame, rotary values in rad.
    [[nodiscard]] Vector3 toolAxis(const RotaryValues& rotary_rad) const;

    /// How far a tool axis is from the pole, the direction the first rotary axis turns about: there its angle is free.
    [[nodiscard]] double poleAngle(const Vector3& axis) const;

    /// Whether `tip` can be told: the tool length is known and, where a linear axis is carried by a rotary one (a rotary
    /// table), the origin too.
    [[nodiscard]] bool placesTip(const Placement& placement) const;
    /// The tip without TRAORI, in the frame of the work offset, for programmed X, Y, Z in mm: machine positions, shifted so
    /// that they are the tip while all rotary axes are at zero.
    [[nodiscard]] Vector3 tip(const Vector3& programmed_mm, const RotaryValues& rotary_rad,
                              const Placement& placement) const;

    /// A bound on the second derivative of `tip` by the fraction of a motion in which all axes run evenly from one
    /// position to the other, mm: between samples 1/n apart the tip is at most an eighth of it by n² off their chords.
    [[nodiscard]] double tipBend(const Vector3& from_mm, const RotaryValues& from_rad, const Vector3& to_mm,
                                 const RotaryValues& to_rad, const Placement& placement) const;

    [[nodiscard]] std::size_t linearCount() const { return linear_.size(); }
    /// In chain order, as `linearPositions`.
    [[nodiscard]] const std::string& linearName(std::size_t index) const { return linear_[index].name; }
    [[nodiscard]] const machine::LinearAxis& linearAxis(std::size_t index) const { return linear_[index].axis; }
    /// Where the three linear axes stand for a tip in the frame of the work offset. Nothing when tool length or origin are
    /// not known, or the rotary axes have turned the linear ones into one plane.
    [[nodiscard]] std::optional<std::array<double, 3>>
    linearPositions(const Vector3& tip_mm, const RotaryValues& rotary_rad, const Placement& placement) const;

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
    struct Slide {
        std::string name;
        machine::LinearAxis axis;
        Vector3 direction;
    };
    [[nodiscard]] Vector3 tipAtZero(const Placement& placement) const;
    /// How far each linear axis stands from zero.
    [[nodiscard]] std::array<double, 3> linearValues(const Vector3& programmed_mm, const Placement& placement) const;
    /// Machine frame.
    [[nodiscard]] Vector3 tipOf(const std::array<double, 3>& linear_mm, const RotaryValues& rotary_rad,
                                const Placement& placement) const;
    [[nodiscard]] bool withinLimits(std::size_t joint, double angle_rad) const;

    std::vector<Joint> joints_;
    std::vector<Place> places_;
    std::vector<Slide> linear_;
    Vector3 spindle_axis_;
    Vector3 gauge_point_mm_;
    bool spans_ = false;    ///< the linear axes reach every direction
    bool carried_ = false;  ///< a rotary axis carries a linear one: the origin counts
};

}  // namespace cusp::post::reader
