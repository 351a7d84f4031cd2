// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The law suite: each law is a worst value, its bound, and the pose it happened at.
#include <cusp/kinematics/laws.hpp>

#include "branch_search.hpp"
#include "pose_sampler.hpp"

#include <cusp/kinematics/angles.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cusp::kinematics {
namespace {

using geometry::angleBetween;
using std::numbers::pi;

// One pose in so many is searched by brute force and swept for the range of the tool axis: both cost a thousand times
// the rest.
constexpr std::uint64_t search_every = 100;

class LawRun {
public:
    LawRun(const Machine& machine, std::uint64_t seed) : machine_(machine), sampler_(machine, seed) {}

    void check(std::uint64_t number) {
        pose_ = sampler_.next();
        tool_length_mm_ = sampler_.toolLength();
        location_ = machine_.forward(pose_, tool_length_mm_);
        checkRoundTrip();
        checkContains();
        checkWindings();
        checkPole();
        if (number % search_every == 0) {
            checkEveryBranch();
            checkMiss();
        }
    }

    [[nodiscard]] std::vector<Law> laws() const { return {tip_, axis_, contains_, branches_, limits_, pole_, miss_}; }

private:
    void put(Law& law, double value) {
        ++law.checked;
        if (law.checked > 1 && !(value > law.worst) && !std::isnan(value)) return;
        law.worst = std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
        law.worst_pose = pose_;
    }

    void checkRoundTrip() {
        const PoseSolutions solved = machine_.inverse(location_, tool_length_mm_);
        double tip_error = solved.values.empty() ? std::numeric_limits<double>::infinity() : 0.0;
        double axis_error = tip_error;
        for (const AxisValues& values : solved.values) {
            const toolpath::CutterLocation again = machine_.forward(values, tool_length_mm_);
            tip_error = std::max(tip_error, (again.tip_mm - location_.tip_mm).norm());
            axis_error = std::max(axis_error, angleBetween(again.axis, location_.axis));
        }
        put(tip_, tip_error);
        put(axis_, axis_error);
    }

    void checkContains() {
        const PoseSolutions solved = machine_.inverse(location_, tool_length_mm_);
        double nearest = std::numeric_limits<double>::infinity();
        for (const AxisValues& values : solved.values) {
            double distance = turned(1, values.rotary_rad[1] - pose_.rotary_rad[1]);
            if (!solved.pole) {
                // Beside the pole the first angle matters by the sine of the distance from it, and is known to no better.
                const double lever = std::sin(angleBetween(location_.axis, firstDirection()));
                const double first = turned(0, values.rotary_rad[0] - pose_.rotary_rad[0]);
                distance = std::max(distance, lever * first);
            }
            nearest = std::min(nearest, distance);
        }
        put(contains_, nearest);
    }

    void checkWindings() {
        double wrong = 0.0;
        for (std::size_t i = 0; i < machine_.rotaryCount(); ++i) {
            const AxisRange& range = machine_.rotaryRange(i);
            const std::vector<double> positions = machine_.windings(i, wrapAngle(pose_.rotary_rad[i]));
            for (const double position : positions)
                if (range.excess(position) > 0.0 || std::abs(wrapAngle(position - pose_.rotary_rad[i])) > 1e-11)
                    wrong += 1.0;
            double expected = range.endless ? 1.0 : 0.0;
            for (int turns = -12; turns <= 12 && !range.endless; ++turns)
                if (range.excess(wrapAngle(pose_.rotary_rad[i]) + turns * turn_rad) <= 1e-12) expected += 1.0;
            wrong += std::abs(expected - static_cast<double>(positions.size()));
        }
        put(limits_, wrong);
    }

    void checkPole() {
        if (machine_.rotaryCount() < 2) return;
        for (const double sign : {1.0, -1.0}) {
            const Vector3 target = sign * firstDirection();
            const AxisSolutions solved = machine_.solveAxis(target);
            if (solved.miss_rad > 0.0) continue;
            const RotaryValues any{sampler_.uniform(-pi, pi), solved.branch[0][1]};
            put(pole_,
                solved.pole ? angleBetween(machine_.toolAxis(any), target) : std::numeric_limits<double>::infinity());
        }
    }

    void checkEveryBranch() {
        const AxisSolutions solved = machine_.solveAxis(location_.axis);
        // Where two branches meet, a search cannot tell one from two.
        const bool meeting = solved.count == 2 && distanceModuloTurns(solved.branch[0], solved.branch[1]) < 1e-2;
        const double from_pole = std::sin(angleBetween(location_.axis, firstDirection()));
        if (solved.pole || meeting || (machine_.rotaryCount() > 0 && from_pole < 1e-2)) return;
        const std::vector<RotaryValues> searched = searchBranches(machine_, location_.axis);
        double wrong = std::abs(static_cast<double>(searched.size()) - static_cast<double>(solved.count));
        for (const RotaryValues& root : searched) {
            const auto known = [&](const RotaryValues& branch) { return distanceModuloTurns(branch, root) < 1e-5; };
            if (std::none_of(solved.branch.begin(), solved.branch.begin() + solved.count, known)) wrong += 1.0;
        }
        put(branches_, wrong);
    }

    void checkMiss() {
        const Vector3 target = sampler_.direction();
        constexpr int steps = 720;
        double nearest = pi;
        for (int i = 0; i <= steps; ++i) {
            // Turning the first axis reaches every axis at the same angle from it, so only that angle can miss.
            const Vector3 axis = machine_.toolAxis({0.0, machine_.rotaryCount() > 1 ? turn_rad * i / steps : 0.0});
            nearest = std::min(nearest, machine_.rotaryCount() == 0 ? angleBetween(axis, target)
                                                                    : std::abs(angleBetween(firstDirection(), axis) -
                                                                               angleBetween(firstDirection(), target)));
        }
        const double stated = machine_.solveAxis(target).miss_rad;
        // The sweep is as fine as its step; where the target is missed, the range ends at an extremum, known to step².
        put(miss_, stated > 0.0 ? std::abs(stated - nearest) : std::max(0.0, nearest - turn_rad / steps));
        const AxisSolutions solved = machine_.solveAxis(target);
        const double reached = angleBetween(machine_.toolAxis(solved.branch[0]), target);
        put(miss_, std::abs(reached - stated));
    }

    /// On an endless axis whole turns make no difference.
    [[nodiscard]] double turned(std::size_t i, double difference_rad) const {
        const bool endless = i < machine_.rotaryCount() && machine_.rotaryRange(i).endless;
        return std::abs(endless ? wrapAngle(difference_rad) : difference_rad);
    }

    [[nodiscard]] Vector3 firstDirection() const {
        if (machine_.rotaryCount() == 0) return machine_.toolAxis({});
        const auto& axis = machine_.definition().rotary.at(machine_.rotaryNames().front());
        return geometry::toVector(axis.direction);
    }

    const Machine& machine_;
    PoseSampler sampler_;
    AxisValues pose_;
    double tool_length_mm_ = 0.0;
    toolpath::CutterLocation location_;

    Law tip_ = makeLaw("tip after inverse and forward", "mm", 1e-9);
    Law axis_ = makeLaw("tool axis after inverse and forward", "rad", 1e-12);
    // Where two branches meet, the angle is the root of an angle: half the digits are left.
    Law contains_ = makeLaw("forward's axis positions among inverse's", "rad", 1e-6);
    Law branches_ = makeLaw("branches missing or too many", "", 0.0);
    Law limits_ = makeLaw("windings missing, too many or beyond limits", "", 0.0);
    Law pole_ = makeLaw("tool axis at the pole, first axis anywhere", "rad", 1e-12);
    Law miss_ = makeLaw("angle by which an axis out of reach is missed", "rad", 1e-4);

    static Law makeLaw(const char* name, const char* unit, double bound) {
        Law law;
        law.name = name;
        law.unit = unit;
        law.bound = bound;
        return law;
    }
};

}  // namespace

bool LawReport::passes() const {
    // A law that never applied (the pole of a three-axis machine) is not broken.
    return poses > 0 &&
           std::all_of(laws.begin(), laws.end(), [](const Law& law) { return law.checked == 0 || law.passes(); });
}

LawReport runLaws(const Machine& machine, std::uint64_t seed, std::uint64_t poses) {
    LawRun run(machine, seed);
    for (std::uint64_t number = 0; number < poses; ++number) run.check(number);
    return {.seed = seed, .poses = poses, .laws = run.laws()};
}

std::vector<AnchorReport> checkAnchors(const Machine& machine) {
    std::vector<AnchorReport> reports;
    for (const machine::Anchor& anchor : machine.definition().anchors) {
        RotaryValues rotary_rad{};
        for (std::size_t i = 0; i < machine.rotaryCount(); ++i)
            if (const auto found = anchor.rotary_rad.find(machine.rotaryNames()[i]); found != anchor.rotary_rad.end())
                rotary_rad[i] = found->second;
        reports.push_back(
            {.source = anchor.source,
             .error_rad = angleBetween(machine.toolAxis(rotary_rad), geometry::toVector(anchor.tool_axis)),
             .tolerance_rad = anchor.tolerance_rad});
    }
    return reports;
}

}  // namespace cusp::kinematics
