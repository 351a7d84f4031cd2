// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Planned motion, run at a rate that can be changed on the way: override, stop, go on.
#pragma once

#include <cusp/dynamics/motion_planner.hpp>

#include <array>
#include <cstddef>
#include <deque>
#include <optional>

namespace cusp::comm {

/// The rate is how much planned time goes by in a second. It changes along a smooth step whose length is found by running it
/// ahead, sample by sample, against the limits of every axis; while it lasts the plan ahead is not replaced.
class MotionClock {
public:
    MotionClock(const dynamics::AxisLimits& limits, double tick_s, const dynamics::AxisVector& start);

    /// What was planned: follows what is committed already, and replaces what led to rest before.
    void take(dynamics::Plan plan);
    /// The way to rest is being run: it is final. True once, when that begins.
    [[nodiscard]] bool enteredRest();
    /// Drops all motion; only at rest.
    void clear();

    /// Rate to go to, 0 to 1.
    void setRate(double rate) {
        if (rate != wanted_) ticks_ = 0;
        wanted_ = rate;
    }
    [[nodiscard]] double rate() const { return rate_; }
    [[nodiscard]] bool ramping() const { return ramp_.has_value(); }
    /// Nothing moves: the rate is zero, or everything planned has been run.
    [[nodiscard]] bool atRest() const { return (rate_ == 0.0 && !ramp_) || pieces_.empty(); }
    [[nodiscard]] bool empty() const { return pieces_.empty(); }
    /// Planned time up to the way to rest.
    [[nodiscard]] double committed_s() const;
    /// The piece being run.
    [[nodiscard]] const dynamics::MotionPiece* piece() const { return pieces_.empty() ? nullptr : &pieces_.front(); }

    /// One tick on.
    void step();
    [[nodiscard]] const dynamics::AxisVector& axes() const { return history_[0]; }

private:
    struct Ramp {
        double from = 0.0;
        double to = 0.0;
        double wait_s = 0.0;
        double length_s = 0.0;
        double elapsed_s = 0.0;
        double start_s = 0.0;  ///< planned time when it began, in the piece at the front then
    };
    [[nodiscard]] double plannedTime(const Ramp& ramp, double elapsed_s) const;
    [[nodiscard]] bool keepsLimits(const Ramp& ramp) const;
    [[nodiscard]] std::optional<Ramp> findRamp() const;
    [[nodiscard]] dynamics::AxisVector ahead(double planned_s) const;
    void moveOn(double planned_s);

    dynamics::AxisLimits limits_;
    double tick_s_;
    std::deque<dynamics::MotionPiece> pieces_;
    std::size_t committed_ = 0;  ///< pieces at the front that are final
    double at_s_ = 0.0;          ///< planned time in the front piece
    double rate_ = 1.0;
    double wanted_ = 1.0;
    std::optional<Ramp> ramp_;
    int ticks_ = 0;  ///< since a ramp was last looked for
    bool in_rest_ = false;
    bool told_rest_ = false;
    std::array<dynamics::AxisVector, 3> history_;  ///< the last samples, newest first
};

}  // namespace cusp::comm
