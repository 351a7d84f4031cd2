// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Options, links between passes, and the CL file.
#include "dropped_line.hpp"

#include <cusp/base/units.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cusp::tilt {

using geometry::Vector3;
using toolpath::MotionKind;

namespace {

/// From the end of one pass to the start of the next: never below where the cutter stops, and empty where it would leave
/// the shape or the area.
Pass linkOver(const DropShape& shape, const Vector3& from, const Vector3& to, const ThreeAxisOptions& options) {
    const double length = std::hypot(to.x() - from.x(), to.y() - from.y());
    if ((to - from).norm() > options.link_mm) return {};
    const auto parts = std::max(2, static_cast<int>(std::ceil(length / options.sample_mm)));
    Pass link;
    for (int k = 1; k < parts; ++k) {
        const Vector3 straight = from + (to - from) * (static_cast<double>(k) / parts);
        const auto contact = shape.drop(straight.x(), straight.y());
        if (!contact) return {};
        link.emplace_back(straight.x(), straight.y(), std::max(straight.z(), contact->tip_z_mm));
    }
    return link;
}

}  // namespace

bool PathArea::contains(double x_mm, double y_mm) const {
    constexpr double rounding_mm = 1e-9;
    const std::array<double, 2> at = {x_mm, y_mm};
    for (std::size_t k = 0; k < 2; ++k) {
        if (min_mm && at[k] < (*min_mm)[k] - rounding_mm) return false;
        if (max_mm && at[k] > (*max_mm)[k] + rounding_mm) return false;
    }
    const double distance = std::hypot(x_mm - center_mm[0], y_mm - center_mm[1]);
    if (radius_mm && distance > *radius_mm + rounding_mm) return false;
    return !inner_radius_mm || distance >= *inner_radius_mm - rounding_mm;
}

std::size_t ThreeAxisPath::locations() const {
    std::size_t count = 0;
    for (const Pass& pass : passes) count += pass.size();
    return count;
}

base::Diagnostics ThreeAxisOptions::check() const {
    base::Diagnostics report;
    const auto above_zero = [&report](const char* name, double value) {
        if (!(value > 0.0 && std::isfinite(value)))
            report.error("tilt.option", fmt::format("{} is {}; it must be above 0", name, value));
    };
    above_zero("step_over_mm", step_over_mm);
    above_zero("step_down_mm", step_down_mm);
    above_zero("sample_mm", sample_mm);
    above_zero("tolerance_mm", tolerance_mm);
    above_zero("clearance_mm", clearance_mm);
    above_zero("feed_mm_per_min", base::mmPerMinFromMmPerS(feed_mm_per_s));
    above_zero("plunge_feed_mm_per_min", base::mmPerMinFromMmPerS(plunge_feed_mm_per_s));
    above_zero("spindle_rpm", spindle_rpm);
    if (highest_mm && lowest_mm && *lowest_mm >= *highest_mm)
        report.error("tilt.option",
                     fmt::format("lowest_mm is {}; it must lie below highest_mm, {}", *lowest_mm, *highest_mm));
    for (std::size_t k = 0; k < 2; ++k)
        if (area.min_mm && area.max_mm && (*area.min_mm)[k] >= (*area.max_mm)[k])
            report.error("tilt.option", fmt::format("area: min_mm {} must lie below max_mm {} along {}",
                                                    (*area.min_mm)[k], (*area.max_mm)[k], k == 0 ? "X" : "Y"));
    if (area.radius_mm) above_zero("area.radius_mm", *area.radius_mm);
    if (area.radius_mm && area.inner_radius_mm && *area.inner_radius_mm >= *area.radius_mm)
        report.error("tilt.option", fmt::format("area: inner_radius_mm is {}; it must be below radius_mm, {}",
                                                *area.inner_radius_mm, *area.radius_mm));
    return report;
}

base::Result<ThreeAxisPath> planThreeAxis(const DropShape& shape, const ThreeAxisOptions& options) {
    if (base::Diagnostics report = options.check(); report.hasErrors()) return base::fail(std::move(report));
    ThreeAxisPath path;
    path.clearance_z_mm = shape.bounds().max().z() + options.clearance_mm;
    const auto passes = options.strategy == ThreeAxisOptions::Strategy::ZigZag ? detail::zigZagPasses(shape, options)
                                                                               : detail::zLevelPasses(shape, options);
    for (const Pass& pass : passes) {
        if (!path.passes.empty()) {
            Pass& before = path.passes.back();
            const Pass link = linkOver(shape, before.back(), pass.front(), options);
            if (!link.empty()) {
                before.insert(before.end(), link.begin(), link.end());
                before.insert(before.end(), pass.begin(), pass.end());
                continue;
            }
        }
        path.passes.push_back(pass);
    }
    if (path.passes.empty())
        return base::fail("tilt.no-path", "the cutter meets the part nowhere in the area of the path");
    return path;
}

std::vector<toolpath::ClRecord> clRecords(const ThreeAxisPath& path, const ThreeAxisOptions& options,
                                          const std::string& name, const toolpath::ToolCall& tool) {
    std::vector<toolpath::ClRecord> records;
    const auto add = [&records](toolpath::ClStatement statement) {
        records.push_back({std::move(statement), static_cast<std::uint32_t>(records.size() + 1)});
    };
    const auto go = [&add](const Vector3& tip, MotionKind kind) {
        add(toolpath::LinearMotion{{tip, Vector3::UnitZ()}, kind});
    };
    const auto feed = [&add](double mm_per_s) { add(toolpath::FeedRate{mm_per_s, toolpath::FeedRate::Unit::MmPerS}); };
    const auto above = [&path](const Vector3& tip) { return Vector3(tip.x(), tip.y(), path.clearance_z_mm); };
    add(toolpath::Remark{toolpath::Remark::Kind::PartName, name});
    add(tool);
    add(toolpath::SpindleCommand{toolpath::SpindleCommand::Turn::Clockwise, options.spindle_rpm,
                                 toolpath::SpindleCommand::Unit::Rpm});
    for (const Pass& pass : path.passes) {
        go(above(pass.front()), MotionKind::Rapid);
        feed(options.plunge_feed_mm_per_s);
        go(pass.front(), MotionKind::Feed);
        feed(options.feed_mm_per_s);
        for (std::size_t i = 1; i < pass.size(); ++i) go(pass[i], MotionKind::Feed);
        go(above(pass.back()), MotionKind::Rapid);
    }
    add(toolpath::ProgramEnd{});
    return records;
}

const base::Section<ThreeAxisOptions>& threeAxisSection() {
    static const auto area =
        base::Section<PathArea>("The part of the XY plane in which the tip may cut; what is absent does not restrict.")
            .field("min_mm", &PathArea::min_mm, "Lower corner of a rectangle.")
            .field("max_mm", &PathArea::max_mm, "Upper corner of it.")
            .field("center_mm", &PathArea::center_mm, "Of the circles.")
            .field("radius_mm", &PathArea::radius_mm, "Not outside this circle.")
            .field("inner_radius_mm", &PathArea::inner_radius_mm, "Not inside this circle.");
    constexpr base::FieldRules above_zero = base::positive();
    constexpr base::FieldRules not_negative{.min = 0.0};
    using Options = ThreeAxisOptions;
    static const auto section =
        base::Section<Options>("The three-axis finishing path to start from, made by dropping the cutter on the part.")
            .choice("strategy", &Options::strategy,
                    {{"zig-zag", Options::Strategy::ZigZag}, {"z-level", Options::Strategy::ZLevel}},
                    "Parallel rows, or contours at equal heights.")
            .field("step_over_mm", &Options::step_over_mm, "Between the rows of a zig-zag.", above_zero)
            .field("step_down_mm", &Options::step_down_mm, "Between z-levels.", above_zero)
            .field("direction_deg", &Options::direction_rad, "Of the rows, from +X towards +Y.")
            .field("sample_mm", &Options::sample_mm, "The part is looked at as densely as this at least.", above_zero)
            .field("tolerance_mm", &Options::tolerance_mm,
                   "How far straight moves may miss what the dropped cutter follows.", above_zero)
            .field("highest_mm", &Options::highest_mm, "Z-levels: where they begin; absent: the part's highest point.")
            .field("lowest_mm", &Options::lowest_mm, "Z-levels: where they end; absent: the part's lowest point.")
            .field("link_mm", &Options::link_mm,
                   "Passes whose ends are nearer than this are linked at feed over the part.", not_negative)
            .field("clearance_mm", &Options::clearance_mm, "Of rapid moves above the part.", above_zero)
            .field("feed_mm_per_min", &Options::feed_mm_per_s, "Feed of the cuts.", above_zero)
            .field("plunge_feed_mm_per_min", &Options::plunge_feed_mm_per_s, "Feed down to a cut.", above_zero)
            .field("spindle_rpm", &Options::spindle_rpm, "Speed of the spindle.", above_zero)
            .table("area", &Options::area, area);
    return section;
}

}  // namespace cusp::tilt
