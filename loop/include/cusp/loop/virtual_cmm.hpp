// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The virtual measuring machine: touches the part that a tool's motion leaves, with a ball, noise, form error and drift.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/closest_point.hpp>
#include <cusp/inspect/measured_points.hpp>
#include <cusp/inspect/section.hpp>
#include <cusp/simulation/tool_move.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cusp::loop {

using geometry::Vector3;

/// A point of the nominal surface to be touched.
struct CmmTarget {
    Vector3 position = Vector3::Zero();
    Vector3 normal = Vector3::UnitZ();  ///< unit, out of the material
    std::int32_t section = -1;          ///< index into the labels of the plan
};

struct CmmPlan {
    std::vector<CmmTarget> targets;
    std::vector<std::string> section_labels;
};

struct SectionSteps {
    double step_mm = 0.5;  ///< along the axis that, with the section's, is most across the surface's normals
    double edge_margin_mm =
        1.0;  ///< no target nearer to an edge of the nominal, or to one where its faces meet at an angle
};

/// Points of planned sections, every `step_mm` (Fountas 2017: X = −5, −30, −60, −90, 0.5 mm in Y).
/// Errors: `measure.step`, `measure.section` (a plane that meets nothing measurable).
[[nodiscard]] base::Result<CmmPlan> sectionTargets(const geometry::NominalShape& nominal,
                                                   const inspect::SectionPlan& sections, const SectionSteps& steps);

/// Targets from a table of points: each becomes its nearest point of the nominal. Error `measure.targets` when one is
/// farther than 0.01 mm from it or at an edge, with its line.
[[nodiscard]] base::Result<CmmPlan> listedTargets(const geometry::NominalShape& nominal,
                                                  const inspect::MeasuredPoints& listed);

struct CmmOptions {
    double probe_radius_mm = 1.0;       ///< a ball of 2 mm diameter
    double noise_mm = 0.0005;           ///< standard deviation of one touch, along the approach
    double form_mm = 0.0004;            ///< of ball and trigger together, full width: three lobes about the stylus (Z)
    double drift_mm = 0.0005;           ///< of the whole machine from the first point to the last, in some direction
    std::optional<Vector3> approach{};  ///< unit, away from the part; absent: along each target's normal
    std::uint64_t seed = 1;
};

struct CmmRun {
    inspect::MeasuredPoints points;  ///< centres of the ball, in the frame of the nominal
    std::vector<CmmTarget> targets;  ///< those that were touched, as `points`
    std::vector<double>
        true_deviation_mm;    ///< of the part at each target, along the normal: what no real machine tells
    std::size_t not_cut = 0;  ///< targets left out: the tool leaves more than a millimetre there
};

/// The part is what the tool's motion leaves (`simulation::surfaceEnvelope`), smooth over 0.15 mm or not: the ball rests on
/// the highest of what lies under it. It comes along the approach and stops at the first contact.
/// Errors: `measure.option`, `measure.approach` (from behind the surface), `measure.not-cut` (nothing to be touched),
/// `simulation.*`.
[[nodiscard]] base::Result<CmmRun> measurePart(const simulation::CutterPath& real_path, const CmmPlan& plan,
                                               const geometry::NominalShape& nominal, const CmmOptions& options);

/// True deviations of the part alone, at the targets; those not reached have none.
[[nodiscard]] base::Result<std::vector<std::optional<double>>> trueDeviations(const simulation::CutterPath& real_path,
                                                                              std::span<const CmmTarget> targets);

}  // namespace cusp::loop
