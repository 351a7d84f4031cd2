// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a table of points looks like: separator, decimal mark, and which column is what.
#pragma once

#include "points/point_collector.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::inspect {

struct TableLayout {
    char separator = ',';  ///< ' ' for any run of blanks
    char decimal = '.';
    bool has_header = false;
    std::size_t columns = 0;                ///< fields a row has
    std::array<std::size_t, 3> position{};  ///< columns of x, y, z
    std::optional<std::array<std::size_t, 3>> direction;
    std::optional<std::size_t> section;
    std::optional<std::size_t> weight;
    int section_axis = -1;              ///< "section_X": 0
    std::optional<double> mm_per_unit;  ///< "x [inch]"
};

/// Whether a line is a remark: '#', '//', '%' or '!' at its start.
[[nodiscard]] bool isRemark(std::string_view line);

/// The layout of a table from its first lines (remarks and empty lines left out), counted from `first_line`; nothing, with
/// errors in `out`, when it cannot be told.
[[nodiscard]] std::optional<TableLayout> findLayout(const std::vector<std::string_view>& lines,
                                                    const std::vector<std::uint64_t>& line_numbers,
                                                    const PointReaderOptions& options, PointCollector& out);

}  // namespace cusp::inspect
