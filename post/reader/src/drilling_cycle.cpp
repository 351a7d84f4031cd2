// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Sequences of motions as the programming guide describes them for each cycle.
#include "drilling_cycle.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace cusp::post::reader {

namespace {

using Kind = CycleStep::Kind;
using Steps = std::vector<CycleStep>;

struct Signature {
    std::string_view name;
    std::size_t arguments;
};
constexpr Signature signatures[] = {{"CYCLE81", 6}, {"CYCLE82", 6},  {"CYCLE83", 12}, {"CYCLE84", 12},
                                    {"CYCLE85", 8}, {"CYCLE86", 11}, {"CYCLE840", 11}};

/// Distance kept from the ground of the last peck when the tool comes back at rapid, and lift that breaks a chip.
constexpr double anticipation = 0.6;
constexpr double chip_break_lift = 1.0;
/// Sums of printed heights.
constexpr double same_plane = 1e-9;
constexpr std::size_t most_pecks = 10'000;

/// ISO 261, coarse pitches: MPIT names the thread by its diameter.
constexpr double coarse_pitches[][2] = {{3, 0.5},  {4, 0.7},  {5, 0.8},  {6, 1},    {8, 1.25}, {10, 1.5}, {12, 1.75},
                                        {14, 2},   {16, 2},   {18, 2.5}, {20, 2.5}, {22, 2.5}, {24, 3},   {27, 3},
                                        {30, 3.5}, {33, 3.5}, {36, 4},   {39, 4},   {42, 4.5}, {45, 4.5}, {48, 5}};

struct Hole {
    double retract = 0.0;
    double reference = 0.0;
    double start = 0.0;
    double bottom = 0.0;
};

class Maker {
public:
    Maker(std::string_view name, const CycleArguments& arguments) : name_(name), arguments_(arguments) {
        hole_.retract = at(0);
        hole_.reference = at(1);
        hole_.start = at(1) + std::abs(at(2));
        hole_.bottom = at(4) != 0.0 ? at(1) - std::abs(at(4)) : at(3);
    }

    [[nodiscard]] std::string problem() const {
        const auto* const known = std::find_if(std::begin(signatures), std::end(signatures),
                                               [&](const Signature& s) { return s.name == name_; });
        for (std::size_t i = known->arguments; i < arguments_.size(); ++i)
            if (at(i) != 0.0)
                return fmt::format("argument {} is not interpreted; only the first {} are", i + 1, known->arguments);
        if (hole_.bottom >= hole_.reference)
            return fmt::format("the depth {:g} does not lie below the reference plane {:g}", hole_.bottom,
                               hole_.reference);
        if (hole_.retract < hole_.start - same_plane)
            return fmt::format("the retract plane {:g} lies below the start {:g}", hole_.retract, hole_.start);
        if (tapping() && name_ != "CYCLE840" && pitch() == 0.0) return "the thread has no pitch";
        if (name_ == "CYCLE86" && at(6) != 3.0 && at(6) != 4.0) return "SDIR is 3 or 4";
        return {};
    }

    Steps make() {
        rapid(hole_.start);
        if (name_ == "CYCLE83")
            pecks();
        else if (tapping())
            tap();
        else if (name_ == "CYCLE85")
            bore();
        else if (name_ == "CYCLE86")
            boreAndStepAside();
        else {
            feed(hole_.bottom);
            dwell(at(5));
        }
        rapid(hole_.retract);
        return std::move(steps_);
    }

private:
    [[nodiscard]] double at(std::size_t index) const {
        return index < arguments_.size() ? arguments_[index].value_or(0.0) : 0.0;
    }
    [[nodiscard]] bool tapping() const { return name_ == "CYCLE84" || name_ == "CYCLE840"; }

    CycleStep& add(Kind kind, double value) {
        CycleStep& step = steps_.emplace_back();
        step.kind = kind;
        step.value = value;
        return step;
    }
    void rapid(double height) { add(Kind::Rapid, height); }
    CycleStep& feed(double height) { return add(Kind::Feed, height); }
    void dwell(double length) {
        if (length > 0.0) add(Kind::DwellSeconds, length);
        if (length < 0.0) add(Kind::DwellRevolutions, -length);
    }

    void pecks() {
        const double first = at(6) != 0.0                             ? hole_.reference - std::abs(at(6))
                             : arguments_.size() > 5 && arguments_[5] ? *arguments_[5]
                                                                      : hole_.bottom;
        const bool removes_chips = at(11) == 1.0;
        double factor = at(10) > 0.0 ? at(10) : 1.0;
        double increment = hole_.reference - first;
        double depth = std::max(first, hole_.bottom);
        for (std::size_t peck = 0; peck < most_pecks; ++peck) {
            feed(depth).feed_factor = factor;
            factor = 1.0;
            dwell(at(8));
            if (depth <= hole_.bottom) return;
            if (removes_chips) {
                rapid(hole_.start);
                dwell(at(9));
                rapid(std::min(hole_.start, depth + anticipation));
            } else
                feed(depth + chip_break_lift);
            increment = nextIncrement(increment, depth - hole_.bottom);
            depth = increment > 0.0 ? std::max(hole_.bottom, depth - increment) : hole_.bottom;
        }
    }

    /// DAM > 0 takes that much off each peck, down to itself; DAM < 0 is a factor; a rest of less than two pecks of that
    /// size is halved.
    [[nodiscard]] double nextIncrement(double last, double rest) const {
        const double degression = at(7);
        if (degression < 0.0) return last * std::min(1.0, -degression);
        if (degression == 0.0) return last;
        const double next = std::max(degression, last - degression);
        return next == degression && rest > degression && rest < 2.0 * degression ? rest / 2.0 : next;
    }

    [[nodiscard]] double pitch() const {
        const std::size_t by_size = name_ == "CYCLE84" ? 7 : 9;
        if (at(by_size + 1) != 0.0) return std::abs(at(by_size + 1));
        for (const auto& [size, pitch] : coarse_pitches)
            if (size == std::abs(at(by_size))) return pitch;
        return 0.0;
    }

    void tap() {
        const auto thread = [&](double height, double speed) {
            CycleStep& step = feed(height);
            if (pitch() != 0.0) step.pitch = pitch();
            if (speed > 0.0) step.speed_rpm = speed;
        };
        const bool rigid = name_ == "CYCLE84";
        // Rigid tapping turns the spindle itself: to the right, or to the left for a pitch below 0.
        if (rigid) add(Kind::SpindleTurn, at(8) < 0.0 || (at(8) == 0.0 && at(7) < 0.0) ? 4.0 : 3.0);
        thread(hole_.bottom, rigid ? at(10) : 0.0);
        dwell(at(5));
        add(Kind::SpindleReverse, 0.0);
        thread(hole_.start, rigid ? (at(11) > 0.0 ? at(11) : at(10)) : 0.0);
        add(Kind::SpindleRestore, at(rigid ? 6 : 7));
    }

    void bore() {
        CycleStep& down = feed(hole_.bottom);
        if (at(6) > 0.0) down.feed = at(6);
        dwell(at(5));
        CycleStep& up = feed(hole_.start);
        if (at(7) > 0.0) up.feed = at(7);
    }

    /// At the bottom the spindle stops where POSS says, so that the edge can step away from the wall before it leaves.
    void boreAndStepAside() {
        add(Kind::SpindleTurn, at(6));
        feed(hole_.bottom);
        dwell(at(5));
        add(Kind::SpindleTurn, 5.0);
        aside(1.0);
        rapid(hole_.start);
        aside(-1.0);
        add(Kind::SpindleTurn, at(6));
    }

    /// RPA, RPO in the plane and RPAP along its normal; back only in the plane.
    void aside(double way) {
        if (at(7) == 0.0 && at(8) == 0.0 && at(9) == 0.0) return;
        CycleStep& step = add(Kind::Aside, 0.0);
        step.first = way * at(7);
        step.second = way * at(8);
        step.up = way > 0.0 ? at(9) : 0.0;
    }

    std::string_view name_;
    const CycleArguments& arguments_;
    Hole hole_;
    Steps steps_;
};

}  // namespace

bool isDrillingCycle(std::string_view name) {
    return std::any_of(std::begin(signatures), std::end(signatures),
                       [&](const Signature& s) { return s.name == name; });
}

std::optional<std::vector<CycleStep>> drillingSteps(std::string_view name, const CycleArguments& arguments,
                                                    std::string& problem) {
    Maker maker(name, arguments);
    problem = maker.problem();
    if (!problem.empty()) return std::nullopt;
    return maker.make();
}

}  // namespace cusp::post::reader
