// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Profile sections: points of a measured line or of a band cut from a cloud, ordered by arc length on the nominal.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/inspect/deviation.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::inspect {

/// Where sections are cut: planes across an axis of the nominal frame.
struct SectionPlan {
    int axis = 0;  ///< 0 X, 1 Y, 2 Z
    std::vector<double> positions_mm;
    /// Full width of the band; absent: half the smallest distance of two sections, at most 1 mm.
    std::optional<double> width_mm;
};

/// "X=-5,-30,-60,-90". Error `sections.text`.
[[nodiscard]] base::Result<SectionPlan> parseSectionPlan(std::string_view text);

/// One section; points by index into the measured points, ordered along the section.
struct SectionResult {
    std::string label;  ///< "X=-5", or the file's
    std::optional<int> axis;
    double position_mm = 0.0;
    double width_mm = 0.0;
    std::vector<std::uint32_t> points;
    std::vector<double> arc_length_mm;  ///< on the nominal section, 0 at the first point; between pieces one usual step
    /// Where in `points` the connected pieces of the section begin; {0} for a section in one piece.
    std::vector<std::uint32_t> piece_starts;
    double length_mm = 0.0;          ///< of all pieces
    DeviationStatistics statistics;  ///< `min_point`, `max_point` are indices of measured points
    std::size_t beyond_edge = 0;     ///< points of the section left out because they lie beyond an edge
};

/// "X=-5".
[[nodiscard]] std::string sectionLabel(int axis, double position_mm);

/// The sections of a plan. Where the file names a section of that label (a line of a measuring machine), its points;
/// otherwise the points whose footpoint lies within half the width of the plane. Points lie on the section where the
/// nominal meets the plane, ordered as the section runs, folded or closed; the arc length is that of the nominal section.
/// A section in several pieces has them one after another, in the order in which they were measured.
[[nodiscard]] std::vector<SectionResult> cutSections(const SectionPlan& plan, const MeasuredPoints& points,
                                                     std::span<const PointDeviation> deviations,
                                                     const geometry::NominalShape& nominal, double edge_tolerance_mm);

/// The sections the file names. One whose label is no plane keeps the order of the file, and chords as arc length.
[[nodiscard]] std::vector<SectionResult> measuredSections(const MeasuredPoints& points,
                                                          std::span<const PointDeviation> deviations,
                                                          const geometry::NominalShape& nominal,
                                                          double edge_tolerance_mm);

}  // namespace cusp::inspect
