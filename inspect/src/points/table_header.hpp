// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The names people give the columns of a table of points.
#pragma once

#include "points/table_layout.hpp"

#include <string_view>
#include <vector>

namespace cusp::inspect {

/// Takes columns from their names ("x", "X [mm]", "nx", "section_X" …); false, with an error in `out`, when there is not
/// exactly one x, y and z.
[[nodiscard]] bool columnsFromNames(const std::vector<std::string_view>& names, std::uint64_t line, TableLayout& layout,
                                    PointCollector& out);

}  // namespace cusp::inspect
