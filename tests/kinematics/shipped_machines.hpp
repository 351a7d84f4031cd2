// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The machines the house ships, and small machines made up for a test.
#pragma once

#include <cusp/kinematics/machine.hpp>

#include <string>
#include <vector>

namespace cusp::kinematics::test {

/// Names without ".toml", sorted.
[[nodiscard]] std::vector<std::string> shippedMachineNames();
/// Fails the running test with the file's diagnostics, and stops it, when the file is not good.
[[nodiscard]] machine::MachineDefinition shippedMachine(const std::string& name);

/// X, Y, Z along the machine frame carry the tool; `chain` places the rotary axes.
[[nodiscard]] machine::MachineDefinition plainMachine(std::vector<std::string> chain);
/// An axis through the origin; limits in degrees.
[[nodiscard]] machine::RotaryAxis limitedAxis(const Vector3& direction, double min_deg, double max_deg);
[[nodiscard]] machine::RotaryAxis endlessAxis(const Vector3& direction);

}  // namespace cusp::kinematics::test
