// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Entries, exits and links between passes.
#include <cusp/optimizer/finishing/finishing_path.hpp>
#include <cusp/simulation/cutter_body.hpp>
#include <cusp/simulation/surface_grid.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace cusp::finishing {

namespace {

using toolpath::CutterLocation;
using toolpath::MotionKind;

/// Points this far apart stand for the part when links are checked.
constexpr double guard_spacing_mm = 2.0;

CutterLocation shifted(const CutterLocation& location, const Vector3& by) {
    return {location.tip_mm + by, location.axis};
}

/// Keeps links off the part.
class LinkGuard {
public:
    LinkGuard(const Workpiece& part, const geometry::Cutter& cutter) {
        if (auto body = simulation::CutterBody::make(cutter)) body_ = *body;
        for (const auto& point : simulation::surfaceGrid(part.faces, guard_spacing_mm).points)
            points_.push_back(point.position);
    }

    /// Whether the cutter keeps `margin_mm` to the part on the straight way between two locations.
    [[nodiscard]] bool clear(const CutterLocation& from, const CutterLocation& to, double margin_mm) const {
        const auto parts =
            static_cast<int>(std::clamp((to.tip_mm - from.tip_mm).norm() / guard_spacing_mm, 2.0, 200.0));
        for (int i = 0; i <= parts; ++i) {
            const double x = static_cast<double>(i) / parts;
            const CutterLocation here{from.tip_mm + x * (to.tip_mm - from.tip_mm),
                                      (from.axis + x * (to.axis - from.axis)).normalized()};
            if (!clearAt(here, margin_mm)) return false;
        }
        return true;
    }
    [[nodiscard]] double highest(const Vector3& up) const {
        double out = -std::numeric_limits<double>::infinity();
        for (const Vector3& point : points_) out = std::max(out, up.dot(point));
        return out;
    }

private:
    [[nodiscard]] bool clearAt(const CutterLocation& at, double margin_mm) const {
        if (!body_) return false;
        const double reach = body_->largestRadius() + margin_mm;
        for (const Vector3& point : points_) {
            const Vector3 away = point - at.tip_mm;
            const double z = away.dot(at.axis);
            if (z < -margin_mm || z > body_->height() + margin_mm) continue;
            const double rho_squared = away.squaredNorm() - z * z;
            if (rho_squared < reach * reach &&
                body_->at(std::sqrt(std::max(0.0, rho_squared)), z).distance_mm < margin_mm)
                return false;
        }
        return true;
    }

    std::optional<simulation::CutterBody> body_;
    std::vector<Vector3> points_;
};

class Joiner {
public:
    Joiner(FinishingPath& path, const Workpiece& part)
        : path_(path),
          links_(path.contacts.options.links),
          up_(geometry::toVector(links_.up).normalized()),
          guard_(part, path.contacts.cutter) {
        level_ = guard_.highest(up_) + links_.clearance_mm;
    }

    void join() {
        for (std::uint32_t k = 0; k < path_.contacts.passes; ++k) {
            const auto pass = path_.contacts.pass(k);
            if (pass.empty()) continue;
            const CutterLocation start = shifted(pass.front().location, -links_.run_in_mm * pass.front().frame.feed);
            enter(start);
            const auto first = static_cast<std::uint32_t>(pass.data() - path_.contacts.points.data());
            if (links_.run_in_mm > 0.0) feedTo(start, links_.approach_feed_mm_per_s, PathMove::no_contact);
            for (std::uint32_t i = 0; i < pass.size(); ++i)
                feedTo(pass[i].location,
                       i == 0 && links_.run_in_mm <= 0.0 ? links_.approach_feed_mm_per_s
                                                         : path_.contacts.options.feed_mm_per_s,
                       first + i);
            if (links_.run_out_mm > 0.0)
                feedTo(shifted(pass.back().location, links_.run_out_mm * pass.back().frame.feed),
                       path_.contacts.options.feed_mm_per_s, PathMove::no_contact);
            end_ = path_.moves.back().location;
        }
        if (end_) {
            rapidTo(lifted(*end_, links_.lift_mm));
            rapidTo(high(*end_));
        }
    }

private:
    static CutterLocation lifted(const CutterLocation& location, double by_mm) {
        return shifted(location, by_mm * location.axis);
    }
    /// On the clearance plane: along the tool axis, or straight up where that leads nowhere.
    [[nodiscard]] CutterLocation high(const CutterLocation& location) const {
        constexpr double steepest = 0.3;
        const double climb = location.axis.dot(up_);
        const Vector3 way = climb > steepest ? Vector3(location.axis / climb) : up_;
        return shifted(location, std::max(links_.lift_mm, level_ - location.tip_mm.dot(up_)) * way);
    }

    void enter(const CutterLocation& start) {
        if (end_) {
            if (!enterNearby(start)) {
                ++path_.long_links;
                rapidTo(lifted(*end_, links_.lift_mm));
                rapidTo(high(*end_));
            } else {
                return;
            }
        }
        rapidTo(high(start));
        rapidTo(lifted(start, links_.lift_mm));
    }
    [[nodiscard]] bool enterNearby(const CutterLocation& start) {
        constexpr double most_lifts = 8.0;
        for (double lift = links_.lift_mm; lift <= most_lifts * links_.lift_mm; lift *= 2.0) {
            const CutterLocation from = lifted(*end_, lift);
            const CutterLocation to = lifted(start, lift);
            // Half the lift: at both ends the tool stands lift · cos(lead) off the surface, and less beside a hollow.
            if (!guard_.clear(from, to, links_.lift_mm / 2.0)) continue;
            rapidTo(from);
            rapidTo(to);
            if (lift > links_.lift_mm) rapidTo(lifted(start, links_.lift_mm));
            return true;
        }
        return false;
    }

    void rapidTo(const CutterLocation& location) {
        path_.moves.push_back({location, MotionKind::Rapid, 0.0, PathMove::no_contact});
    }
    void feedTo(const CutterLocation& location, double feed_mm_per_s, std::uint32_t contact) {
        path_.moves.push_back({location, MotionKind::Feed, feed_mm_per_s, contact});
    }

    FinishingPath& path_;
    const LinkOptions& links_;
    Vector3 up_;
    LinkGuard guard_;
    double level_ = 0.0;
    std::optional<CutterLocation> end_;  ///< where the pass before left the surface
};

}  // namespace

FinishingPath joinPasses(ContactPath contacts, const Workpiece& part) {
    FinishingPath path;
    path.contacts = std::move(contacts);
    Joiner(path, part).join();
    return path;
}

simulation::CutterPath cutterPath(const FinishingPath& path) {
    simulation::CutterPath out;
    out.cutters = {path.contacts.cutter};
    out.locations = path.moves.size();
    for (std::size_t i = 1; i < path.moves.size(); ++i)
        out.moves.push_back({path.moves[i - 1].location, path.moves[i].location, path.moves[i].kind,
                             static_cast<std::uint32_t>(i + 1), 0});
    return out;
}

toolpath::ToolPath clFile(const FinishingPath& path, const ClHeading& heading) {
    toolpath::ToolPath out;
    out.dialect = toolpath::Dialect::Apt;
    const auto put = [&](toolpath::ClStatement statement) { out.records.push_back({std::move(statement), 0}); };
    if (!heading.part_name.empty()) put(toolpath::Remark{toolpath::Remark::Kind::PartName, heading.part_name});
    if (!heading.remark.empty()) put(toolpath::Remark{toolpath::Remark::Kind::Message, heading.remark});
    put(toolpath::ToolCall{heading.tool.number.value_or(1), heading.tool.name, path.contacts.cutter});
    if (heading.spindle_rpm > 0.0)
        put(toolpath::SpindleCommand{toolpath::SpindleCommand::Turn::Clockwise, heading.spindle_rpm,
                                     toolpath::SpindleCommand::Unit::Rpm});
    if (heading.coolant) put(toolpath::CoolantCommand{toolpath::CoolantCommand::Kind::Flood});
    double feed = 0.0;
    for (const PathMove& move : path.moves) {
        if (move.kind == MotionKind::Feed && move.feed_mm_per_s != feed) {
            feed = move.feed_mm_per_s;
            put(toolpath::FeedRate{feed, toolpath::FeedRate::Unit::MmPerS});
        }
        put(toolpath::LinearMotion{move.location, move.kind});
    }
    if (heading.coolant) put(toolpath::CoolantCommand{toolpath::CoolantCommand::Kind::Off});
    if (heading.spindle_rpm > 0.0) put(toolpath::SpindleCommand{});
    put(toolpath::ProgramEnd{});
    return out;
}

}  // namespace cusp::finishing
