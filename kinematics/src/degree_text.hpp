// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Angles in messages.
#pragma once

#include <string>

namespace cusp::kinematics {

/// A degree value as a machinist writes it: at most three decimals, no trailing zeros, no unit.
[[nodiscard]] std::string degreeText(double angle_rad);

}  // namespace cusp::kinematics
