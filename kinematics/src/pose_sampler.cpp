// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where the law suite looks: a wrong branch or a lost digit hides at poles, wraps and ends of travel.
#include "pose_sampler.hpp"

#include <cusp/kinematics/angles.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cusp::kinematics {

using std::numbers::pi;

double PoseSampler::toolLength() { return uniform(0.0, 300.0); }

Vector3 PoseSampler::direction() {
    const double z = uniform(-1.0, 1.0);
    const double angle = uniform(-pi, pi);
    const double across = std::sqrt(1.0 - z * z);
    return {across * std::cos(angle), across * std::sin(angle), z};
}

double PoseSampler::rotaryPosition(std::size_t i, std::uint64_t kind) {
    const AxisRange& range = machine_.rotaryRange(i);
    const double low = range.endless ? -pi : range.min;
    const double high = range.endless ? pi : range.max;
    if (kind == 1) return random_.chance(0.5) ? low : high;
    if (kind == 2) {
        const double quarter = std::round(uniform(low, high) / (pi / 2.0)) * (pi / 2.0);
        const double beside = random_.chance(0.5) ? 0.0 : std::pow(10.0, uniform(-15.0, -3.0));
        return std::clamp(random_.chance(0.5) ? quarter + beside : quarter - beside, low, high);
    }
    return uniform(low, high);
}

void PoseSampler::moveToPole(AxisValues& values) {
    const AxisSolutions pole = machine_.solveAxis(
        machine_.rotaryCount() > 0
            ? geometry::toVector(machine_.definition().rotary.at(machine_.rotaryNames().front()).direction)
            : machine_.toolAxis({}));
    if (!pole.pole || machine_.rotaryCount() < 2) return;
    const double beside = random_.chance(0.3) ? 0.0 : std::pow(10.0, uniform(-15.0, -1.0));
    const double angle = pole.branch[0][1] + (random_.chance(0.5) ? beside : -beside);
    const AxisRange& range = machine_.rotaryRange(1);
    if (range.excess(angle) == 0.0) values.rotary_rad[1] = angle;
}

AxisValues PoseSampler::next() {
    AxisValues values;
    for (std::size_t i = 0; i < 3; ++i)
        values.linear_mm[static_cast<Eigen::Index>(i)] =
            uniform(machine_.linearRange(i).min, machine_.linearRange(i).max);
    const std::uint64_t kind = count_++ % 4;
    for (std::size_t i = 0; i < machine_.rotaryCount(); ++i) values.rotary_rad[i] = rotaryPosition(i, kind);
    if (kind == 3) moveToPole(values);
    return values;
}

}  // namespace cusp::kinematics
