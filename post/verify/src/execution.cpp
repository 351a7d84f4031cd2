// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The programmed path as chords, and every sample's distance from those near the line it runs.
#include <cusp/post/verify/execution.hpp>

#include <cusp/post/reader/move_sampler.hpp>
#include <cusp/post/reader/program_reader.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>

namespace cusp::post::verify {

namespace {

using reader::ExecutedMotion;
using reader::ToolPose;
using reader::Vector3;

/// By which a chord may miss the programmed way.
constexpr double chord_tip_mm = 1e-4;
constexpr double chord_axis_rad = 1e-5;
constexpr int most_chords = 4096;
/// A sample's line is the one being run; smoothing spreads a block's end over its neighbours.
constexpr std::size_t chords_around = 48;
constexpr std::size_t most_findings = 20;
constexpr double far_apart = 10.0;
/// Chords as near as that are equally near.
constexpr double same_mm = 1e-6;

struct Chord {
    ToolPose from;
    ToolPose to;
    std::size_t line = 0;
    bool rapid = false;
    bool ends_move = false;
};

/// The way of every motion that the program determines; lines of the others, so that their samples are left out.
class ProgrammedPath : public reader::ProgramSink {
public:
    explicit ProgrammedPath(const MachineFile& machine) : chain_(machine.machine) {}

    void motion(const ExecutedMotion& motion) override {
        if (motion.place.line < last_line_) repeats_ = repeats_ == 0 ? motion.place.line : repeats_;
        last_line_ = motion.place.line;
        if (!motion.start_pose || !motion.end_pose || motion.machine_coordinates) {
            if (unplaced_.empty() || unplaced_.back() != motion.place.line) unplaced_.push_back(motion.place.line);
            return;
        }
        const reader::Bend bend = reader::bendOf(motion, chain_);
        const double parts =
            std::sqrt(std::max(bend.tip_mm / (8.0 * chord_tip_mm), bend.axis_rad / (8.0 * chord_axis_rad)));
        const int count = std::clamp(static_cast<int>(std::ceil(parts)), 1, most_chords);
        ToolPose from = reader::poseAt(motion, chain_, 0.0);
        for (int i = 1; i <= count; ++i) {
            const ToolPose to = reader::poseAt(motion, chain_, static_cast<double>(i) / count);
            chords_.push_back({from, to, motion.place.line, motion.code == reader::MotionCode::Rapid, i == count});
            from = to;
        }
    }
    void event(const reader::BlockPlace& /*place*/, const reader::ExecutedEvent& /*event*/) override {}

    [[nodiscard]] const std::vector<Chord>& chords() const { return chords_; }
    [[nodiscard]] bool unplaced(std::size_t line) const { return std::ranges::binary_search(unplaced_, line); }
    /// First line that was run again after a later one; 0: none.
    [[nodiscard]] std::size_t repeats() const { return repeats_; }

private:
    reader::ForwardChain chain_;
    std::vector<Chord> chords_;
    std::vector<std::size_t> unplaced_;
    std::size_t last_line_ = 0;
    std::size_t repeats_ = 0;
};

/// Of the nearest place on the segment a–b, in [0, 1]; its end where it has no length.
double shareOf(const Vector3& point, const Vector3& a, const Vector3& b) {
    const Vector3 along = b - a;
    const double length2 = dot(along, along);
    return length2 > 0.0 ? std::clamp(dot(point - a, along) / length2, 0.0, 1.0) : 1.0;
}

double distanceFrom(const Vector3& point, const Vector3& a, const Vector3& b) {
    return norm(point - a - shareOf(point, a, b) * (b - a));
}

double axisMiss(const ToolPose& tool, const Chord& chord) {
    if (norm(chord.to.tip_mm - chord.from.tip_mm) > 0.0) {
        const double share = shareOf(tool.tip_mm, chord.from.tip_mm, chord.to.tip_mm);
        return reader::angleBetween(tool.axis, reader::onGreatCircle(chord.from.axis, chord.to.axis, share));
    }
    // Only the axis turns: it may be anywhere on its way.
    const double way = reader::angleBetween(chord.from.axis, chord.to.axis);
    const double first = reader::angleBetween(chord.from.axis, tool.axis);
    const double second = reader::angleBetween(chord.to.axis, tool.axis);
    return std::max(0.0, (first + second - way) / 2.0);
}

class Comparison {
public:
    Comparison(const ProgrammedPath& path, const std::string& name, const ExecutionOptions& options,
               ExecutionReport& report)
        : path_(path),
          chords_(path.chords()),
          name_(name),
          options_(options),
          report_(report),
          nearest_mm_(chords_.size(), std::numeric_limits<double>::infinity()) {}

    void take(const ExecutedSample& sample) {
        ++report_.samples;
        const auto [first, last] = window(sample.line);
        reach(sample, first, last);
        const ExecutedSample* before = std::exchange(before_, &sample);
        if (first == last || path_.unplaced(sample.line)) return;
        const auto own = std::ranges::lower_bound(chords_, sample.line, {}, &Chord::line);
        if (own == chords_.end() || own->line != sample.line) return;
        ++report_.compared;
        const double tip_mm = distanceNear(sample.tool.tip_mm, first, last);
        if (own->rapid) return widen(report_.max_tip_rapid_mm, tip_mm, sample);
        ++report_.cutting;
        sum2_ += tip_mm * tip_mm;
        widen(report_.max_tip_mm, tip_mm, sample);
        widen(report_.max_axis_rad, axisNear(sample.tool, first, last, tip_mm), sample);
        if (tip_mm > options_.tip_tolerance_mm) return off(sample, tip_mm);
        if (before != nullptr) checkWay(*before, sample, first, last);
    }

    void finish() {
        if (report_.cutting > 0) report_.rms_tip_mm = std::sqrt(sum2_ / static_cast<double>(report_.cutting));
        std::size_t told = 0;
        for (std::size_t i = 0; i < chords_.size(); ++i) {
            const Chord& chord = chords_[i];
            if (chord.rapid || !chord.ends_move) continue;
            ++report_.points;
            if (nearest_mm_[i] > report_.max_unreached_mm.value)
                report_.max_unreached_mm = {nearest_mm_[i], 0.0, chord.line};
            if (nearest_mm_[i] <= options_.tip_tolerance_mm) continue;
            ++report_.unreached;
            if (told++ < most_findings)
                report_.findings.error("execution.unreached", unreachedText(nearest_mm_[i]),
                                       {name_, chord.line, 0, {}});
        }
        // Infinity is no number of JSON: the tool was never near.
        if (!std::isfinite(report_.max_unreached_mm.value)) report_.max_unreached_mm.value = -1.0;
        report_.pass = !report_.findings.hasErrors();
    }

private:
    /// Chords of the line and around it.
    [[nodiscard]] std::pair<std::size_t, std::size_t> window(std::size_t line) const {
        const auto range = std::ranges::equal_range(chords_, line, {}, &Chord::line);
        const auto first = static_cast<std::size_t>(range.begin() - chords_.begin());
        const auto last = static_cast<std::size_t>(range.end() - chords_.begin());
        return {first - std::min(first, chords_around), std::min(chords_.size(), last + chords_around)};
    }
    [[nodiscard]] double distanceNear(const Vector3& tip_mm, std::size_t first, std::size_t last) const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = first; i < last; ++i)
            least = std::min(least, distanceFrom(tip_mm, chords_[i].from.tip_mm, chords_[i].to.tip_mm));
        return least;
    }
    /// Samples far apart, as where some were left out, must not jump across the path.
    void checkWay(const ExecutedSample& before, const ExecutedSample& sample, std::size_t first, std::size_t last) {
        if (path_.unplaced(before.line) ||
            norm(sample.tool.tip_mm - before.tool.tip_mm) < far_apart * options_.tip_tolerance_mm)
            return;
        const Vector3 middle = 0.5 * before.tool.tip_mm + 0.5 * sample.tool.tip_mm;
        const double off_mm = distanceNear(middle, first, last);
        if (off_mm > options_.tip_tolerance_mm) off(sample, off_mm);
    }
    /// How near the way since the last sample came to the ends of moves.
    void reach(const ExecutedSample& sample, std::size_t first, std::size_t last) {
        const ExecutedSample& from = before_ != nullptr ? *before_ : sample;
        for (std::size_t i = first; i < last; ++i)
            if (chords_[i].ends_move && !chords_[i].rapid)
                nearest_mm_[i] =
                    std::min(nearest_mm_[i], distanceFrom(chords_[i].to.tip_mm, from.tool.tip_mm, sample.tool.tip_mm));
    }
    /// Of the chords the tip is nearest to: several, where it rests and the axis turns.
    [[nodiscard]] double axisNear(const ToolPose& tool, std::size_t first, std::size_t last, double tip_mm) const {
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = first; i < last; ++i)
            if (distanceFrom(tool.tip_mm, chords_[i].from.tip_mm, chords_[i].to.tip_mm) <= tip_mm + same_mm)
                least = std::min(least, axisMiss(tool, chords_[i]));
        return least;
    }
    static void widen(ExecutedExtreme& extreme, double value, const ExecutedSample& sample) {
        if (value > extreme.value) extreme = {value, sample.time_s, sample.line};
    }
    void off(const ExecutedSample& sample, double tip_mm) {
        if (sample.line == told_line_ || told_ >= most_findings) return;
        told_line_ = sample.line;
        ++told_;
        report_.findings.error("execution.tip",
                               fmt::format("at {:.3f} s the tip was {:.4f} mm off the programmed path; {:.4g} mm are "
                                           "allowed",
                                           sample.time_s, tip_mm, options_.tip_tolerance_mm),
                               {name_, sample.line, 0, {}});
    }
    static std::string unreachedText(double miss_mm) {
        if (!std::isfinite(miss_mm)) return "no sample shows the tool near the end of this block";
        return fmt::format("the tool came no nearer to the end of this block than {:.4f} mm", miss_mm);
    }

    const ProgrammedPath& path_;
    const std::vector<Chord>& chords_;
    const std::string& name_;
    const ExecutionOptions& options_;
    ExecutionReport& report_;
    std::vector<double> nearest_mm_;
    const ExecutedSample* before_ = nullptr;
    double sum2_ = 0.0;
    std::size_t told_line_ = 0;
    std::size_t told_ = 0;
};

}  // namespace

base::Result<ExecutionReport> compareExecution(std::istream& program, const std::string& program_name,
                                               const MachineFile& machine, const std::vector<ExecutedSample>& samples,
                                               const ExecutionOptions& options) {
    ProgrammedPath path(machine);
    reader::ReaderOptions reading;
    reading.setup = {options.tool_length_mm, options.wcs_origin_mm, options.setup};
    base::Diagnostics read;
    reader::readProgram(program, program_name, machine, reading, path, read);
    if (read.hasErrors()) return base::fail(std::move(read));
    if (path.repeats() > 0)
        return base::fail("execution.repeats",
                          "the program runs this line more than once, so that a sample's line does not say which time",
                          {program_name, path.repeats(), 0, {}});
    ExecutionReport report;
    Comparison comparison(path, program_name, options, report);
    for (const ExecutedSample& sample : samples) comparison.take(sample);
    comparison.finish();
    return report;
}

std::string toText(const ExecutionReport& report) {
    const auto line = [](std::string_view name, const ExecutedExtreme& at, double value, std::string_view unit) {
        return fmt::format("{:<22}{:.3g}{}  at line {}, {:.3f} s\n", name, value, unit, at.line, at.time_s);
    };
    std::string text = fmt::format("{:<22}{} samples, {} in feed moves\n", "executed", report.samples, report.cutting);
    text += line("  tip off the path", report.max_tip_mm, report.max_tip_mm.value, " mm");
    text += fmt::format("{:<22}{:.3g} mm\n", "  root mean square", report.rms_tip_mm);
    text += line("  axis off the path", report.max_axis_rad, base::degFromRad(report.max_axis_rad.value), "°");
    text += line("  tip, in rapids", report.max_tip_rapid_mm, report.max_tip_rapid_mm.value, " mm");
    text += fmt::format("{:<22}{} of {}\n", "  block ends reached", report.points - report.unreached, report.points);
    return text + fmt::format("{:<22}{}\n", "execution", report.pass ? "pass" : "FAIL");
}

}  // namespace cusp::post::verify
