// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Lays the grooves out and writes path, nominal and points.
#include <cusp/loop/artefact.hpp>

#include <cusp/base/number_text.hpp>
#include <cusp/base/units.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cusp::loop {
namespace {

/// A plane of the block: its middle, along the grooves, across them, out of the material.
struct Plane {
    Vector3 middle;
    Vector3 along;
    Vector3 across;
    Vector3 normal;
    double room_mm = 0.0;  ///< across
};

std::vector<Plane> planesOf(const ArtefactOptions& o) {
    std::vector<Plane> out;
    out.push_back(
        {{0.0, 0.0, o.height_mm}, Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ(), 2.0 * o.half_width_mm});
    const double half = std::numbers::sqrt2 / 2.0;
    for (int i = 0; i < 4; ++i) {
        const double angle = std::numbers::pi / 2.0 * i;
        const Vector3 outward(std::round(std::cos(angle)), std::round(std::sin(angle)), 0.0);
        const Vector3 along = Vector3::UnitZ().cross(outward);
        out.push_back(
            {outward * (o.half_width_mm + o.side_mm / 2.0) + Vector3::UnitZ() * (o.height_mm - o.side_mm / 2.0), along,
             half * (outward - Vector3::UnitZ()), half * (outward + Vector3::UnitZ()),
             o.side_mm * std::numbers::sqrt2});
    }
    return out;
}

/// Upright, and leaning to eight sides: half as far and all the way to four, three quarters to the four between.
std::vector<Vector3> tiltsOf(double largest_rad) {
    const auto leaning = [](double tilt, double around) {
        return Vector3(std::sin(tilt) * std::cos(around), std::sin(tilt) * std::sin(around), std::cos(tilt));
    };
    std::vector<Vector3> out{Vector3::UnitZ()};
    for (int i = 0; i < 4; ++i) {
        const double around = std::numbers::pi / 2.0 * i;
        out.push_back(leaning(0.5 * largest_rad, around));
        out.push_back(leaning(largest_rad, around));
        out.push_back(leaning(0.75 * largest_rad, around + std::numbers::pi / 4.0));
    }
    return out;
}

std::string faceText(const Plane& plane, double half_along, double half_across) {
    const Vector3 corner = plane.middle - half_along * plane.along - half_across * plane.across;
    const auto terms = [&](int c) {
        std::string out = fmt::format("\"1\" = {}", base::formatShortest(corner[c]));
        const double u = 2.0 * half_along * plane.along[c];
        const double v = 2.0 * half_across * plane.across[c];
        if (std::abs(u) > 1e-12) out += fmt::format(", \"u\" = {}", base::formatShortest(u));
        if (std::abs(v) > 1e-12) out += fmt::format(", \"v\" = {}", base::formatShortest(v));
        return out;
    };
    const bool right_handed = plane.along.cross(plane.across).dot(plane.normal) > 0.0;
    return fmt::format(
        "\n[[face]]\nform = \"polynomial\"\noutward = \"{}\"\nx_mm = {{ {} }}\ny_mm = {{ {} }}\nz_mm = {{ {} }}\n",
        right_handed ? "du x dv" : "dv x du", terms(0), terms(1), terms(2));
}

class PathWriter {
public:
    explicit PathWriter(const ArtefactOptions& options) : options_(options) {
        out_.file_name = "artefact.apt";
        out_.dialect = toolpath::Dialect::Apt;
        const double radius = options.ball_diameter_mm / 2.0;
        add(toolpath::Remark{.kind = toolpath::Remark::Kind::PartName, .text = "CALIBRATION ARTEFACT"});
        toolpath::ToolCall tool;
        tool.number = 1;
        tool.name = "BALL";
        tool.cutter = geometry::Cutter{.diameter_mm = options.ball_diameter_mm,
                                       .corner_radius_mm = radius,
                                       .corner_f_mm = radius,
                                       .cutting_height_mm = 4.0 * options.ball_diameter_mm};
        add(tool);
        add(toolpath::SpindleCommand{.turn = toolpath::SpindleCommand::Turn::Clockwise, .speed = options.spindle_rpm});
        add(toolpath::FeedRate{.value = base::mmPerSFromMmPerMin(options.feed_mm_per_min)});
    }

    void groove(const Vector3& from, const Vector3& to, const Vector3& normal, const Vector3& axis) {
        const double radius = options_.ball_diameter_mm / 2.0;
        const Vector3 to_tip = radius * (normal - axis);
        const Vector3 begin = from + to_tip;
        const Vector3 end = to + to_tip;
        constexpr double retract_mm = 10.0;
        const double clear_mm = options_.height_mm + options_.ball_diameter_mm + 40.0;
        const Vector3 above_begin = begin + retract_mm * normal;
        const Vector3 above_end = end + retract_mm * normal;
        go({above_begin.x(), above_begin.y(), clear_mm}, axis, toolpath::MotionKind::Rapid);
        go(above_begin, axis, toolpath::MotionKind::Rapid);
        go(begin, axis, toolpath::MotionKind::Feed);
        go(end, axis, toolpath::MotionKind::Feed);
        go(above_end, axis, toolpath::MotionKind::Rapid);
        go({above_end.x(), above_end.y(), clear_mm}, axis, toolpath::MotionKind::Rapid);
    }
    toolpath::ToolPath finish() {
        add(toolpath::SpindleCommand{.turn = toolpath::SpindleCommand::Turn::Off, .speed = {}});
        add(toolpath::ProgramEnd{});
        return std::move(out_);
    }

private:
    void go(const Vector3& tip, const Vector3& axis, toolpath::MotionKind kind) {
        add(toolpath::LinearMotion{.location = {.tip_mm = tip, .axis = axis}, .kind = kind});
    }
    void add(toolpath::ClStatement statement) {
        out_.records.push_back(
            {.statement = std::move(statement), .line = static_cast<std::uint32_t>(out_.records.size() + 1)});
    }
    ArtefactOptions options_;
    toolpath::ToolPath out_;
};

base::Result<void> check(const ArtefactOptions& o) {
    base::Diagnostics report;
    const auto need = [&](bool good, const char* what) {
        if (!good) report.error("artefact.option", what);
    };
    need(o.ball_diameter_mm > 2.0 && o.ball_diameter_mm <= 20.0, "the ball must be above 2 and at most 20 mm");
    need(o.spacing_mm >= 0.3 * o.ball_diameter_mm, "grooves nearer than 0.3 ball diameters would run into each other");
    need(o.groove_mm > 2.0 * o.point_mm && o.point_mm > 0.0, "a groove must be longer than two steps of points");
    need(o.groove_mm <= 2.0 * o.half_width_mm, "a groove must not be longer than the top is wide");
    need(o.side_mm > 3.0 * o.spacing_mm && o.side_mm < o.height_mm,
         "the sides must have room for four grooves and end above the ground");
    need(o.largest_tilt_rad > 0.1 && o.largest_tilt_rad <= 1.05, "the largest tilt must lie between 6 and 60°");
    need(o.feed_mm_per_min > 0.0 && o.spindle_rpm > 0.0, "feed and speed must be above 0");
    if (report.hasErrors()) return base::fail(std::move(report));
    return {};
}

}  // namespace

base::Result<Artefact> planArtefact(const ArtefactOptions& options) {
    if (const auto ok = check(options); !ok) return base::fail(ok.error());
    Artefact out;
    out.surface_toml = "schema = 1\nname = \"Calibration artefact\"\ndescription = \"Five planes of a hipped block\"\n";
    PathWriter path(options);
    const std::vector<Vector3> tilts = tiltsOf(options.largest_tilt_rad);
    constexpr double least_cosine = 0.35;  // 70° from the plane's normal
    for (const Plane& plane : planesOf(options)) {
        out.surface_toml += faceText(plane, options.half_width_mm, plane.room_mm / 2.0);
        std::vector<Vector3> used;
        for (const Vector3& tilt : tilts)
            if (tilt.dot(plane.normal) >= least_cosine) used.push_back(tilt);
        const auto room = static_cast<std::size_t>((plane.room_mm - options.spacing_mm) / options.spacing_mm) + 1;
        // Where there is no room for all, every so many of them: both lean and side stay mixed.
        const std::size_t count = std::min(room, used.size());
        for (std::size_t k = 0; k < count; ++k) {
            const Vector3& axis = used[k * used.size() / count];
            const double at = options.spacing_mm * (static_cast<double>(k) - (static_cast<double>(count) - 1.0) / 2.0);
            const Vector3 middle = plane.middle + at * plane.across;
            const double turn = k % 2 == 0 ? 1.0 : -1.0;
            const Vector3 half = turn * options.groove_mm / 2.0 * plane.along;
            path.groove(middle - half, middle + half, plane.normal, axis);
            const double reach = options.groove_mm / 2.0 - options.point_mm / 2.0;
            for (double s = -reach; s <= reach + 1e-9; s += options.point_mm)
                out.plan.targets.push_back({.position = middle + s * plane.along,
                                            .normal = plane.normal,
                                            .section = static_cast<std::int32_t>(out.grooves)});
            out.plan.section_labels.push_back(fmt::format("groove {}", out.grooves + 1));
            ++out.grooves;
        }
    }
    out.path = path.finish();
    return out;
}

std::string planTable(const CmmPlan& plan) {
    std::string out = "# surface points to be touched, mm\nsection,x_mm,y_mm,z_mm,i,j,k\n";
    constexpr int decimals = 6;
    for (const CmmTarget& target : plan.targets) {
        out += target.section >= 0 ? plan.section_labels[static_cast<std::size_t>(target.section)] : std::string();
        for (const Vector3& v : {target.position, target.normal})
            for (int c = 0; c < 3; ++c) out += "," + base::formatFixed(v[c], decimals);
        out += "\n";
    }
    return out;
}

}  // namespace cusp::loop
