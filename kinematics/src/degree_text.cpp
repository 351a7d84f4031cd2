// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Prints angles for messages.
#include "degree_text.hpp"

#include <cusp/base/units.hpp>

#include <fmt/format.h>

namespace cusp::kinematics {

std::string degreeText(double angle_rad) {
    std::string text = fmt::format("{:.3f}", base::degFromRad(angle_rad));
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

}  // namespace cusp::kinematics
