// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Following a move from both of its ends, and the first place where both ways keep the limits.
#include <cusp/kinematics/excursion.hpp>

#include "message_text.hpp"

#include <cusp/base/units.hpp>
#include <cusp/kinematics/angles.hpp>
#include <cusp/kinematics/axis_following.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace cusp::kinematics {
namespace {

// Places looked at along a move. Between two of them an axis may bend beyond a limit by the square of a part of this.
constexpr int looks = 720;
// A tool axis printed with six decimals can need a position a hair beyond a limit; that is the limit.
constexpr double rounding_rad = 2e-6;
// At the pole the first axis is free; what the move does there is seen just beside it.
constexpr double beside_pole = 1e-6;

bool withinLimits(const Machine& machine, const RotaryValues& rotary_rad) {
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i)
        if (machine.rotaryRange(i).excess(rotary_rad[i]) > rounding_rad) return false;
    return true;
}

RotaryValues onTheLimits(const Machine& machine, RotaryValues rotary_rad) {
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i)
        if (const AxisRange& range = machine.rotaryRange(i); !range.endless)
            rotary_rad[i] = std::clamp(rotary_rad[i], range.min, range.max);
    return rotary_rad;
}

/// The solutions at even fractions of a move, its ends included; an end where the branches are one is seen from beside it.
std::vector<AxisSolutions> solutionsAlong(const Machine& machine, const Vector3& from, const Vector3& to) {
    std::vector<AxisSolutions> along;
    along.reserve(looks + 1);
    for (int i = 0; i <= looks; ++i) {
        const double fraction = static_cast<double>(i) / looks;
        along.push_back(machine.solveAxis(onGreatCircle(from, to, fraction)));
        if (along.back().pole || along.back().count < 2)
            along.back() = machine.solveAxis(
                onGreatCircle(from, to, fraction < 0.5 ? fraction + beside_pole : fraction - beside_pole));
    }
    return along;
}

/// One end of a move and the way along it from there, on the branch that end is on.
class End {
public:
    End(const RotaryValues& rotary_rad, const AxisSolutions& at) : solved_(at) {
        const auto away = [&](std::size_t branch) {
            return std::abs(wrapAngle(rotary_rad[1] - at.branch[branch][1])) +
                   std::abs(wrapAngle(rotary_rad[0] - at.branch[branch][0]));
        };
        branch_ = at.count < 2 || away(0) <= away(1) ? 0 : 1;
        // Where the end is the pole, its first axis is free and stands as the move wants it.
        for (std::size_t i = 0; i < 2; ++i)
            start_rad_[i] = rotary_rad[i] + wrapAngle(at.branch[branch_][i] - rotary_rad[i]);
    }
    [[nodiscard]] RotaryValues positionAt(const AxisSolutions& there) const {
        const RotaryValues step = followStep(solved_, there, branch_);
        return {start_rad_[0] + step[0], start_rad_[1] + step[1]};
    }

private:
    RotaryValues start_rad_{};
    AxisSolutions solved_;
    std::size_t branch_ = 0;
};

double swingOf(const Machine& machine, const RotaryValues& from, const RotaryValues& to) {
    const Vector3 axis = machine.toolAxis(from);
    double worst = 0.0;
    for (int i = 1; i < looks; ++i) {
        const double part = static_cast<double>(i) / looks;
        const RotaryValues at{std::lerp(from[0], to[0], part), std::lerp(from[1], to[1], part)};
        worst = std::max(worst, geometry::angleBetween(axis, machine.toolAxis(at)));
    }
    return worst;
}

std::string turnsText(const Machine& machine, const RotaryValues& from, const RotaryValues& to) {
    constexpr double worth_saying_rad = 1e-3;
    std::string text;
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i) {
        if (std::abs(to[i] - from[i]) < worth_saying_rad) continue;
        text += fmt::format("{}{} axis from {}° to {}° ({}°)", text.empty() ? "" : ", ", machine.rotaryNames()[i],
                            degreeText(from[i]), degreeText(to[i]), degreeText(std::abs(to[i] - from[i])));
    }
    return text;
}

}  // namespace

base::Diagnostics ExcursionOptions::check() const {
    base::Diagnostics report;
    if (!(retract_mm >= 1.0 && retract_mm <= 1000.0))
        report.error("kinematics.option", fmt::format("retract_mm is {:g}; it must lie in 1 to 1000", retract_mm));
    return report;
}

ExcursionPlanner::ExcursionPlanner(const Machine& machine, ExcursionOptions options)
    : machine_(machine), options_(std::move(options)) {}

std::optional<Excursion> ExcursionPlanner::plan(const PathPoint& from, const PathPoint& to) {
    const Vector3 from_axis = machine_.toolAxis(from.rotary_rad);
    const Vector3 to_axis = machine_.toolAxis(to.rotary_rad);
    const std::vector<AxisSolutions> along = solutionsAlong(machine_, from_axis, to_axis);
    const End start(from.rotary_rad, along.front());
    const End end(to.rotary_rad, along.back());

    // From which place on the way to the end keeps the limits.
    int first = looks;
    while (first > 0 && withinLimits(machine_, end.positionAt(along[static_cast<std::size_t>(first - 1)]))) --first;
    bool start_holds = true;
    for (int i = 1; i <= first && start_holds; ++i)
        start_holds = withinLimits(machine_, start.positionAt(along[static_cast<std::size_t>(i)]));
    if (!start_holds) {
        report_.error(
            "kinematics.rewind",
            fmt::format("the limits force a rewind while cutting, at CL line {}, and leave no place for it: {}",
                        to.line, turnsText(machine_, from.rotary_rad, to.rotary_rad)),
            {.file = options_.file_name, .line = to.line, .column = 0, .key = {}});
        return std::nullopt;
    }
    const AxisSolutions& there = along[static_cast<std::size_t>(first)];
    Excursion excursion;
    excursion.fraction = static_cast<double>(first) / looks;
    excursion.leave_rad = first == 0 ? from.rotary_rad : onTheLimits(machine_, start.positionAt(there));
    excursion.return_rad = first == looks ? to.rotary_rad : onTheLimits(machine_, end.positionAt(there));
    excursion.tip_mm = from.tip_mm + excursion.fraction * (to.tip_mm - from.tip_mm);
    excursion.retracted_mm = excursion.tip_mm + options_.retract_mm * machine_.toolAxis(excursion.leave_rad);
    excursion.swing_rad = swingOf(machine_, excursion.leave_rad, excursion.return_rad);
    ++planned_;
    tell(excursion, to.line);
    return excursion;
}

void ExcursionPlanner::tell(const Excursion& excursion, std::uint32_t line) {
    report_.warning(
        "kinematics.excursion",
        fmt::format(
            "the rotary limits force the tool off the part on the way to CL line {}: it leaves along its axis by "
            "{} mm, turns {} with the axis swinging by up to {}°, and comes back to the same place",
            line, lengthText(options_.retract_mm), turnsText(machine_, excursion.leave_rad, excursion.return_rad),
            degreeText(excursion.swing_rad)),
        {.file = options_.file_name, .line = line, .column = 0, .key = {}});
}

}  // namespace cusp::kinematics
