// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Halving by a proven bound.
#include "tip_lineariser.hpp"

#include <cusp/kinematics/angles.hpp>
#include <cusp/kinematics/axis_following.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::post {

using geometry::Vector3;
using kinematics::RotaryValues;

namespace {

// Halving so often leaves nothing of any move.
constexpr int deepest = 30;
// Two ways of the same turn differ by rounding.
constexpr double same_turn_rad = 1e-6;

RotaryValues mean(const RotaryValues& a, const RotaryValues& b) { return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}; }

}  // namespace

TipLineariser::TipLineariser(const kinematics::Machine& machine, const MachineAxes& axes, LineariserOptions options)
    : machine_(machine), axes_(axes), options_(options) {}

bool TipLineariser::place(Node& node) const {
    node.stop.axis = machine_.toolAxis(node.rotary_rad);
    node.stop.at.rotary_rad = axes_.printed(node.rotary_rad);
    const auto programmed_from_workpiece = axes_.programmedFromWorkpiece(node.stop.at.rotary_rad);
    if (!programmed_from_workpiece) return false;
    node.stop.at.point_mm = axes_.printed(*programmed_from_workpiece * node.tip_mm);
    node.stop.tip_mm = programmed_from_workpiece->inverse() * node.stop.at.point_mm;
    return true;
}

bool TipLineariser::startAt(const Pose& pose) {
    from_ = {};
    from_.tip_mm = pose.tip_mm;
    from_.rotary_rad = pose.rotary_rad;
    return place(from_);
}

const std::vector<MachineStop>& TipLineariser::advance(const Pose& to, bool refined) {
    out_.clear();
    worst_mm_ = 0.0;
    Node end{.fraction = 1.0, .tip_mm = to.tip_mm, .rotary_rad = to.rotary_rad, .stop = {}};
    failed_ = !place(end);
    if (failed_) return out_;
    from_.fraction = 0.0;
    from_axis_ = from_.stop.axis;
    to_axis_ = end.stop.axis;
    refined_ = refined;
    follows_ = refined || follows(from_.rotary_rad, to.rotary_rad);
    divide(from_, end, 0);
    if (failed_) {
        out_.clear();
        return out_;
    }
    inserted_ += out_.size();
    out_.push_back(end.stop);
    from_ = end;
    return out_;
}

/// Whether the rotary axes turn as they do along the great circle, or the tool axis has a pole at an end, where the first
/// axis is free.
bool TipLineariser::follows(const RotaryValues& from, const RotaryValues& to) const {
    if (machine_.rotaryCount() < 2) return false;
    const auto first = machine_.solveAxis(machine_.toolAxis(from));
    const auto last = machine_.solveAxis(machine_.toolAxis(to));
    if (first.pole || last.pole) return true;
    for (std::size_t branch = 0; branch < 2; ++branch) {
        const RotaryValues step = kinematics::followStep(first, last, branch);
        const bool begins = std::abs(kinematics::wrapAngle(from[1] - first.branch[branch][1])) < same_turn_rad;
        if (begins && std::abs(to[0] - from[0] - step[0]) < same_turn_rad &&
            std::abs(to[1] - from[1] - step[1]) < same_turn_rad)
            return true;
    }
    return false;
}

/// Half way along the great circle, on the side where the ends are. Where the rotary axes do not follow one, half way
/// between them; so too at a pole, where a turn of the first axis hardly moves the tool axis and the circle gives it no
/// way to turn: only between the positions of its ends can that turn be divided.
RotaryValues TipLineariser::between(const Node& from, const Node& to) const {
    const RotaryValues middle = mean(from.rotary_rad, to.rotary_rad);
    if (!follows_) return middle;
    const double fraction = 0.5 * (from.fraction + to.fraction);
    const auto solved = machine_.solveAxis(kinematics::onGreatCircle(from_axis_, to_axis_, fraction));
    RotaryValues nearest = middle;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t branch = 0; branch < solved.count; ++branch) {
        RotaryValues candidate{};
        for (std::size_t i = 0; i < candidate.size(); ++i)
            candidate[i] = middle[i] + kinematics::wrapAngle(solved.branch[branch][i] - middle[i]);
        if (solved.pole) candidate[0] = middle[0];
        // The second axis tells the branches apart; the first may be far from the middle of a turn at a pole.
        constexpr double first_counts = 1e-3;
        const double away = first_counts * std::abs(candidate[0] - middle[0]) + std::abs(candidate[1] - middle[1]);
        if (away >= least) continue;
        least = away;
        nearest = candidate;
    }
    constexpr double uneven = 0.25;
    const double turn =
        std::abs(to.rotary_rad[0] - from.rotary_rad[0]) + std::abs(to.rotary_rad[1] - from.rotary_rad[1]);
    const double off = std::abs(nearest[0] - middle[0]) + std::abs(nearest[1] - middle[1]);
    if (off > uneven * turn && linearTurnKeepsAxis(from, to)) return middle;
    return nearest;
}

bool TipLineariser::linearTurnKeepsAxis(const Node& from, const Node& to) const {
    return kinematics::linearTurnDeviation(machine_, from.rotary_rad, to.rotary_rad) <=
           options_.orientation_tolerance_rad;
}

void TipLineariser::divide(const Node& from, const Node& to, int depth) {
    if (failed_) return;
    const double bound = axes_.chordError(from.stop.at, to.stop.at) + axes_.printError();
    const bool axis_kept = refined_ || !follows_ || linearTurnKeepsAxis(from, to);
    if ((bound <= options_.tolerance_mm && axis_kept) || depth == deepest || out_.size() >= options_.max_inserted) {
        worst_mm_ = std::max(worst_mm_, bound);
        return;
    }
    Node middle{.fraction = 0.5 * (from.fraction + to.fraction),
                .tip_mm = 0.5 * (from.tip_mm + to.tip_mm),
                .rotary_rad = between(from, to),
                .stop = {}};
    failed_ = !place(middle);
    divide(from, middle, depth + 1);
    out_.push_back(middle.stop);
    divide(middle, to, depth + 1);
}

}  // namespace cusp::post
