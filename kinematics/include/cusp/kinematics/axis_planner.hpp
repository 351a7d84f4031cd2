// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Chooses branch and winding of the rotary axes over a whole path, as a stream in bounded memory.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/units.hpp>
#include <cusp/kinematics/angles.hpp>
#include <cusp/kinematics/machine.hpp>

#include <array>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::kinematics {

struct PlannerOptions {
    /// Points looked at together. The choice is the best over the whole path while the path fits, and never looks ahead by
    /// less than half of this. 32 768 points are minutes of cutting and about 8 MB.
    std::size_t window_points = 32768;
    /// A tool axis out of reach, or a position beyond a limit, by up to this is taken as the nearest that is allowed. CL
    /// files print six decimals: 0.87e-6.
    double axis_tolerance_rad = 1e-6;
    /// Within this of the first rotary axis the direction across it is the rounding of a CL file's seventh decimal
    /// (0.7e-7), so the axis counts as the pole and its angle as free.
    double pole_tolerance_rad = 1e-7;
    /// While cutting, a step that cannot follow the great circle between its two axes within this is a rewind. Branches
    /// may be changed where they come as near to each other as that.
    double orientation_tolerance_rad = base::radFromDeg(0.05);
    /// Not 0: where the way passes the pole within this, the tool axis may leave it by as much to change the branch,
    /// when the limits would else force a rewind.
    double pole_cone_rad = 0.0;
    /// What that costs besides its travel.
    double pole_cone_penalty_s = 60.0;
    /// What a rewind costs besides its travel: as much as ten minutes of travel, so that a path avoids it while it can,
    /// and puts it into a rapid move where it must.
    double rewind_penalty_s = 600.0;
    /// Whoever takes the positions moves the tool off the part for a rewind, and tells it: nothing is said here.
    bool rewinds_are_handled = false;
    /// Where the axes stand before the first point; travel from there counts. Without it the start is free.
    std::optional<RotaryValues> start_rad;
    /// Name of the CL file, for messages.
    std::string file_name;

    /// Errors (`kinematics.option`) name the option, its value and what it must be.
    [[nodiscard]] base::Diagnostics check() const;
};

/// One point of the path: a unit tool axis in the workpiece frame.
struct AxisPoint {
    Vector3 axis = Vector3::UnitZ();
    std::uint32_t line = 0;  ///< of the CL file
    bool cutting = true;     ///< whether the move *to* this point is at feed
};

/// The rotary positions chosen for a point.
struct PlannedAxes {
    RotaryValues rotary_rad{};
    std::uint32_t line = 0;
    bool pole = false;          ///< the first rotary axis was free and keeps still
    bool within_limits = true;  ///< false: no solution lies within the limits, and this is the nearest
    bool reached = true;        ///< false: no rotary position gives the tool axis, and this is the nearest
    /// The move to this point cannot follow the great circle while cutting: an axis has to unwind or the branch to change.
    bool rewind = false;
    bool in_pole_cone = false;  ///< the move to it leaves the great circle by up to the pole cone
};

struct PlannerSummary {
    std::uint64_t points = 0;
    std::uint64_t pole_points = 0;
    std::uint64_t limit_violations = 0;  ///< points, not axes
    std::uint64_t unreached = 0;
    std::uint64_t rewinds = 0;
    std::uint64_t pole_cone_moves = 0;
    RotaryValues travel_rad{};  ///< in chain order
};

/// Viterbi's algorithm over the candidates of each point: every branch in every winding within the limits. A step costs
/// the time its slowest rotary axis needs at full speed, max |Δq|/v; among equals the smaller sum of travel wins, then
/// the start nearer to zero. While cutting, a step must be one that a `PathRefiner` can hold within the orientation
/// tolerance: on one branch by the way the great circle takes, or through a place where the branches meet, with no axis
/// turning by more than half a turn. Any other is a rewind. At the pole the first axis keeps the angle of the point before; a path that begins at the
/// pole begins with the angle of its first point off it. Costs are whole nanoseconds and nanoradians, so that ties are
/// ties on every machine.
///
/// Problems, with the CL line: `kinematics.axis-limit` (error, one for each point without a candidate within the
/// limits), `kinematics.axis-unreachable` (error), `kinematics.rewind` (error, unless `rewinds_are_handled`).
class AxisPlanner {
public:
    /// `machine` must outlive the planner. Options must pass their check.
    AxisPlanner(const Machine& machine, PlannerOptions options);

    void push(const AxisPoint& point);
    /// No more points will come: everything still held becomes available.
    void finish();
    /// The next point in order, once it is decided: at most `window_points` after it was pushed.
    [[nodiscard]] bool pop(PlannedAxes& out);

    [[nodiscard]] const base::Diagnostics& report() const { return report_; }
    /// Covers the points handed out or ready to be.
    [[nodiscard]] const PlannerSummary& summary() const { return summary_; }

private:
    struct Cost {
        std::int64_t time_ns = 0;
        std::int64_t travel_nrad = 0;
        std::int64_t start_nrad = 0;
        auto operator<=>(const Cost&) const = default;
    };
    /// What is kept of a state until its point is handed out.
    struct State {
        RotaryValues rotary_rad{};
        std::uint32_t before = 0;  ///< index within the layer before
        std::uint8_t branch = 0;
    };
    /// What the next point is compared with: the last layer alone needs it.
    struct Frontier {
        State state;
        Cost cost{};
        bool alive = true;  ///< descends from what was already handed out
    };
    struct Candidate {
        RotaryValues rotary_rad{};
        std::uint8_t branch = 0;
    };
    struct Layer {
        double miss_rad = 0.0;
        /// From the layer before: what each branch turns by along the great circle, and whether that circle passes where
        /// the branches meet, so that both are one.
        std::array<RotaryValues, 2> follow{};
        bool branches_meet = true;
        bool cone_meets = false;
        std::size_t first = 0;
        std::size_t count = 0;
        std::uint32_t line = 0;
        bool cutting = true;
        bool pole = false;
        bool within_limits = true;
    };

    void gatherCandidates(const AxisSolutions& solved);
    void gatherNearest(const AxisSolutions& solved);
    void gatherAtPole(const AxisSolutions& solved);
    void addWindings(std::size_t axis, double angle_rad);
    void addState(const Layer& layer, const Candidate& candidate);
    /// The cheapest way from the layer before to a candidate.
    [[nodiscard]] Frontier reached(const Layer& layer, const Candidate& candidate, std::size_t likely) const;
    void consider(const Layer& layer, const Candidate& candidate, std::size_t from, Frontier& best) const;
    void follow(Layer& layer, const AxisSolutions& solved, const Vector3& axis);
    [[nodiscard]] double turnTime(const State& from, const Candidate& to) const;
    [[nodiscard]] Cost stepCost(const Layer& layer, const State& from, const Candidate& to) const;
    enum class Way : std::uint8_t { Followed, ThroughCone, Rewind };
    [[nodiscard]] Way wayOf(const Layer& layer, const State& from, const Candidate& to) const;
    [[nodiscard]] double turned(std::size_t axis, double from, double to) const {
        const double difference = to - from;
        return std::abs(endless_[axis] ? wrapAngle(difference) : difference);
    }

    void commit(std::size_t layer_count);
    [[nodiscard]] std::vector<std::uint32_t> traceBack() const;
    [[nodiscard]] std::size_t settleFreeAngle(std::vector<std::uint32_t>& chosen, std::size_t layer_count);
    void handOut(const Layer& layer, const State& chosen);
    void reportProblems(const Layer& layer, const RotaryValues& before, const PlannedAxes& out);
    void settleFrontier();
    void dropFront(std::size_t layer_count, std::uint32_t chosen);

    const Machine& machine_;
    PlannerOptions options_;
    RotaryValues seconds_per_rad_{};
    std::array<bool, 2> endless_{};
    std::vector<Layer> layers_;
    std::vector<State> states_;
    std::vector<Frontier> frontier_;  ///< the states of the last layer
    std::vector<Frontier> reached_;   ///< of the layer at hand, swapped with it
    std::vector<Candidate> candidates_;
    std::array<std::vector<double>, 2> positions_;
    std::optional<RotaryValues> last_;  ///< handed out last, with endless axes unwrapped
    std::uint8_t last_branch_ = 0;
    // The point pushed before.
    std::optional<AxisSolutions> solved_before_;
    Vector3 axis_before_ = Vector3::UnitZ();
    double gap_before_rad_ = 0.0;
    std::vector<PlannedAxes> ready_;
    std::size_t next_ready_ = 0;
    base::Diagnostics report_;
    PlannerSummary summary_;
};

}  // namespace cusp::kinematics
