// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The unit words of feeds, shared by FEDRAT and CYCLE.
#pragma once

#include "reader_context.hpp"

namespace cusp::toolpath::detail {

struct FeedUnit {
    double mm_per_unit;
    FeedRate::Unit unit;
};

/// MMPM, MMPR, IPM, IPR; PERMIN and PERREV in the unit of the file. Reports a unit that contradicts the one implied for
/// the whole file.
[[nodiscard]] std::optional<FeedUnit> feedUnit(ReaderContext& context, const Field& field);
/// A feed as the file writes it, in mm/s or mm/rev.
[[nodiscard]] FeedRate feedRate(double value, const FeedUnit& unit);

}  // namespace cusp::toolpath::detail
