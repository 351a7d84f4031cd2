// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// First entry into a swept body: Newton's method along the line, branch and bound over the time of the move.
//
// Let G(s, t) be the distance of the point p + s·n to the body at time t. G is convex in s, so Newton's method from before the
// body finds the first entry at one time. Over time, a body that only shifts makes G convex in t as well; turning by θ
// spoils that by at most K = θ²·|w| + 2·θ·L, where w is the way from tip to point and L the length of the move: seen from the
// tool, the point's path y(t) has |y''| ≤ K, and G(y) is convex in y with a gradient of at most 1. So
//   G(τ) ≥ G(t) + G'(t)·(τ − t) − K·(τ − t)²/2
// for all τ, and what lies above zero by that bound holds no entry. The rest is halved until nothing is left. Where the line
// has passed the body before s, G is replaced by its least value up to s, for which the same bound holds.
#include "move_entry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace cusp::simulation {

using geometry::Vector3;

namespace {

constexpr double most_turn_rad = 0.1;
/// More than any search needs: every other step halves a stretch, down to what moves the tool by less than the tolerance.
constexpr std::size_t most_pending = 64;
constexpr int most_newton_steps = 40;
constexpr double newton_stop_mm = 1e-10;

}  // namespace

/// A stretch of time that may hold an entry, with the slope of G at its ends where it is known.
struct SweptMove::Stretch {
    double from = 0.0;
    double to = 1.0;
    double slope_from = std::numeric_limits<double>::quiet_NaN();
    double slope_to = std::numeric_limits<double>::quiet_NaN();
    int depth = 0;

    /// Where to look next: the zero of the slope if it is enclosed, downhill of the end where it is known. Every third time
    /// the middle, so that stretches shrink whatever the slopes say.
    [[nodiscard]] double next() const {
        const double middle = 0.5 * (from + to);
        if (depth % 3 == 2) return middle;
        if (slope_from < 0.0 && slope_to > 0.0) {
            const double zero = from + (to - from) * slope_from / (slope_from - slope_to);
            const double margin = 0.02 * (to - from);
            return std::clamp(zero, from + margin, to - margin);
        }
        if (slope_from < 0.0 && std::isnan(slope_to)) return std::min(to, from + probe);
        if (slope_to > 0.0 && std::isnan(slope_from)) return std::max(from, to - probe);
        return middle;
    }

    /// Keeps the side on which it goes down from `time`. False when `time` is the end of that side already.
    bool narrow(double time, double slope) {
        const bool forwards = slope <= 0.0;
        if (forwards ? time >= to : time <= from) return false;
        (forwards ? from : to) = time;
        (forwards ? slope_from : slope_to) = slope;
        return true;
    }

    /// The same where nothing is known of the other end: that end itself.
    [[nodiscard]] double downhill() const {
        if (std::isnan(slope_to)) return to;
        if (std::isnan(slope_from)) return from;
        return next();
    }

    /// The first look is near the least distance: its other side is not far.
    static constexpr double probe = 0.15;
};

void SweptMove::split(const ToolMove& move, std::uint32_t index, const CutterBody& body, std::vector<SweptMove>& out) {
    const double turn = geometry::angleBetween(move.from.axis, move.to.axis);
    Vector3 side = move.to.axis - move.to.axis.dot(move.from.axis) * move.from.axis;
    if (side.norm() > 0.0) side.normalize();
    const int parts = std::max(1, static_cast<int>(std::ceil(turn / most_turn_rad)));
    for (int i = 0; i < parts; ++i) {
        const double begin = turn * i / parts;
        SweptMove part;
        part.body_ = &body;
        part.move_ = index;
        part.tip_way_ = (move.to.tip_mm - move.from.tip_mm) / parts;
        part.tip_ = move.from.tip_mm + i * part.tip_way_;
        part.axis_ = std::cos(begin) * move.from.axis + std::sin(begin) * side;
        part.axis_side_ = std::cos(begin) * side - std::sin(begin) * move.from.axis;
        part.turn_rad_ = turn / parts;
        part.length_mm_ = part.tip_way_.norm();
        out.push_back(part);
    }
}

SweptMove::Sample SweptMove::sample(const Vector3& x, double time) const {
    // Taylor: the angle is at most 0.1, the first term left out 2e-11.
    const double angle = turn_rad_ * time;
    const double square = angle * angle;
    const double sine = angle * (1.0 - square / 6.0 * (1.0 - square / 20.0));
    const double cosine = 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0));
    const Vector3 axis = cosine * axis_ + sine * axis_side_;
    const Vector3 axis_rate = turn_rad_ * (cosine * axis_side_ - sine * axis_);
    const Vector3 away = x - tip_ - time * tip_way_;
    const double z = away.dot(axis);
    const Vector3 across = away - z * axis;
    const double rho = across.norm();
    const double inverse_rho = rho > 1e-12 ? 1.0 / rho : 0.0;
    const CutterBody::Value value = body_->at(rho, z);
    // The gradient in space; along it the point moves by −way of the tip, and the axis turns under it.
    const Vector3 gradient = value.by_rho * inverse_rho * across + value.by_z * axis;
    const double z_rate = away.dot(axis_rate);
    return {value.distance_mm, -gradient.dot(tip_way_) + (value.by_z - value.by_rho * inverse_rho * z) * z_rate,
            gradient};
}

SweptMove::Nearness SweptMove::nearness(const Vector3& point, double around_mm) const {
    // Seen from the tool, a point on the straight way from here at one time to there at another has
    // |y''| ≤ K·Δt² + 2·θ·Δt·|way|; the distance lies above its tangent less half of that.
    constexpr int looks = 4;
    const double half_bend = 0.5 * bend(point, around_mm);
    Nearness best;
    best.distance_mm = -std::numeric_limits<double>::infinity();
    Stretch stretch;
    double time = 0.5;
    for (int look = 0; look < looks; ++look) {
        const Sample here = sample(point, time);
        const auto at = [&](double other) {
            return here.by_time * (other - time) - half_bend * std::pow(other - time, 2);
        };
        const double distance = here.distance + std::min({0.0, at(0.0), at(1.0)});
        if (distance > best.distance_mm) best = {distance, here.gradient, turn_rad_ * std::max(time, 1.0 - time), time};
        if (!stretch.narrow(time, here.by_time)) break;
        time = stretch.downhill();
    }
    return best;
}

SweptHull SweptMove::hull() const {
    const double half = 0.5 * turn_rad_;
    return {
        *body_, {tip_ + 0.5 * tip_way_, std::cos(half) * axis_ + std::sin(half) * axis_side_}, 0.5 * length_mm_, half};
}

void SweptHull::extend(const SweptHull& other) {
    tip_spread_mm_ = std::max(tip_spread_mm_, (other.pose_.tip_mm - pose_.tip_mm).norm() + other.tip_spread_mm_);
    turn_spread_rad_ =
        std::max(turn_spread_rad_, geometry::angleBetween(other.pose_.axis, pose_.axis) + other.turn_spread_rad_);
}

double SweptHull::clearance(const Vector3& point) const {
    const Vector3 away = point - pose_.tip_mm;
    const double z = away.dot(pose_.axis);
    const double rho = (away - z * pose_.axis).norm();
    // Shifting the cutter by d or turning it by θ about its tip brings it closer by at most d, and θ·|way from the tip|.
    return body_->at(rho, z).distance_mm - tip_spread_mm_ - turn_spread_rad_ * (away.norm() + tip_spread_mm_);
}

double SweptMove::entryAt(const NormalLine& line, double time, double floor_mm, double inside_mm) const {
    // From a point inside, on the near side of the deepest one, Newton's method steps back past the entry and then comes to
    // it from before; where the line is leaving already, it starts at the floor.
    double s = inside_mm;
    for (int step = 0; step < most_newton_steps; ++step) {
        const Sample here = sample(line.origin + s * line.direction, time);
        if (std::abs(here.distance) < newton_stop_mm) return std::max(s, floor_mm);
        if (here.gradient.dot(line.direction) >= -1e-9) {
            if (s <= floor_mm) return floor_mm;
            s = floor_mm;
            continue;
        }
        const double next = std::max(s - here.distance / here.gradient.dot(line.direction), floor_mm);
        if (next == s) return s;  // the floor is inside, or the last digit is reached
        s = next;
    }
    return s;
}

SweptMove::Sample SweptMove::nearest(const NormalLine& line, double time, double floor_mm, double& s_mm) const {
    constexpr double close_enough_mm = 0.1 * search_tolerance_mm;
    double before = floor_mm;
    double after = s_mm;
    Sample here = sample(line.origin + before * line.direction, time);
    s_mm = before;
    while (here.gradient.dot(line.direction) < 0.0 && here.distance > 0.0 && after - before > close_enough_mm) {
        const double middle = 0.5 * (before + after);
        const Sample there = sample(line.origin + middle * line.direction, time);
        if (there.gradient.dot(line.direction) > 0.0 && there.distance > 0.0) {
            after = middle;
            continue;
        }
        before = s_mm = middle;
        here = there;
    }
    return here;
}

bool SweptMove::lowerEntry(const NormalLine& line, double floor_mm, double& entry_mm, double& found_time) const {
    std::array<Stretch, most_pending> pending;
    std::size_t count = 1;
    double guess = found_time;
    bool lowered = false;
    const double s_span = entry_mm - floor_mm;
    while (count > 0) {
        const Stretch stretch = pending[--count];
        const double time = guess >= 0.0 ? std::exchange(guess, -1.0) : stretch.next();
        double s = entry_mm - search_tolerance_mm;
        if (s <= floor_mm) return lowered;
        const Vector3 x = line.origin + s * line.direction;
        Sample here = sample(x, time);
        if (here.distance > 0.0 && here.gradient.dot(line.direction) > 0.0) {
            const double least = here.distance - here.gradient.dot(line.direction) * (s - floor_mm);
            if (least > speed(x) * std::max(stretch.to - time, time - stretch.from)) continue;
            here = nearest(line, time, floor_mm, s);
        }
        if (here.distance < 0.0) {
            entry_mm = entryAt(line, time, floor_mm, s);
            lowered = true;
            found_time = time;
            here = sample(line.origin + (entry_mm - search_tolerance_mm) * line.direction, time);
        }
        const double half_bend = 0.5 * bend(x, s_span);
        const auto bound = [&](double other) {
            const double way = other - time;
            return here.distance + here.by_time * way - half_bend * way * way;
        };
        // What is left of a stretch this short moves the tool by less than the tolerance.
        const double shortest = search_tolerance_mm / (speed(x) + search_tolerance_mm);
        const auto keep = [&](const Stretch& part) {
            if (part.to - part.from > shortest && count < most_pending) pending[count++] = part;
        };
        if (stretch.to > time && bound(stretch.to) < 0.0)
            keep({time, stretch.to, here.by_time, stretch.slope_to, stretch.depth + 1});
        if (stretch.from < time && bound(stretch.from) < 0.0)
            keep({stretch.from, time, stretch.slope_from, here.by_time, stretch.depth + 1});
    }
    return lowered;
}

}  // namespace cusp::simulation
