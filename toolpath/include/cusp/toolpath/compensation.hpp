// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A measured deviation mirrored into a path: where the part came out too high, the tool goes lower by as much.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/closest_point.hpp>
#include <cusp/geometry/cutter.hpp>
#include <cusp/geometry/deviation_field.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>

namespace cusp::toolpath {

/// What of the field goes into the path.
enum class CompensatedPart : std::uint8_t {
    PoseAndForm,  ///< the deviation in the fixed datums
    Form          ///< the pose is left to whoever sets the work offset
};

struct CompensationOptions {
    CompensatedPart part = CompensatedPart::PoseAndForm;
    double gain = 1.0;      ///< share of the deviation that is taken back, above 0 and at most 1.5
    double clamp_mm = 0.1;  ///< no location moves farther along the normal
    /// A location whose cutter stays this high above the nominal is off the part and stays; between half of it and all of it
    /// the shift fades out, so that a plunge has no step. Beside the nominal the same holds of this and the cutter's diameter:
    /// a tool that runs out over an edge still cuts there.
    double reach_mm = 2.0;
};

struct CompensationSummary {
    std::size_t locations = 0;     ///< GOTO of the path
    std::size_t moved = 0;         ///< that cut the surface and were shifted
    std::size_t clamped = 0;       ///< held at the clamp
    std::size_t extrapolated = 0;  ///< shifted where nothing was measured: the field keeps its value at its edge
    double max_shift_mm = 0.0;     ///< along the normal
    double rms_shift_mm = 0.0;     ///< of those moved
};

struct CompensatedPath {
    ToolPath path;
    CompensationSummary summary;
};

/// Where a cutter at `location` comes nearest to the nominal, by its corner (a ball, a torus, the edge of a flat mill): the
/// point of the cutter whose outward normal is against the nominal's.
struct CutterContact {
    geometry::Footpoint foot;  ///< on the nominal
    double gap_mm = 0.0;       ///< between cutter and nominal along the normal; < 0: the cutter is in the material
    double aside_mm = 0.0;     ///< beyond the nominal's edge, across the normal there; 0 above its faces
};
[[nodiscard]] CutterContact cutterContact(const CutterLocation& location, const geometry::Cutter& cutter,
                                          const geometry::NominalShape& nominal);

/// What the options take back at a place of the nominal: −gain · deviation, within the clamp. In mm along the normal.
[[nodiscard]] double compensationAt(const geometry::Vector3& position, const geometry::Vector3& normal,
                                    const geometry::DeviationField& field, const CompensationOptions& options);

/// Shifts every location that cuts the nominal by `compensationAt` its contact, along the normal there, and across it by what
/// keeps the contact in its place where the shift has a slope (0.2 mm at most; none for a bottom flat on the surface). Tool
/// axes, feeds and everything else stay. `nominal` and field are in the frame of the part.
///
/// Errors: `compensate.option`; `compensate.no-cutter`, `compensate.arc` and `compensate.spline` (motion at the part that is
/// no point), with the line; `compensate.nothing` (no location cuts the nominal).
[[nodiscard]] base::Result<CompensatedPath> compensate(const ToolPath& path, const geometry::NominalShape& nominal,
                                                       const geometry::DeviationField& field,
                                                       const CompensationOptions& options);

}  // namespace cusp::toolpath
