// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Engagement, turns, clearing and gouging measured on a path.
#include <cusp/optimizer/pocket/flat_path.hpp>

#include "swept_index.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cusp::pocket {
namespace {

constexpr double slack_mm = 1e-4;  ///< rims that touch a wall of an earlier sweep are not in material
constexpr double film_mm = 0.05;   ///< what is thinner before the rim is no engagement
constexpr int rim_samples = 180;   ///< over the front half

class Rim {
public:
    Rim(const RegionIndex& material, const SweptIndex& swept, double radius_mm)
        : material_(material), swept_(swept), radius_mm_(radius_mm) {}

    /// Degrees of the front half of the rim that are in material, the tool at `at` on its way along (dx, dy) from `from`.
    [[nodiscard]] double engagedDeg(const Point& at, const Point& from, double heading) const {
        const auto is_there = [&](double angle, double radius_mm) {
            const Point p{at.x_mm + radius_mm * std::cos(heading + angle),
                          at.y_mm + radius_mm * std::sin(heading + angle)};
            // Its own way up to here: the front half lies outside of it but at its very sides.
            return material_.contains(p) && !swept_.covers(p, slack_mm) &&
                   distanceToSegment(p, from, at) > radius_mm_ - slack_mm;
        };
        const auto in_material = [&](double angle) {
            return is_there(angle, radius_mm_) && is_there(angle, radius_mm_ + film_mm);
        };
        const double step = std::numbers::pi / rim_samples;
        double engaged = 0.0;
        double before_angle = -std::numbers::pi / 2.0 + 1e-4;
        bool before = in_material(before_angle);
        for (int i = 1; i <= rim_samples; ++i) {
            const double angle = i == rim_samples ? std::numbers::pi / 2.0 - 1e-4 : -std::numbers::pi / 2.0 + i * step;
            const bool now = in_material(angle);
            if (now && before) engaged += angle - before_angle;
            if (now != before) {
                double low = before_angle;
                double high = angle;
                while (high - low > 1e-4) (in_material((low + high) / 2.0) == before ? low : high) = (low + high) / 2.0;
                engaged += before ? low - before_angle : angle - high;
            }
            before = now;
            before_angle = angle;
        }
        return engaged * 180.0 / std::numbers::pi;
    }

private:
    const RegionIndex& material_;
    const SweptIndex& swept_;
    double radius_mm_;
};

bool isFeed(const FlatStep& step) { return step.kind == StepKind::Cut || step.kind == StepKind::Link; }

double lengthOf(const Point& a, const Point& b) { return std::hypot(b.x_mm - a.x_mm, b.y_mm - a.y_mm); }

Point between(const Point& a, const Point& b, double t) {
    return {a.x_mm + t * (b.x_mm - a.x_mm), a.y_mm + t * (b.y_mm - a.y_mm)};
}

void sweepHelix(SweptIndex& swept, const FlatStep& helix) {
    constexpr int parts = 72;
    const auto on = [&](int i) {
        const double angle = 2.0 * std::numbers::pi * i / parts;
        return Point{helix.to.x_mm + helix.helix_radius_mm * std::cos(angle),
                     helix.to.y_mm + helix.helix_radius_mm * std::sin(angle)};
    };
    for (int i = 0; i < parts; ++i) swept.add(on(i), on(i + 1));
    swept.add(helix.to, on(0));
}

}  // namespace

Engagement measureEngagement(const FlatPath& path, const PocketArea& area, double limit_deg, double spacing_mm) {
    const RegionIndex material(area.material);
    SweptIndex swept(area.radius_mm);
    const Rim rim(material, swept, area.radius_mm);
    Engagement out;
    Point at = path.start;
    double above = 0.0;
    for (const FlatStep& step : path.steps) {
        const double length = lengthOf(at, step.to);
        double most = 0.0;
        if (!isFeed(step)) {
            out.rapid_mm += length;
            if (step.kind == StepKind::Helix) sweepHelix(swept, step);
            at = step.to;
            out.step_max_deg.push_back(0.0);
            continue;
        }
        const double heading = std::atan2(step.to.y_mm - at.y_mm, step.to.x_mm - at.x_mm);
        const auto parts = std::max(1, static_cast<int>(std::ceil(length / spacing_mm)));
        for (int i = 1; i <= parts; ++i) {
            const Point here = between(at, step.to, static_cast<double>(i) / parts);
            const double engaged = rim.engagedDeg(here, at, heading);
            most = std::max(most, engaged);
            (engaged > 0.05 ? out.cut_length_mm : out.air_cut_mm) += length / parts;
            out.mean_deg += engaged * length / parts;
            if (engaged > limit_deg) above += length / parts;
        }
        out.max_deg = std::max(out.max_deg, most);
        out.step_max_deg.push_back(most);
        swept.add(at, step.to);
        at = step.to;
    }
    if (out.cut_length_mm > 0.0) {
        out.mean_deg /= out.cut_length_mm;
        out.share_above_limit = above / out.cut_length_mm;
    }
    return out;
}

std::size_t turnsOf(const FlatPath& path) {
    std::size_t turns = 0;
    Point before = path.start;
    Point at = path.start;
    bool moving = false;
    for (const FlatStep& step : path.steps) {
        if (isFeed(step) && moving) {
            const double ax = at.x_mm - before.x_mm;
            const double ay = at.y_mm - before.y_mm;
            const double bx = step.to.x_mm - at.x_mm;
            const double by = step.to.y_mm - at.y_mm;
            const double scale = std::hypot(ax, ay) * std::hypot(bx, by);
            if (std::abs(ax * by - ay * bx) > 1e-6 * scale || ax * bx + ay * by < 0.0) ++turns;
        }
        moving = isFeed(step);
        before = at;
        at = step.to;
    }
    return turns;
}

double unclearedArea(const FlatPath& path, const PocketArea& area, double cell_mm) {
    SweptIndex swept(area.radius_mm);
    Point at = path.start;
    for (const FlatStep& step : path.steps) {
        if (step.kind == StepKind::Helix) sweepHelix(swept, step);
        if (isFeed(step)) swept.add(at, step.to);
        at = step.to;
    }
    const RegionIndex coverable(area.coverable);
    const Box box = boxOf(area.coverable);
    double left = 0.0;
    for (double y = box.low.y_mm + cell_mm / 2.0; y < box.high.y_mm; y += cell_mm)
        for (double x = box.low.x_mm + cell_mm / 2.0; x < box.high.x_mm; x += cell_mm)
            if (coverable.contains({x, y}) && !swept.covers({x, y}, 0.005)) left += cell_mm * cell_mm;
    return left;
}

double gougeOf(const FlatPath& path, const PocketArea& area) {
    const RegionIndex allowed(area.allowed);
    double out = 0.0;
    Point at = path.start;
    for (const FlatStep& step : path.steps) {
        if (isFeed(step)) {
            const auto parts = std::max(1, static_cast<int>(std::ceil(lengthOf(at, step.to) / 0.2)));
            for (int i = 0; i <= parts; ++i) {
                const Point here = between(at, step.to, static_cast<double>(i) / parts);
                if (!allowed.contains(here)) out = std::max(out, allowed.distanceToEdge(here));
            }
        }
        at = step.to;
    }
    return out;
}

}  // namespace cusp::pocket
