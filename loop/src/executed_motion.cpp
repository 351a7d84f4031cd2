// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From a CL file or a record of the control to axis samples, and from those to the real motion of the tool.
#include <cusp/loop/executed_motion.hpp>

#include <cusp/base/number_text.hpp>
#include <cusp/base/units.hpp>
#include <cusp/dynamics/path_block.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace cusp::loop {
namespace {

/// Of the chords that stand for arcs of the CL file.
constexpr double chord_mm = 1e-4;
constexpr double rapid_mm_per_s = 500.0;
/// Of an ideal track: the tip's way and the axes' turn between two samples.
constexpr double sample_mm = 1.0;
constexpr double sample_rad = 0.004;
/// How far up the axis the tool's straightness is looked at.
constexpr double arm_mm = 100.0;

/// The feed that holds at each line of the CL file where one begins.
std::vector<std::pair<std::uint32_t, double>> feedsOf(const toolpath::ToolPath& path) {
    std::vector<std::pair<std::uint32_t, double>> out;
    double rpm = 0.0;
    for (const toolpath::ClRecord& record : path.records) {
        if (const auto* spindle = std::get_if<toolpath::SpindleCommand>(&record.statement))
            if (spindle->speed && spindle->unit == toolpath::SpindleCommand::Unit::Rpm) rpm = *spindle->speed;
        if (const auto* feed = std::get_if<toolpath::FeedRate>(&record.statement))
            out.emplace_back(record.line,
                             feed->unit == toolpath::FeedRate::Unit::MmPerS ? feed->value : feed->value * rpm / 60.0);
    }
    return out;
}

base::Result<geometry::RigidTransform> frameOf(const toolpath::ToolPath& path) {
    std::optional<geometry::RigidTransform> frame;
    for (const toolpath::ClRecord& record : path.records) {
        const auto* found = std::get_if<toolpath::ProgrammingFrame>(&record.statement);
        if (found == nullptr) continue;
        if (frame && !frame->isApprox(found->part_from_programming, 1e-12))
            return base::fail("cut.frames",
                              "the path has several programming frames; take the operations of one frame at a time",
                              {path.file_name, record.line, 0, {}});
        frame = found->part_from_programming;
    }
    return frame.value_or(geometry::RigidTransform::Identity());
}

toolpath::CutterLocation moved(const geometry::RigidTransform& to_from, const toolpath::CutterLocation& at) {
    return {.tip_mm = to_from * at.tip_mm, .axis = to_from.linear() * at.axis};
}

/// Follows the poses with the solution nearest to where the rotary axes stand.
class AxisFollower {
public:
    AxisFollower(const kinematics::Machine& machine, const CuttingSetup& setup) : machine_(machine), setup_(setup) {
        rotary_rad_ = machine.rotaryHome();
    }

    std::optional<kinematics::RotaryValues> rotaryFor(const Vector3& axis) {
        constexpr double reach_rad = 1e-6;
        const auto solutions =
            machine_.inverse({.tip_mm = Vector3::Zero(), .axis = axis}, setup_.tool_length_mm, reach_rad);
        const kinematics::AxisValues* best = nullptr;
        double least = std::numeric_limits<double>::infinity();
        for (const auto& candidate : solutions.values) {
            const double first = solutions.pole ? 0.0 : candidate.rotary_rad[0] - rotary_rad_[0];
            const double way = std::hypot(first, candidate.rotary_rad[1] - rotary_rad_[1]);
            if (way < least) {
                least = way;
                best = &candidate;
            }
        }
        if (best == nullptr) return std::nullopt;
        const double kept = rotary_rad_[0];
        rotary_rad_ = best->rotary_rad;
        if (solutions.pole) rotary_rad_[0] = kept;
        return rotary_rad_;
    }

    std::optional<dynamics::AxisVector> axesAt(const Vector3& tip_mm,
                                               const kinematics::RotaryValues& rotary_rad) const {
        const auto linear = machine_.solveLinear(tip_mm + setup_.wcs_origin_mm, rotary_rad, setup_.tool_length_mm);
        if (!linear) return std::nullopt;
        return dynamics::axisVector({.linear_mm = *linear, .rotary_rad = rotary_rad});
    }

private:
    const kinematics::Machine& machine_;
    CuttingSetup setup_;
    kinematics::RotaryValues rotary_rad_{};
};

base::Result<std::vector<std::size_t>> columnsOf(std::string_view header, const std::string& name,
                                                 const kinematics::Machine& machine) {
    std::vector<std::string> wanted{"time_s"};
    for (const std::string& axis : machine.linearNames()) wanted.push_back(axis + "_mm");
    for (const std::string& axis : machine.rotaryNames()) wanted.push_back(axis + "_deg");
    std::vector<std::string_view> found;
    for (std::size_t at = 0; at <= header.size();) {
        const std::size_t end = std::min(header.find(',', at), header.size());
        found.push_back(header.substr(at, end - at));
        at = end + 1;
    }
    std::vector<std::size_t> out;
    std::string missing;
    for (const std::string& column : wanted) {
        const auto place = std::ranges::find(found, column);
        if (place == found.end()) missing += (missing.empty() ? "" : ", ") + column;
        out.push_back(static_cast<std::size_t>(place - found.begin()));
    }
    if (!missing.empty())
        return base::fail("track.header",
                          fmt::format("the record has no column {}; cusp controller --record writes them", missing),
                          {name, 1, 0, {}});
    return out;
}

base::Result<std::vector<double>> numbersOf(std::string_view row, const std::vector<std::size_t>& columns,
                                            const std::string& name, std::size_t line) {
    std::vector<std::string_view> fields;
    for (std::size_t at = 0; at <= row.size();) {
        const std::size_t end = std::min(row.find(',', at), row.size());
        fields.push_back(row.substr(at, end - at));
        at = end + 1;
    }
    std::vector<double> out;
    for (const std::size_t column : columns) {
        if (column >= fields.size())
            return base::fail("track.columns",
                              fmt::format("the row has {} columns, {} are needed", fields.size(), column + 1),
                              {name, line, 0, {}});
        const auto value = base::parseDouble(fields[column]);
        if (!value || !std::isfinite(*value))
            return base::fail("track.number", fmt::format("'{}' is no number", fields[column]), {name, line, 0, {}});
        out.push_back(*value);
    }
    return out;
}

/// How far `at` is from where it would be on the straight way from `from` to `to`, after the share of time.
double offStraight(const toolpath::CutterLocation& from, const toolpath::CutterLocation& to,
                   const toolpath::CutterLocation& at) {
    const Vector3 way = to.tip_mm - from.tip_mm;
    const double square = way.squaredNorm();
    double share = 0.5;
    if (square > 1e-18) {
        share = std::clamp((at.tip_mm - from.tip_mm).dot(way) / square, 0.0, 1.0);
    } else if (const Vector3 turn = to.axis - from.axis; turn.squaredNorm() > 1e-18) {
        share = std::clamp((at.axis - from.axis).dot(turn) / turn.squaredNorm(), 0.0, 1.0);
    }
    const double tip = (at.tip_mm - (from.tip_mm + share * way)).norm();
    const Vector3 axis = (from.axis + share * (to.axis - from.axis)).normalized();
    return std::max(tip, arm_mm * (at.axis - axis).norm());
}

}  // namespace

base::Result<CutJob> cutJob(const toolpath::ToolPath& path) {
    const auto frame = frameOf(path);
    if (!frame) return base::fail(frame.error());
    base::Diagnostics report;
    simulation::PathCollector collector(path.file_name, chord_mm, report);
    for (const toolpath::ClRecord& record : path.records) collector.take(record);
    if (report.hasErrors()) return base::fail(std::move(report));
    CutJob out{.path = collector.finish(), .feed_mm_per_s = {}, .part_from_wcs = *frame};
    if (out.path.moves.empty())
        return base::fail("simulation.no-moves", "the path has no moves of a tool whose shape is known",
                          {path.file_name, 0, 0, {}});
    for (const simulation::ToolMove& move : out.path.moves)
        if (move.cutter != out.path.moves.front().cutter)
            return base::fail(
                "cut.cutters",
                "the path uses several cutters; take the operations of the cutter that leaves the surface",
                {path.file_name, move.line, 0, {}});
    out.path.cutters = {out.path.cutters.at(out.path.moves.front().cutter)};
    out.path.tools.clear();
    const auto feeds = feedsOf(path);
    for (simulation::ToolMove& move : out.path.moves) {
        move.cutter = 0;
        if (move.kind == toolpath::MotionKind::Rapid) {
            out.feed_mm_per_s.push_back(std::numeric_limits<double>::infinity());
            continue;
        }
        const auto after = std::ranges::upper_bound(feeds, move.line, {}, &std::pair<std::uint32_t, double>::first);
        if (after == feeds.begin() || !(std::prev(after)->second > 0.0))
            return base::fail("cut.no-feed", "the tool cuts before the path gives a feed",
                              {path.file_name, move.line, 0, {}});
        out.feed_mm_per_s.push_back(std::prev(after)->second);
    }
    return out;
}

base::Result<AxisTrack> idealTrack(const CutJob& job, const kinematics::Machine& machine, const CuttingSetup& setup) {
    const geometry::RigidTransform wcs_from_part = job.part_from_wcs.inverse();
    AxisFollower follower(machine, setup);
    AxisTrack out;
    double now_s = 0.0;
    for (std::size_t m = 0; m < job.path.moves.size(); ++m) {
        const simulation::ToolMove& move = job.path.moves[m];
        const auto from = moved(wcs_from_part, move.from);
        const auto to = moved(wcs_from_part, move.to);
        const auto begin = follower.rotaryFor(from.axis);
        const auto end = follower.rotaryFor(to.axis);
        const auto unreached = [&] {
            return base::fail("cut.not-reached",
                              fmt::format("machine {} cannot bring the tool there", machine.definition().name),
                              {{}, move.line, 0, {}});
        };
        if (!begin || !end) return unreached();
        const double length_mm = (to.tip_mm - from.tip_mm).norm();
        const double turn_rad = std::max(std::abs((*end)[0] - (*begin)[0]), std::abs((*end)[1] - (*begin)[1]));
        const double speed = std::isfinite(job.feed_mm_per_s[m]) ? job.feed_mm_per_s[m] : rapid_mm_per_s;
        const double duration_s = std::max(length_mm, dynamics::feed_radius_mm * turn_rad) / speed;
        const auto steps = static_cast<std::size_t>(
            std::max({1.0, std::ceil(length_mm / sample_mm), std::ceil(turn_rad / sample_rad)}));
        for (std::size_t i = out.size() == 0 ? 0 : 1; i <= steps; ++i) {
            const double share = static_cast<double>(i) / static_cast<double>(steps);
            const auto axes = follower.axesAt(
                from.tip_mm + share * (to.tip_mm - from.tip_mm),
                {(*begin)[0] + share * ((*end)[0] - (*begin)[0]), (*begin)[1] + share * ((*end)[1] - (*begin)[1])});
            if (!axes) return unreached();
            out.add(now_s + share * duration_s, *axes);
        }
        now_s += duration_s;
    }
    return out;
}

base::Result<AxisTrack> readTrack(std::istream& in, const std::string& name, const kinematics::Machine& machine) {
    std::string line;
    if (!std::getline(in, line)) return base::fail("track.empty", "the record is empty", {name, 0, 0, {}});
    if (line.ends_with('\r')) line.pop_back();
    const auto columns = columnsOf(line, name, machine);
    if (!columns) return base::fail(columns.error());
    AxisTrack out;
    for (std::size_t number = 2; std::getline(in, line); ++number) {
        if (line.ends_with('\r')) line.pop_back();
        if (line.empty()) continue;
        const auto values = numbersOf(line, *columns, name, number);
        if (!values) return base::fail(values.error());
        dynamics::AxisVector axes{};
        for (std::size_t i = 1; i < values->size(); ++i)
            axes.at(i - 1) = i <= 3 ? (*values)[i] : base::radFromDeg((*values)[i]);
        if (out.size() > 0 && (*values)[0] < out.time_s.back())
            return base::fail("track.number", "time runs backward", {name, number, 0, {}});
        out.add((*values)[0], axes);
    }
    if (out.size() < 2) return base::fail("track.empty", "the record has fewer than two samples", {name, 0, 0, {}});
    return out;
}

AxisTrack lagged(const AxisTrack& track, const dynamics::AxisVector& lag_s) {
    AxisTrack out = track;
    for (std::size_t a = 0; a < dynamics::max_axes; ++a) {
        const double lag = lag_s.at(a);
        if (lag <= 0.0) continue;
        double behind = 0.0;  // command less axis
        for (std::size_t i = 1; i < track.size(); ++i) {
            // lag·x' = command − x with a command that runs at `rate` from sample to sample.
            const double step_s = track.time_s[i] - track.time_s[i - 1];
            const double kept = std::exp(-step_s / lag);
            const double way = track.axes[i].at(a) - track.axes[i - 1].at(a);
            behind = behind * kept + (step_s > 0.0 ? lag * way / step_s * (1.0 - kept) : way);
            out.axes[i].at(a) = track.axes[i].at(a) - behind;
        }
    }
    return out;
}

simulation::CutterPath realPath(const AxisTrack& track, const RealMachine& machine, const geometry::Cutter& cutter,
                                const geometry::RigidTransform& part_from_wcs, double tolerance_mm,
                                std::vector<SampleSpan>* spans) {
    const AxisTrack done = lagged(track, machine.lag_s);
    std::vector<toolpath::CutterLocation> places(done.size());
    for (std::size_t i = 0; i < done.size(); ++i) places[i] = moved(part_from_wcs, machine.place(done.axes[i]));
    simulation::CutterPath out;
    out.cutters = {machine.cutter(cutter)};
    out.locations = places.size();
    constexpr std::size_t longest = 64;
    for (std::size_t from = 0; from + 1 < places.size();) {
        std::size_t to = from + 1;
        const auto straight = [&](std::size_t end) {
            for (std::size_t i = from + 1; i < end; ++i)
                if (offStraight(places[from], places[end], places[i]) > tolerance_mm) return false;
            return true;
        };
        while (to + 1 < places.size() && to + 1 - from <= longest && straight(to + 1)) ++to;
        if (!places[from].tip_mm.isApprox(places[to].tip_mm, 1e-15) ||
            !places[from].axis.isApprox(places[to].axis, 1e-15)) {
            out.moves.push_back({.from = places[from], .to = places[to]});
            if (spans != nullptr) spans->push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(to)});
        }
        from = to;
    }
    return out;
}

}  // namespace cusp::loop
