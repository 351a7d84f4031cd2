// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Conversions between the units inside (mm, rad, s) and those people write.
#pragma once

#include <numbers>

namespace cusp::base {

inline constexpr double mm_per_inch = 25.4;  ///< exact since 1959

[[nodiscard]] constexpr double radFromDeg(double deg) { return deg * (std::numbers::pi / 180.0); }
[[nodiscard]] constexpr double degFromRad(double rad) { return rad * (180.0 / std::numbers::pi); }
[[nodiscard]] constexpr double mmPerSFromMmPerMin(double mm_per_min) { return mm_per_min / 60.0; }
[[nodiscard]] constexpr double mmPerMinFromMmPerS(double mm_per_s) { return mm_per_s * 60.0; }

}  // namespace cusp::base
