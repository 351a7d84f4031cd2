// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reads measured points from the files that measuring machines and scanners write.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/inspect/measured_points.hpp>

#include <cstddef>
#include <istream>
#include <optional>
#include <string>

namespace cusp::inspect {

struct PointReaderOptions {
    /// "table" (CSV, XYZ, ASC), "dmis", "pc-dmis", "calypso", "pcd", "ply", "qif"; empty: found from the text.
    std::string format{};
    /// Columns of a table in their order, e.g. "id,x,y,z,i,j,k,section,-"; empty: from the header, or from the numbers.
    std::string columns{};
    /// Length of the file's unit; absent: as the file says, else 1 mm.
    std::optional<double> mm_per_unit{};
    /// '.' or ','; absent: found from the numbers.
    std::optional<char> decimal{};
    /// Absent: as the file says, if it does.
    std::optional<PointKind> kind{};
    /// Bytes read at once; results do not depend on it.
    std::size_t block_bytes = std::size_t{1} << 20U;
};

/// Reads all points; `name` is the file's, for messages. What is peculiar but can be read becomes a warning or a note in
/// `report` (columns not used, duplicates, points without coordinates in a cloud, statements that say no point).
///
/// Errors, each with its line: `points.empty`, `points.format`, `points.header`, `points.columns`, `points.number`,
/// `points.ambiguous-comma`, `points.unit`, `points.truncated`, of QIF those of `readQif`; all problems of a table are reported at once.
[[nodiscard]] base::Result<MeasuredPoints> readMeasuredPoints(std::istream& in, const std::string& name,
                                                              const PointReaderOptions& options,
                                                              base::Diagnostics& report);

}  // namespace cusp::inspect
