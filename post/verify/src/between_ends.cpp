// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Projection onto a CL move, and dense sampling.
#include "between_ends.hpp"

#include <cusp/base/units.hpp>
#include <cusp/post/reader/move_sampler.hpp>
#include <algorithm>
#include <cmath>

namespace cusp::post::verify {

namespace {

using reader::Vector3;

constexpr double sample_step_rad = base::radFromDeg(0.25);
constexpr double fewest_samples = 4.0;
constexpr double most_samples = 1440.0;

struct Projection {
    double fraction = 0.0;
    double distance = 0.0;
};

Projection onLine(const Vector3& point, const Vector3& from, const Vector3& to) {
    const Vector3 along = to - from;
    const double square = reader::dot(along, along);
    const double fraction = square > 0.0 ? std::clamp(reader::dot(point - from, along) / square, 0.0, 1.0) : 0.0;
    return {fraction, reader::norm(point - (from + fraction * along))};
}

Projection onGreatCircle(const Vector3& axis, const Vector3& from, const Vector3& to) {
    const double whole = reader::angleBetween(from, to);
    const Vector3 normal = reader::cross(from, to);
    const double sine = reader::norm(normal);
    if (sine < 1e-12) return {0.0, reader::angleBetween(axis, from)};
    const Vector3 sideways = reader::cross((1.0 / sine) * normal, from);
    const double angle = std::atan2(reader::dot(axis, sideways), reader::dot(axis, from));
    const double fraction = std::clamp(angle / whole, 0.0, 1.0);
    return {fraction, reader::angleBetween(axis, reader::onGreatCircle(from, to, fraction))};
}

}  // namespace

PoseError difference(const reader::ToolPose& a, const reader::ToolPose& b) {
    return {reader::norm(a.tip_mm - b.tip_mm), reader::angleBetween(a.axis, b.axis)};
}

std::optional<double> ExpectedMove::fractionOf(const reader::ToolPose& pose, const Tolerance& tolerance) const {
    Projection tip;
    if (arc != nullptr) {
        tip.fraction = arc->fractionOf(pose.tip_mm);
        tip.distance = reader::norm(pose.tip_mm - arc->at(tip.fraction));
    } else
        tip = onLine(pose.tip_mm, from.tip_mm, to.tip_mm);
    const Projection axis = onGreatCircle(pose.axis, from.axis, to.axis);
    if (tip.distance > tolerance.tip_mm || axis.distance > tolerance.axis_rad) return std::nullopt;
    return arc != nullptr || reader::norm(to.tip_mm - from.tip_mm) > tolerance.tip_mm ? tip.fraction : axis.fraction;
}

PoseError strayBetween(const reader::ExecutedMotion& motion, const reader::ForwardChain& chain,
                       const ExpectedMove& move, double from, double to) {
    PoseError worst;
    const double turn =
        std::max({reader::rotaryTravel(motion), reader::angleBetween(motion.start_pose->axis, motion.end_pose->axis),
                  motion.arc ? std::abs(motion.arc->sweep_rad) : 0.0,
                  move.arc != nullptr ? std::abs(to - from) * move.arc->sweep_rad : 0.0});
    if (turn == 0.0) return worst;  // a straight tip between two ends that were checked
    const double count = std::clamp(std::ceil(turn / sample_step_rad), fewest_samples, most_samples);
    for (double sample = 1.0; sample < count; sample += 1.0) {
        const double fraction = sample / count;
        const reader::ToolPose pose = reader::poseAt(motion, chain, fraction);
        const Vector3 wanted = reader::onGreatCircle(move.from.axis, move.to.axis, from + fraction * (to - from));
        const double off = move.arc != nullptr ? reader::norm(pose.tip_mm - move.arc->at(from + fraction * (to - from)))
                                               : onLine(pose.tip_mm, move.from.tip_mm, move.to.tip_mm).distance;
        worst.tip_mm = std::max(worst.tip_mm, off);
        worst.axis_rad = std::max(worst.axis_rad, reader::angleBetween(pose.axis, wanted));
    }
    return worst;
}

}  // namespace cusp::post::verify
