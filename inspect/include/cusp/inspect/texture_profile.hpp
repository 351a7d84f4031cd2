// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A profile traced by a stylus, read from cusp's own text format.
#pragma once

#include <cusp/base/result.hpp>

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace cusp::inspect {

/// Heights at equal distances along the trace.
struct StylusProfile {
    std::string source;  ///< the file's name, for messages
    double spacing_mm = 0.0;
    std::vector<double> height_mm;
    std::optional<double> tip_radius_mm;

    /// From the first sample to the last.
    [[nodiscard]] double lengthMm() const {
        return height_mm.size() < 2 ? 0.0 : spacing_mm * static_cast<double>(height_mm.size() - 1);
    }
};

/// The coarsest spacing texture can be seen with: ten times the 5 µm that ISO 3274:1996 table 1 allows at most.
inline constexpr double coarsest_spacing_mm = 0.05;
/// The largest spacing ISO 3274:1996 table 1 allows (cut-offs 2.5 and 8 mm); beyond it a warning.
inline constexpr double standard_spacing_mm = 0.005;
/// A ball of this radius or more bridges texture (ISO 3274 styli have 2, 5 or 10 µm).
inline constexpr double largest_tip_radius_mm = 0.1;

/// Reads
///
///     cusp_stylus_profile,1
///     spacing_um,0.5
///     tip_radius_um,2
///     height_um
///     0.113
///     …
///
/// `spacing_…`, `tip_radius_…` (optional) and the column's name carry their unit: `_mm`, `_um` or `_nm`. Instead of
/// `spacing_…` there may be a second column in front, `x_mm,height_um`: its steps must be equal to 1 % of their mean. Columns
/// are parted by comma, semicolon or tab; behind a semicolon or tab a decimal comma is understood. Lines that start with
/// `#` are remarks.
///
/// Errors: `texture.format` (with line), `texture.number`, `texture.spacing`, `texture.too-coarse` and `texture.tip` (such
/// points cannot see texture), `texture.too-few` (fewer than 100 heights), `io.read`. Warning: `texture.spacing`.
[[nodiscard]] base::Result<StylusProfile> readStylusProfile(std::istream& in, const std::string& name,
                                                            base::Diagnostics& warnings);

}  // namespace cusp::inspect
