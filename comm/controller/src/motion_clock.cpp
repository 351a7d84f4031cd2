// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Ramps of the rate, proved before they are run.
#include "motion_clock.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::comm {

using dynamics::AxisVector;

namespace {

constexpr double shortest_ramp_s = 0.02;
constexpr double longest_ramp_s = 30.0;
constexpr double growth = 1.25;
/// A plan that brakes as hard as it may leaves nothing for a ramp just then.
constexpr double waits_s[] = {0.0, 0.03, 0.1, 0.3};
constexpr int ticks_per_try = 8;
/// Of a limit: rounding of third differences.
constexpr double rounding = 1e-6;

}  // namespace

MotionClock::MotionClock(const dynamics::AxisLimits& limits, double tick_s, const AxisVector& start)
    : limits_(limits), tick_s_(tick_s), history_{start, start, start} {}

void MotionClock::take(dynamics::Plan plan) {
    pieces_.erase(pieces_.begin() + static_cast<std::ptrdiff_t>(committed_), pieces_.end());
    pieces_.insert(pieces_.end(), plan.committed.begin(), plan.committed.end());
    committed_ = pieces_.size();
    pieces_.insert(pieces_.end(), plan.to_rest.begin(), plan.to_rest.end());
    in_rest_ = told_rest_ = false;
}

bool MotionClock::enteredRest() {
    if (!in_rest_ || told_rest_) return false;
    told_rest_ = true;
    committed_ = pieces_.size();
    return true;
}

void MotionClock::clear() {
    pieces_.clear();
    committed_ = 0;
    at_s_ = 0.0;
    in_rest_ = told_rest_ = false;
    ramp_.reset();
    rate_ = wanted_ = 1.0;
}

double MotionClock::committed_s() const {
    double sum = -at_s_;
    for (std::size_t i = 0; i < committed_; ++i) sum += pieces_[i].law.duration_s;
    return std::max(0.0, sum);
}

AxisVector MotionClock::ahead(double planned_s) const {
    for (const dynamics::MotionPiece& piece : pieces_) {
        if (planned_s <= piece.law.duration_s) return piece.at(planned_s);
        planned_s -= piece.law.duration_s;
    }
    return pieces_.empty() ? history_[0] : pieces_.back().at(pieces_.back().law.duration_s);
}

/// The integral of from + (to - from) (3 u² - 2 u³).
double MotionClock::plannedTime(const Ramp& ramp, double elapsed_s) const {
    const double waited = std::min(elapsed_s, ramp.wait_s);
    const double ramped = std::clamp(elapsed_s - ramp.wait_s, 0.0, ramp.length_s);
    const double after = std::max(0.0, elapsed_s - ramp.wait_s - ramp.length_s);
    const double u = ramped / ramp.length_s;
    return ramp.start_s + ramp.from * (waited + ramped) +
           (ramp.to - ramp.from) * ramp.length_s * u * u * u * (1.0 - 0.5 * u) + ramp.to * after;
}

bool MotionClock::keepsLimits(const Ramp& ramp) const {
    AxisVector q1 = history_[0];
    AxisVector q2 = history_[1];
    AxisVector q3 = history_[2];
    const double end_s = ramp.wait_s + ramp.length_s + 4.0 * tick_s_;
    const double t = tick_s_;
    for (double elapsed = t; elapsed < end_s; elapsed += t) {
        const AxisVector q0 = ahead(plannedTime(ramp, elapsed));
        for (std::size_t i = 0; i < limits_.count; ++i)
            if (std::abs(q0[i] - q1[i]) > limits_.velocity[i] * t * (1.0 + rounding) ||
                std::abs(q0[i] - 2.0 * q1[i] + q2[i]) > limits_.acceleration[i] * t * t * (1.0 + rounding) ||
                std::abs(q0[i] - 3.0 * q1[i] + 3.0 * q2[i] - q3[i]) > limits_.jerk[i] * t * t * t * (1.0 + rounding))
                return false;
        q3 = q2;
        q2 = q1;
        q1 = q0;
    }
    return true;
}

/// A new rate waits for a moment when it can be reached before the way to rest begins: the plan is not renewed meanwhile. A
/// stop does not wait.
std::optional<MotionClock::Ramp> MotionClock::findRamp() const {
    const double shortest = std::max(shortest_ramp_s, 4.0 * tick_s_);
    double longest = longest_ramp_s;
    const bool may_wait = rate_ > 0.0 && wanted_ > 0.0 && committed_ < pieces_.size();
    if (may_wait && committed_s() > 2.0 * shortest) longest = committed_s();
    for (double length = shortest; length < longest; length *= growth)
        for (const double wait : waits_s) {
            const Ramp ramp{rate_, wanted_, wait, length, 0.0, at_s_};
            if (wait + length < longest && keepsLimits(ramp)) return ramp;
        }
    return std::nullopt;
}

void MotionClock::moveOn(double planned_s) {
    at_s_ = planned_s;
    while (!pieces_.empty() && at_s_ > pieces_.front().law.duration_s) {
        at_s_ -= pieces_.front().law.duration_s;
        if (ramp_) ramp_->start_s -= pieces_.front().law.duration_s;
        pieces_.pop_front();
        if (committed_ > 0) --committed_;
    }
    if (pieces_.empty()) at_s_ = 0.0;
}

void MotionClock::step() {
    AxisVector next = history_[0];
    if (!pieces_.empty()) {
        if (!ramp_ && rate_ != wanted_ && ticks_++ % ticks_per_try == 0) ramp_ = findRamp();
        double planned = at_s_ + rate_ * tick_s_;
        if (ramp_) {
            ramp_->elapsed_s += tick_s_;
            planned = plannedTime(*ramp_, ramp_->elapsed_s);
        }
        next = ahead(planned);
        moveOn(planned);
        if (committed_ == 0 && !pieces_.empty()) in_rest_ = true;
        if (ramp_ && ramp_->elapsed_s >= ramp_->wait_s + ramp_->length_s) {
            rate_ = ramp_->to;
            ramp_.reset();
        }
    }
    if (pieces_.empty()) {
        // At rest the rate may be anything at once.
        ramp_.reset();
        rate_ = wanted_;
    }
    history_ = {next, history_[0], history_[1]};
}

}  // namespace cusp::comm
