// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where limits force a rewind in a cut: how the tool leaves the part, unwinds, and takes the cut up again.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/kinematics/machine.hpp>
#include <cusp/kinematics/path_refiner.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace cusp::kinematics {

struct ExcursionOptions {
    /// How far the tip goes off the part, along the tool axis.
    double retract_mm = 50.0;
    /// Name of the CL file, for messages.
    std::string file_name;

    /// Errors (`kinematics.option`) name the option, its value and what it must be.
    [[nodiscard]] base::Diagnostics check() const;
};

/// The tool follows the path to `tip_mm`, leaves along its axis to `retracted_mm`, there turns the rotary axes from
/// `leave_rad` to `return_rad`, which give the same tool axis, comes back to `tip_mm`, and follows the path on.
struct Excursion {
    double fraction = 0.0;  ///< of the move that cannot be followed, 0 to 1
    Vector3 tip_mm = Vector3::Zero();
    Vector3 retracted_mm = Vector3::Zero();
    RotaryValues leave_rad{};
    RotaryValues return_rad{};
    /// How far the tool axis swings from its direction while the rotary axes turn linearly: what has to be free around it.
    double swing_rad = 0.0;
};

/// Plans the excursions of a path, one for each move that is a rewind (`PlannedAxes::rewind`). Along the great circle of
/// the move the rotary positions are followed from both ends; the first fraction is taken up to which the way from the
/// start keeps the limits, and from which on the way to the end does.
///
/// Says, with the CL line: `kinematics.excursion` (warning: what the tool does), `kinematics.rewind` (error: no fraction
/// will do, the limits leave less than the move needs).
class ExcursionPlanner {
public:
    /// `machine` must outlive the planner. Options must pass their check.
    ExcursionPlanner(const Machine& machine, ExcursionOptions options);

    [[nodiscard]] std::optional<Excursion> plan(const PathPoint& from, const PathPoint& to);

    [[nodiscard]] const base::Diagnostics& report() const { return report_; }
    [[nodiscard]] std::uint64_t planned() const { return planned_; }

private:
    void tell(const Excursion& excursion, std::uint32_t line);

    const Machine& machine_;
    ExcursionOptions options_;
    base::Diagnostics report_;
    std::uint64_t planned_ = 0;
};

}  // namespace cusp::kinematics
