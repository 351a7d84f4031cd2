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

/// What may go unseen between two samples: 0.05 µm and 0.0006°.
constexpr double unseen_mm = 5e-5;
constexpr double unseen_rad = 1e-5;
/// Reached by turns of many revolutions only; what then may go unseen is counted as seen.
constexpr int most_samples = 5000;

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
    const double length = arc != nullptr ? arc->length() : reader::norm(to.tip_mm - from.tip_mm);
    if (length <= tolerance.tip_mm) return axis.fraction;
    // The axis has to be the one of the place: as exactly as the place is known.
    const double slack = tolerance.axis_rad + reader::angleBetween(from.axis, to.axis) * tolerance.tip_mm / length;
    const Vector3 wanted = reader::onGreatCircle(from.axis, to.axis, tip.fraction);
    if (reader::angleBetween(pose.axis, wanted) > slack) return std::nullopt;
    return tip.fraction;
}

/// A distance from a straight way, or from the place the expected way has at the same fraction, is a norm of something that
/// bends by no more than the two ways together, so it exceeds that at the samples by no more than an eighth of the bend by
/// the square of their number.
PoseError strayBetween(const reader::ExecutedMotion& motion, const reader::ForwardChain& chain,
                       const ExpectedMove& move, double from, double to) {
    reader::Bend bend = reader::bendOf(motion, chain);
    const double part = std::abs(to - from);
    const double turn = part * reader::angleBetween(move.from.axis, move.to.axis);
    bend.axis_rad += turn * turn;
    if (move.arc != nullptr) bend.tip_mm += part * part * move.arc->bend();
    const double wanted = std::sqrt(std::max(bend.tip_mm / (8.0 * unseen_mm), bend.axis_rad / (8.0 * unseen_rad)));
    const int count = stepsFor(wanted, most_samples);
    PoseError worst;
    for (int sample = 0; sample <= count; ++sample) {
        const double fraction = static_cast<double>(sample) / count;
        const reader::ToolPose pose = reader::poseAt(motion, chain, fraction);
        const double along = from + fraction * (to - from);
        const double off = move.arc != nullptr ? reader::norm(pose.tip_mm - move.arc->at(along))
                                               : onLine(pose.tip_mm, move.from.tip_mm, move.to.tip_mm).distance;
        worst.tip_mm = std::max(worst.tip_mm, off);
        worst.axis_rad =
            std::max(worst.axis_rad,
                     reader::angleBetween(pose.axis, reader::onGreatCircle(move.from.axis, move.to.axis, along)));
    }
    if (count == most_samples) {
        worst.tip_mm += bend.tip_mm / (8.0 * count * count);
        worst.axis_rad += bend.axis_rad / (8.0 * count * count);
    }
    return worst;
}

}  // namespace cusp::post::verify
