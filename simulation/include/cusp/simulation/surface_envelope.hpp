// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a path leaves on a surface: along the normal of each point, where the moving tool first meets the material.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/simulation/surface_grid.hpp>
#include <cusp/simulation/tool_move.hpp>

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace cusp::simulation {

struct EnvelopeOptions {
    double spacing_mm = 0.25;  ///< of the grid on the surface
    /// Only −band to band along the normal is looked at.
    double band_mm = 1.0;
};

/// What is left at one point of the grid.
struct EnvelopePoint {
    /// Signed along the outward normal: < 0 overcut, > 0 material left. The band's end where the tool goes deeper, or never
    /// comes near.
    double deviation_mm = 0.0;
    std::uint32_t move = no_move;  ///< index of the move that made it

    static constexpr std::uint32_t no_move = std::numeric_limits<std::uint32_t>::max();
    [[nodiscard]] bool reached() const { return move != no_move; }
};

struct SurfaceEnvelope {
    SurfaceGrid grid;
    std::vector<EnvelopePoint> points;  ///< as `grid.points`
    double band_mm = 0.0;
};

struct EnvelopeSummary {
    std::size_t points = 0;
    std::size_t reached = 0;                ///< by the tool, within the band
    std::size_t beyond = 0;                 ///< cut deeper than the band
    double overcut_max_mm = 0.0;            ///< > 0
    double undercut_max_mm = 0.0;           ///< > 0; of the points reached
    double mean_mm = 0.0;                   ///< by area, of the points reached
    double within_tolerance_percent = 0.0;  ///< of the reached area
    double reached_percent = 0.0;           ///< of the whole area
    std::size_t deepest = 0;                ///< index of the point of the largest overcut
    std::size_t highest = 0;                ///< of the largest undercut
};

/// The exact envelope of the tool against a surface along its normals: overcut and undercut together, all motion between the
/// cutter locations included (tip on the line, axis on the great circle). Rapid moves cut as feed moves do.
///
/// At each grid point the deviation is exact within 2e-6 mm (the search's tolerance and that of the series for the turning
/// axis), and the same at any number of threads. Between grid points nothing is promised but the continuity of the surface:
/// two points `spacing_mm` apart differ by about the slope of the scallop times the spacing.
///
/// Errors: `simulation.cutter`, `simulation.option`, `simulation.no-moves`.
[[nodiscard]] base::Result<SurfaceEnvelope>
surfaceEnvelope(const CutterPath& path, std::span<const geometry::SurfaceFace> faces, const EnvelopeOptions& options);

/// The same at points of the caller's choice; `spacing_mm` is not looked at.
[[nodiscard]] base::Result<SurfaceEnvelope> surfaceEnvelope(const CutterPath& path, SurfaceGrid grid,
                                                            const EnvelopeOptions& options);

/// `tolerance_mm`: points within ± of it count as within.
[[nodiscard]] EnvelopeSummary summaryOf(const SurfaceEnvelope& envelope, double tolerance_mm);

}  // namespace cusp::simulation
