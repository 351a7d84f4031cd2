// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From rotary axis values to the tool axis, straight from the machine file's data.
#pragma once

#include <cusp/machine/machine_definition.hpp>
#include <cusp/post/reader/vector3.hpp>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace cusp::post::reader {

/// More than any machine file may have, so that positions need no allocation.
inline constexpr std::size_t max_rotary_axes = 3;
using RotaryValues = std::array<double, max_rotary_axes>;

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

private:
    struct Joint {
        std::string name;
        machine::RotaryAxis axis;
        Vector3 direction;
    };
    std::vector<Joint> joints_;
    Vector3 spindle_axis_;
};

}  // namespace cusp::post::reader
