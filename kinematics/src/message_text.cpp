// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Prints angles and lengths for messages.
#include "message_text.hpp"

#include <cusp/base/units.hpp>

#include <fmt/format.h>

namespace cusp::kinematics {

namespace {

std::string threeDecimals(double value) {
    std::string text = fmt::format("{:.3f}", value);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text == "-0" ? "0" : text;
}

}  // namespace

std::string degreeText(double angle_rad) { return threeDecimals(base::degFromRad(angle_rad)); }

std::string lengthText(double length_mm) { return threeDecimals(length_mm); }

}  // namespace cusp::kinematics
