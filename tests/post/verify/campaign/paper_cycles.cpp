// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// RTP 0, RFP 1, SDIS 2, DP 3, DPR 4, then what each cycle has of its own.
#include "paper_cycles.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::post::verify::test {

namespace {

/// Above the ground of the last peck when chips are taken out, and the lift when they are broken.
constexpr double anticipation = 0.6;
constexpr double lift = 1.0;

double at(const NcBlock& call, std::size_t index) {
    return index < call.arguments.size() ? call.arguments[index].value_or(0.0) : 0.0;
}

HoleStep rapid(double height) { return {height, true, 0.0, 0.0, 0, 0.0}; }
HoleStep cut(double height, double feed) { return {height, false, feed, 0.0, 0, 0.0}; }
void dwell(std::vector<HoleStep>& steps, double seconds) {
    if (seconds > 0.0) steps.push_back({0.0, false, 0.0, 0.0, 0, seconds});
}

void pecks(std::vector<HoleStep>& steps, const NcBlock& call, double start, double feed) {
    const bool takes_out = at(call, 11) == 1.0;
    const double bottom = at(call, 3);
    double depth = at(call, 1);
    double factor = at(call, 10);
    while (depth > bottom) {
        const double ground = depth;
        depth = std::max(bottom, depth - at(call, 6));
        if (ground < at(call, 1)) steps.push_back(takes_out ? rapid(ground + anticipation) : cut(ground + lift, feed));
        steps.push_back(cut(depth, feed * factor));
        factor = 1.0;
        dwell(steps, at(call, 8));
        if (depth > bottom && takes_out) steps.push_back(rapid(start));
    }
}

void tap(std::vector<HoleStep>& steps, const NcBlock& call, double start) {
    const double pitch = at(call, 8);
    const double rpm = at(call, 10);
    const double feed = std::abs(pitch) * rpm;
    steps.push_back({at(call, 3), false, feed, rpm, pitch < 0.0 ? 4 : 3, 0.0});
    steps.push_back({start, false, feed, rpm, pitch < 0.0 ? 3 : 4, 0.0});
}

}  // namespace

int spindleAfterTap(const NcBlock& call) {
    const double function = at(call, 6);
    return function == 3.0 || function == 4.0 || function == 5.0 ? static_cast<int>(function) : 0;
}

std::vector<HoleStep> holeSteps(const NcBlock& call, double feed_mm_per_min) {
    const double start = at(call, 1) + std::abs(at(call, 2));
    std::vector<HoleStep> steps = {rapid(start)};
    if (call.cycle == "CYCLE83")
        pecks(steps, call, start, feed_mm_per_min);
    else if (call.cycle == "CYCLE84")
        tap(steps, call, start);
    else {
        steps.push_back(cut(at(call, 3), call.cycle == "CYCLE85" ? at(call, 6) : feed_mm_per_min));
        if (call.cycle != "CYCLE81") dwell(steps, at(call, 5));
        if (call.cycle == "CYCLE85") steps.push_back(cut(start, at(call, 7)));
    }
    steps.push_back(rapid(at(call, 0)));
    if (call.cycle == "CYCLE84") steps.back().spindle = spindleAfterTap(call);
    return steps;
}

}  // namespace cusp::post::verify::test
