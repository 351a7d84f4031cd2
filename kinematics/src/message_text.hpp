// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Angles and lengths in messages.
#pragma once

#include <string>

namespace cusp::kinematics {

/// A degree value as a machinist writes it: at most three decimals, no trailing zeros, no unit.
[[nodiscard]] std::string degreeText(double angle_rad);
/// The same of a length in mm.
[[nodiscard]] std::string lengthText(double length_mm);

}  // namespace cusp::kinematics
