// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A job made ready: part, tool, path and machine, and what a tilted path is worth on them.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/closest_point.hpp>
#include <cusp/kinematics/machine.hpp>
#include <cusp/optimizer/tilt/axis_motion.hpp>
#include <cusp/optimizer/tilt/tilt_job.hpp>
#include <cusp/optimizer/tilt/tilted_path.hpp>
#include <cusp/simulation/collision_field.hpp>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cusp::tilt {

namespace detail {
class ClearanceProbe;
}

/// Opens a part file that is no mesh (STEP, IGES, surface file).
using ShapeLoader = std::function<base::Result<std::unique_ptr<geometry::NominalShape>>(const std::string& path,
                                                                                        base::Diagnostics& report)>;

/// What the path costs in force and speed at the contact of the ball; see `contactReport`.
struct ContactReport {
    double speed_min_m_per_min = 0.0;   ///< cutting speed at the contact
    double speed_mean_m_per_min = 0.0;  ///< by length of cut
    double speed_max_m_per_min = 0.0;
    double force_proxy_mean = 0.0;  ///< relative to a contact on the ball's equator; by length of cut
    double force_proxy_max = 0.0;
    std::size_t contacts = 0;
};

/// The three fitnesses of Weinert & Stautner 2004, 3.2.1, in their order; all are minimised.
struct TiltFitness {
    double range_excess = 0.0;
    double collision_volume_mm3 = 0.0;
    double harmony_s = 0.0;

    /// Free of both kinds of collision.
    [[nodiscard]] bool isFree() const { return range_excess <= 0.0 && collision_volume_mm3 <= 0.0; }
};

/// May be used from several threads at once.
class TiltCase {
public:
    /// `folder`: of the job file, for the files it names. `loader` may be empty: then only meshes are read.
    /// Errors: those of the part's and path's readers; `tilt.open-mesh`, `tilt.part-format`, `tilt.no-path`,
    /// `tilt.not-a-ball`, `simulation.*` (memory, resolution).
    [[nodiscard]] static base::Result<std::unique_ptr<TiltCase>>
    make(const TiltJob& job, const kinematics::Machine& machine, const std::string& folder, base::Diagnostics& report,
         const ShapeLoader& loader = {});
    TiltCase(const TiltCase&) = delete;
    TiltCase& operator=(const TiltCase&) = delete;
    ~TiltCase();

    [[nodiscard]] const TiltJob& job() const { return job_; }
    [[nodiscard]] const StartPath& path() const { return path_; }
    [[nodiscard]] const StartPath& coarsePath() const { return coarse_path_; }
    [[nodiscard]] const MachinePlace& place() const { return place_; }
    [[nodiscard]] const geometry::NominalShape& shape() const { return *shape_; }

    /// A look at few locations, then, where that finds nothing, at more, then at all of them (unless there are more
    /// than 20 000): the first that finds something counts. Where the machine cannot
    /// follow, collisions are not looked for, and count as infinite. Collisions are those with the finished part; their volume
    /// is the mean along the path of what shank and holder overlap at each place.
    [[nodiscard]] TiltFitness judge(const TiltPlan& plan) const;

    /// The simulation's answer: all moves of the path, and all the motion between its places, against the part at
    /// `resolution_mm`, with the holder beginning at `stick_out_mm`.
    [[nodiscard]] base::Result<simulation::CollisionVolume>
    collisions(const std::vector<toolpath::CutterLocation>& poses, double resolution_mm, double stick_out_mm) const;
    /// The same of moves from elsewhere, in the frame of the part: those of a posted program.
    [[nodiscard]] base::Result<simulation::CollisionVolume> collisions(std::span<const simulation::ToolMove> moves,
                                                                       double resolution_mm, double stick_out_mm) const;
    /// The shortest stick-out, in steps of `step_mm` below the tool's own, with which the path stays free; empty where it is
    /// not free with the tool's own.
    [[nodiscard]] std::optional<double> shortestStickOut(const std::vector<toolpath::CutterLocation>& poses,
                                                         double step_mm) const;

private:
    TiltCase(TiltJob job, const kinematics::Machine& machine);
    [[nodiscard]] base::Result<simulation::CollisionField> fieldOf(double resolution_mm) const;

    TiltJob job_;
    MachinePlace place_;
    std::unique_ptr<geometry::NominalShape> shape_;
    StartPath path_;
    StartPath coarse_path_;
    StartPath sparse_path_;
    std::unique_ptr<const detail::ClearanceProbe> probe_;
};

/// At each place of a cut where the ball touches the part: with the angle κ between the tool axis and the surface normal, the
/// contact runs at 2π·n·R·sin κ, and what is left of force for a given depth and feed goes as (sin κ)^−0.25 (Kienzle's law
/// with m_c = 0.25: the chip thins with sin κ). At κ = 0 the tip rubs and does not cut; sin κ is taken as 0.05 at least.
[[nodiscard]] ContactReport contactReport(const geometry::NominalShape& shape, const StartPath& path,
                                          const std::vector<toolpath::CutterLocation>& poses);

}  // namespace cusp::tilt
