// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Puts locations between two of the path where the control, turning the rotary axes linearly, would take the tool axis
// off the great circle between them.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/units.hpp>
#include <cusp/kinematics/axis_following.hpp>
#include <cusp/kinematics/machine.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::kinematics {

struct RefinerOptions {
    /// How far the tool axis may be from the great circle between two neighbouring locations, compared at equal fractions
    /// of the move. A toroidal or flat cutter of radius R touches R·tolerance beside where it should: 9 µm at 10 mm.
    double orientation_tolerance_rad = base::radFromDeg(0.05);
    /// A move is given at most this many locations more.
    std::size_t max_inserted = 1000;
    /// Name of the CL file, for messages.
    std::string file_name;

    /// Errors (`kinematics.option`) name the option, its value and what it must be.
    [[nodiscard]] base::Diagnostics check() const;
};

/// A location and the rotary positions that give its axis.
struct PathPoint {
    Vector3 tip_mm = Vector3::Zero();
    RotaryValues rotary_rad{};
    std::uint32_t line = 0;  ///< of the CL file
    bool cutting = true;     ///< whether the move *to* this point is at feed
    bool rewind = false;     ///< the move to it is one that nothing in between can mend
};

struct RefinerSummary {
    std::uint64_t inserted = 0;
    std::uint64_t refined_moves = 0;
    std::uint64_t not_within = 0;    ///< moves that stay beyond the tolerance
    double max_deviation_rad = 0.0;  ///< of the feed moves that needed a look, after refining
    std::uint32_t max_deviation_line = 0;
};

/// A streaming stage, one location in, one or more out: the tip of what is inserted lies on the line, its axis on the
/// great circle, its rotary positions where following the great circle brings them. Moves are halved until each part is
/// within the tolerance, so the same points come out of a path and of its reverse, and a refined path is left as it is.
/// A change of branch is made where the branches come nearest to each other: through the pole.
///
/// Problems, with the CL line: `kinematics.between-axis` (error: it would take more than `max_inserted`, or no insertion
/// helps, as on a machine with one rotary axis), `kinematics.axis-limit` (error: an axis meets its limit between two
/// locations that keep it).
class PathRefiner {
public:
    /// `machine` must outlive the refiner. Options must pass their check.
    PathRefiner(const Machine& machine, RefinerOptions options);

    /// What the machine goes to, in order: the inserted locations, then `next` itself. Valid until the next call.
    [[nodiscard]] const std::vector<PathPoint>& advance(const PathPoint& next);
    /// The next location begins a new path: nothing is inserted before it.
    void interrupt() { last_.reset(); }

    [[nodiscard]] const base::Diagnostics& report() const { return report_; }
    [[nodiscard]] const RefinerSummary& summary() const { return summary_; }

private:
    struct Node {
        double fraction = 0.0;
        RotaryValues rotary_rad{};
        AxisSolutions solved{};
        int branch = 0;  ///< any_branch where the two are one
    };
    static constexpr int any_branch = -1;

    void refine(const PathPoint& from, const PathPoint& to);
    void divide(const Node& from, const Node& to, int depth);
    [[nodiscard]] Node endNode(double fraction, const RotaryValues& rotary_rad, const Vector3& axis) const;
    [[nodiscard]] Node between(const Node& from, const Node& to) const;
    void reportLimits(const PathPoint& to);

    const Machine& machine_;
    RefinerOptions options_;
    std::optional<PathPoint> last_;
    std::vector<PathPoint> out_;
    // The move being refined.
    Vector3 from_axis_ = Vector3::UnitZ();
    Vector3 to_axis_ = Vector3::UnitZ();
    double meeting_fraction_ = 0.0;
    double worst_rad_ = 0.0;
    std::vector<Node> inserted_;
    base::Diagnostics report_;
    RefinerSummary summary_;
};

}  // namespace cusp::kinematics
