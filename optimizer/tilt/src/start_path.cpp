// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From the records of a CL file to the locations that are tilted.
#include <cusp/optimizer/tilt/tilted_path.hpp>
#include <cusp/simulation/tool_move.hpp>

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cusp::tilt {

using geometry::Vector3;
using toolpath::ClRecord;
using toolpath::LinearMotion;
using toolpath::MotionKind;

namespace {

constexpr double seconds_per_minute = 60.0;

class Reading {
public:
    Reading(const StartOptions& options, std::string file)
        : options_(options), cutter_(options.cutter), file_(std::move(file)) {}

    void take(const ClRecord& record) {
        std::visit([&](const auto& statement) { see(statement, record); }, record.statement);
    }
    [[nodiscard]] base::Result<StartPath> finish();

private:
    template <class T>
    void see(const T& /*statement*/, const ClRecord& record) {
        path_.records.push_back(record);
    }
    void see(const LinearMotion& motion, const ClRecord& record) { go(motion, record.line); }
    void see(const toolpath::ArcMotion& arc, const ClRecord& record) {
        if (path_.locations.empty()) return refuse(record, "an arc without a place to start from");
        // The chords are those of the simulation: one way to cut an arc into pieces.
        base::Diagnostics report;
        simulation::PathCollector collector(file_, options_.chord_tolerance_mm, report);
        collector.take(
            {toolpath::ToolCall{1, "arc", geometry::Cutter{1.0, 0.5, 0.0, 0.5, 0.0, 0.0, 1.0}}, record.line});
        collector.take({LinearMotion{path_.locations.back().location, MotionKind::Feed}, record.line});
        collector.take({arc, record.line});
        for (const simulation::ToolMove& move : collector.finish().moves) go({move.to, MotionKind::Feed}, record.line);
    }
    void see(const toolpath::FeedRate& feed, const ClRecord& record) {
        feed_ = feed;
        path_.records.push_back(record);
    }
    void see(const toolpath::SpindleCommand& spindle, const ClRecord& record) {
        if (spindle.speed && spindle.unit == toolpath::SpindleCommand::Unit::Rpm && path_.spindle_rpm <= 0.0)
            path_.spindle_rpm = *spindle.speed;
        path_.records.push_back(record);
    }
    void see(const toolpath::ToolCall& tool, const ClRecord& record) {
        if (std::exchange(has_tool_, true))
            return refuse(record, "a second tool; give each tool's path a job of its own");
        ClRecord written = record;
        if (tool.cutter) cutter_ = tool.cutter;
        std::get<toolpath::ToolCall>(written.statement).cutter = cutter_;
        tool_line_ = record.line;
        path_.records.push_back(written);
    }
    void see(const toolpath::ProgrammingFrame& frame, const ClRecord& record) {
        if (!frame.part_from_programming.isApprox(geometry::RigidTransform::Identity(), 1e-9))
            return refuse(record, "a programming frame that is not the part's");
        path_.records.push_back(record);
    }
    void see(const toolpath::CycleStart&, const ClRecord& record) { refuse(record, "a drilling cycle"); }
    void see(const toolpath::SplineMotion&, const ClRecord& record) { refuse(record, "a NURBS motion"); }
    void see(const toolpath::WorkPlane&, const ClRecord& record) { refuse(record, "a work plane"); }
    void see(const toolpath::HomeReturn&, const ClRecord& record) { refuse(record, "GOHOME"); }

    void go(const LinearMotion& motion, std::uint32_t line) {
        const bool feeds = motion.kind == MotionKind::Feed;
        const double feed = feed_.unit == toolpath::FeedRate::Unit::MmPerS
                                ? feed_.value
                                : feed_.value * path_.spindle_rpm / seconds_per_minute;
        if (feeds && !path_.locations.empty()) divide(path_.locations.back().location, motion.location, line, feed);
        path_.locations.push_back({motion.location, motion.kind, line, feeds ? feed : 0.0, 0.0, {}});
        path_.records.push_back({motion, line});
    }
    /// The axis of a three-axis path stands still.
    void divide(const toolpath::CutterLocation from, const toolpath::CutterLocation& to, std::uint32_t line,
                double feed) {
        const double length = (to.tip_mm - from.tip_mm).norm();
        const auto parts = static_cast<int>(std::ceil(length / options_.longest_cut_mm));
        for (int k = 1; k < parts; ++k) {
            const toolpath::CutterLocation at{
                from.tip_mm + (to.tip_mm - from.tip_mm) * (static_cast<double>(k) / parts), from.axis};
            path_.locations.push_back({at, MotionKind::Feed, line, feed, 0.0, {}});
            path_.records.push_back({LinearMotion{at, MotionKind::Feed}, line});
        }
    }
    void refuse(const ClRecord& record, const char* what) {
        report_.error("tilt.motion", fmt::format("{} cannot be tilted", what), {file_, record.line, 0, {}});
    }
    void placeLinks();

    StartPath path_;
    const StartOptions& options_;
    std::optional<geometry::Cutter> cutter_;
    std::string file_;
    toolpath::FeedRate feed_;
    bool has_tool_ = false;
    std::uint32_t tool_line_ = 0;
    base::Diagnostics report_;
};

/// A rapid move that ends straight above a cut, or begins there.
void Reading::placeLinks() {
    auto& all = path_.locations;
    const auto standsAbove = [&](std::size_t high, std::size_t low) {
        const Vector3 rise = all[high].location.tip_mm - all[low].location.tip_mm;
        constexpr double same_mm = 1e-6;
        return rise.z() > 0.0 && std::hypot(rise.x(), rise.y()) < same_mm &&
               all[high].location.axis.isApprox(Vector3::UnitZ(), 1e-9);
    };
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].kind != MotionKind::Rapid) continue;
        // Down to the cut in one or in several moves.
        std::size_t cut = i + 1;
        while (cut + 1 < all.size() && all[cut + 1].kind == MotionKind::Feed && standsAbove(cut, cut + 1)) ++cut;
        if (cut < all.size() && all[cut].kind == MotionKind::Feed && standsAbove(i, cut))
            for (std::size_t k = i; k < cut; ++k) all[k].above = static_cast<std::uint32_t>(cut);
        else if (i > 0 && all[i - 1].kind == MotionKind::Feed && standsAbove(i, i - 1))
            all[i].above = static_cast<std::uint32_t>(i - 1);
    }
}

base::Result<StartPath> Reading::finish() {
    if (report_.hasErrors()) return base::fail(std::move(report_));
    const base::Location place{file_, tool_line_, 0, {}};
    if (path_.locations.size() < 2) return base::fail("tilt.no-path", "the file holds no path", {file_, 0, 0, {}});
    if (!cutter_) return base::fail("tilt.not-a-ball", "neither the file nor the job says what the tool is", place);
    constexpr double rounding_mm = 1e-3;
    if (std::abs(cutter_->corner_radius_mm - cutter_->diameter_mm / 2.0) > rounding_mm)
        return base::fail("tilt.not-a-ball",
                          fmt::format("only a ball end mill leaves the same surface when it is tilted; this one has "
                                      "diameter {:g} mm and corner radius {:g} mm",
                                      cutter_->diameter_mm, cutter_->corner_radius_mm),
                          place);
    path_.cutter = *cutter_;
    placeLinks();
    const double length = path_.lengthMm();
    double way = 0.0;
    for (std::size_t i = 1; i < path_.locations.size(); ++i) {
        way += (path_.locations[i].location.tip_mm - path_.locations[i - 1].location.tip_mm).norm();
        path_.locations[i].share = length > 0.0 ? way / length : 0.0;
    }
    return std::move(path_);
}

}  // namespace

base::Result<StartPath> startPath(const std::vector<ClRecord>& records, const std::string& file,
                                  const StartOptions& options) {
    Reading reading(options, file);
    for (const ClRecord& record : records) reading.take(record);
    return reading.finish();
}

}  // namespace cusp::tilt
