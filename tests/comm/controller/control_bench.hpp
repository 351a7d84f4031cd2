// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A virtual control on a shipped machine, with what its axes did.
#pragma once

#include <cusp/comm/controller/virtual_control.hpp>
#include <cusp/dynamics/tool_path.hpp>

#include <string>
#include <vector>

namespace cusp::comm::test {

[[nodiscard]] post::MachineFile shippedMachine(const std::string& name);

/// The machine, the control on it, and every sample.
struct Bench {
    explicit Bench(const std::string& machine_name, const ControlOptions& wanted = {});

    post::MachineFile file;
    kinematics::Machine machine;
    ControlOptions options;
    VirtualControl control;
    std::vector<ControlSample> samples;

    /// Largest share of velocity, acceleration and jerk limits over all samples.
    [[nodiscard]] double limitUse() const;
    [[nodiscard]] dynamics::ToolPlace toolAt(const ControlSample& sample) const;
    /// Largest distance of the tip from the polyline, over the samples of lines `first_line` to `last_line`.
    [[nodiscard]] double missOf(const std::vector<geometry::Vector3>& path, std::size_t first_line,
                                std::size_t last_line) const;
};

/// A five-axis program for the C-then-A gantry that winds across a surface, and the tips it programs.
struct FiveAxisProgram {
    std::string text;
    std::vector<geometry::Vector3> tips;
    std::size_t first_cut_line = 0;
    std::size_t last_cut_line = 0;
};
[[nodiscard]] FiveAxisProgram fiveAxisProgram(std::size_t blocks, double step_mm);

}  // namespace cusp::comm::test
