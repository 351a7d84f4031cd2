// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Linear positions along a path, halved where a bound on their curvature leaves a question open; derived in README.md.
#include <cusp/kinematics/linear_travel.hpp>

#include "message_text.hpp"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cusp::kinematics {
namespace {

// Halving 40 times leaves a part of 1e-12; only a move through a singular pose comes so far.
constexpr int deepest = 40;
// A position this far beyond a limit is the limit in any message.
constexpr double rounding_mm = 0.0005;
constexpr double unbounded = std::numeric_limits<double>::infinity();

/// The part of `v` across the unit vector `axis`: a turn about it moves nothing else.
double across(const Vector3& v, const Vector3& axis) { return (v - axis.dot(v) * axis).norm(); }

}  // namespace

base::Diagnostics TravelOptions::check() const {
    base::Diagnostics report;
    if (!(bound_mm >= 1e-4 && bound_mm <= 1.0))
        report.error("kinematics.option", fmt::format("bound_mm is {:g}; it must lie in 0.0001 to 1", bound_mm));
    return report;
}

LinearTravel::LinearTravel(const Machine& machine, TravelOptions options)
    : machine_(machine), options_(std::move(options)) {
    const machine::MachineDefinition& definition = machine_.definition();
    std::size_t rotary_before = 0;
    std::size_t linear_before = 0;
    Matrix3 directions = Matrix3::Identity();
    for (const std::string& name : definition.axisNames()) {
        if (const auto linear = definition.linear.find(name); linear != definition.linear.end()) {
            for (std::size_t i = 0; i < rotary_before; ++i) leads_[i] = true;
            directions.col(static_cast<Eigen::Index>(linear_before++)) = geometry::toVector(linear->second.direction);
        } else {
            mixed_ = mixed_ || (linear_before > 0 && linear_before < 3);
            ++rotary_before;
        }
    }
    const auto sizes = directions.jacobiSvd().singularValues();
    directions_norm_ = sizes[0];
    inverse_norm_ = 1.0 / sizes[2];
}

void LinearTravel::setOrigin(const Vector3& origin_mm) { origin_mm_ = origin_mm; }

void LinearTravel::setToolLength(double length_mm) {
    tool_length_mm_ = length_mm;
    prepareLevers();
}

/// How far what a rotary axis turns is from it: the point of the second axis nearest to the tip from the first, the tip
/// from the second.
void LinearTravel::prepareLevers() {
    const machine::MachineDefinition& definition = machine_.definition();
    const Vector3 end = geometry::toVector(definition.spindle.gauge_point_mm) -
                        *tool_length_mm_ * geometry::toVector(definition.spindle.axis);
    levers_mm_ = {};
    const std::size_t count = machine_.rotaryCount();
    if (count == 0) return;
    const auto pointOf = [&](std::size_t i) {
        return geometry::toVector(definition.rotary.at(machine_.rotaryNames()[i]).point_mm);
    };
    const Vector3& last = machine_.rotaryDirection(count - 1);
    const Vector3 any = pointOf(count - 1);
    const Vector3 nearest = any + last.dot(end - any) * last;
    levers_mm_[count - 1] = (end - nearest).norm();
    if (count == 2) levers_mm_[0] = across(nearest - pointOf(0), machine_.rotaryDirection(0));
}

void LinearTravel::standAt(const AxisValues& values) { at_ = values; }

void LinearTravel::turnTo(const RotaryValues& rotary_rad) {
    if (at_) at_->rotary_rad = rotary_rad;
}

std::optional<Vector3> LinearTravel::tip() const {
    if (!origin_mm_ || !tool_length_mm_ || !at_) return std::nullopt;
    return machine_.forward(*at_, *tool_length_mm_).tip_mm - *origin_mm_;
}

void LinearTravel::moveTo(const Vector3& tip_mm, const RotaryValues& rotary_rad, std::uint32_t cl_line) {
    if (!origin_mm_ || !tool_length_mm_) return;
    ++summary_.moves;
    const auto to = solve(tip_mm, rotary_rad, cl_line);
    if (!to) return at_.reset();
    if (const auto from_mm = tip()) look({*from_mm, *at_}, *to, cl_line, 0);
    note(to->values, cl_line, true);
    at_ = to->values;
}

void LinearTravel::look(const Pose& from, const Pose& to, std::uint32_t cl_line, int depth) {
    const double bulge_mm = bulge(from.values, to.values, (to.tip_mm - from.tip_mm).norm());
    if (bulge_mm <= options_.bound_mm || depth == deepest || !isOpen(from.values, to.values, bulge_mm, cl_line)) return;
    const RotaryValues half{0.5 * (from.values.rotary_rad[0] + to.values.rotary_rad[0]),
                            0.5 * (from.values.rotary_rad[1] + to.values.rotary_rad[1])};
    const auto middle = solve(0.5 * (from.tip_mm + to.tip_mm), half, cl_line);
    if (!middle) return;
    note(middle->values, cl_line, false);
    look(from, *middle, cl_line, depth + 1);
    look(*middle, to, cl_line, depth + 1);
}

/// Whether the part between could go beyond a limit, or beyond what is known already by more than the bound. How far beyond
/// a limit something lies needs no such care: a thousandth of it does, or a path far outside would be looked at for ever.
bool LinearTravel::isOpen(const AxisValues& from, const AxisValues& to, double bulge_mm, std::uint32_t cl_line) const {
    constexpr double share_of_excess = 0.001;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto axis = static_cast<Eigen::Index>(i);
        const double low = std::min(from.linear_mm[axis], to.linear_mm[axis]) - bulge_mm;
        const double high = std::max(from.linear_mm[axis], to.linear_mm[axis]) + bulge_mm;
        const AxisRange& range = machine_.linearRange(i);
        const auto& [lowest, highest] = summary_.range_mm[i];
        const double low_slack = options_.bound_mm + share_of_excess * std::max(0.0, range.min - lowest);
        const double high_slack = options_.bound_mm + share_of_excess * std::max(0.0, highest - range.max);
        if (low < lowest - low_slack || high > highest + high_slack) return true;
        const Held& held = held_[i];
        const double known_mm =
            held.line == cl_line ? std::max(held.excess_mm, held.start_excess_mm) : held.end_excess_mm;
        const double excess_mm = std::max(range.excess(low), range.excess(high));
        if (excess_mm > (known_mm > 0.0 ? (1.0 + share_of_excess) * known_mm + options_.bound_mm : 0.0)) return true;
    }
    return false;
}

/// With q the linear positions, M(r) the directions of the linear axes as the rotary axes have turned them, and w(r) the
/// rest of the way from the tip, M q = w. Differentiating twice along the move bounds q''; a way of curvature q'' leaves
/// its chord by q''/8 at most.
double LinearTravel::bulge(const AxisValues& from, const AxisValues& to, double tip_way_mm) const {
    const double first = std::abs(to.rotary_rad[0] - from.rotary_rad[0]);
    const double second = std::abs(to.rotary_rad[1] - from.rotary_rad[1]);
    const double both = first + second;
    if (both == 0.0) return 0.0;
    const double leading = (leads_[0] ? first : 0.0) + (leads_[1] ? second : 0.0);
    const double size = mixed_ ? std::sqrt(3.0) : directions_norm_;
    double inverse = inverse_norm_;
    if (mixed_) {
        // Every place of the move is within half of it from one end.
        const double least = 1.0 / std::max(inverseNorm(from.rotary_rad), inverseNorm(to.rotary_rad));
        const double left = least - 0.5 * size * leading;
        if (left <= 0.0) return unbounded;
        inverse = 1.0 / left;
    }
    const double w_slope = tip_way_mm + first * levers_mm_[0] + both * levers_mm_[1];
    const double w_curve = first * first * levers_mm_[0] + both * both * levers_mm_[1];
    // |q| <= its greater end + half of what its slope allows, and its slope depends on |q|.
    const double end = std::max(from.linear_mm.norm(), to.linear_mm.norm());
    const double gain = 0.5 * inverse * size * leading;
    if (gain >= 1.0) return unbounded;
    const double q = (end + 0.5 * inverse * w_slope) / (1.0 - gain);
    const double q_slope = inverse * (w_slope + size * leading * q);
    const double q_curve = inverse * (w_curve + 2.0 * size * leading * q_slope + size * leading * leading * q);
    return q_curve / 8.0;
}

/// 1 / the least singular value of the linear directions as they are turned.
double LinearTravel::inverseNorm(const RotaryValues& rotary_rad) const {
    const machine::MachineDefinition& definition = machine_.definition();
    Matrix3 directions = Matrix3::Identity();
    Matrix3 rotation = Matrix3::Identity();
    Eigen::Index linear = 0;
    std::size_t rotary = 0;
    for (const std::string& name : definition.axisNames()) {
        if (const auto axis = definition.linear.find(name); axis != definition.linear.end()) {
            directions.col(linear++) = rotation * geometry::toVector(axis->second.direction);
        } else {
            rotation =
                rotation * Eigen::AngleAxisd(rotary_rad[rotary], machine_.rotaryDirection(rotary)).toRotationMatrix();
            ++rotary;
        }
    }
    return 1.0 / directions.jacobiSvd().singularValues()[2];
}

std::optional<LinearTravel::Pose> LinearTravel::solve(const Vector3& tip_mm, const RotaryValues& rotary_rad,
                                                      std::uint32_t cl_line) {
    ++summary_.looks;
    const auto linear_mm = machine_.solveLinear(tip_mm + *origin_mm_, rotary_rad, *tool_length_mm_);
    if (linear_mm) return Pose{.tip_mm = tip_mm, .values = {.linear_mm = *linear_mm, .rotary_rad = rotary_rad}};
    if (std::exchange(singular_line_, cl_line) != cl_line)
        report_.error("kinematics.linear-singular",
                      fmt::format("at CL line {} a rotary axis has turned the linear axes into one plane", cl_line),
                      {.file = options_.file_name, .line = cl_line, .column = 0, .key = {}});
    return std::nullopt;
}

void LinearTravel::note(const AxisValues& values, std::uint32_t cl_line, bool at_end) {
    for (std::size_t i = 0; i < 3; ++i) {
        const double position = values.linear_mm[static_cast<Eigen::Index>(i)];
        auto& [low, high] = summary_.range_mm[i];
        low = std::min(low, position);
        high = std::max(high, position);

        Held& held = held_[i];
        if (held.line != cl_line) tell(i);
        held.line = cl_line;
        const double excess = machine_.linearRange(i).excess(position);
        if (at_end) {
            held.at_end = excess >= held.excess_mm - rounding_mm;
            held.end_excess_mm = excess;
        }
        if (excess <= std::max(rounding_mm, held.excess_mm)) continue;
        if (!at_end && excess <= held.start_excess_mm + rounding_mm) continue;
        held.excess_mm = excess;
        held.position_mm = position;
        held.at_end = at_end;
    }
}

void LinearTravel::tell(std::size_t axis) {
    Held& held = held_[axis];
    if (held.excess_mm > 0.0) {
        ++summary_.violations;
        const AxisRange& range = machine_.linearRange(axis);
        report_.error("kinematics.linear-limit",
                      fmt::format("{} axis would need {} mm {} CL line {}; limit {} mm", machine_.linearNames()[axis],
                                  lengthText(held.position_mm), held.at_end ? "at" : "on the way to", held.line,
                                  lengthText(held.position_mm < range.min ? range.min : range.max)),
                      {.file = options_.file_name, .line = held.line, .column = 0, .key = {}});
    }
    held = {.start_excess_mm = held.end_excess_mm};
}

void LinearTravel::finish() {
    for (std::size_t i = 0; i < held_.size(); ++i) tell(i);
}

}  // namespace cusp::kinematics
