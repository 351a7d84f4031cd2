// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Looks ahead into the beginning of a file for what its first points already depend on: the dialect and the unit.
#pragma once

#include "dialect.hpp"

#include <cstddef>
#include <optional>
#include <string_view>

namespace cusp::toolpath::detail {

/// How far the look-ahead goes. NX states its unit with the first feed only, after the approach moves.
inline constexpr std::size_t head_bytes = std::size_t{1} << 20U;

enum class LengthUnit : std::uint8_t { Millimetre, Inch };

struct HeadFindings {
    std::optional<Dialect> dialect;
    std::optional<LengthUnit> stated;   ///< UNITS or UNIT before the first motion
    std::optional<LengthUnit> implied;  ///< by the first MMPM, MMPR, IPM or IPR, or by a later UNITS
};

[[nodiscard]] HeadFindings scanHead(std::string_view head);

/// MM, INCH, INCHES, IN.
[[nodiscard]] std::optional<LengthUnit> lengthUnitFromWord(std::string_view word);
/// MMPM and MMPR are millimetres, IPM and IPR inches.
[[nodiscard]] std::optional<LengthUnit> lengthUnitFromFeedWord(std::string_view word);
[[nodiscard]] double mmPerUnitOf(LengthUnit unit);

}  // namespace cusp::toolpath::detail
