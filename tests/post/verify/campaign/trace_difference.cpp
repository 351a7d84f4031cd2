// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Compares two traces where they differ, as sets of poses with a state each.
#include "paper_machine.hpp"

#include <cusp/base/units.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::post::verify::test {

namespace {

constexpr double tip_mm = 0.002;
constexpr double end_axis_rad = base::radFromDeg(0.002);
constexpr double way_axis_rad = base::radFromDeg(3.0);
constexpr double travel_deg = 60.0;

bool same(const TraceState& a, const TraceState& b) {
    const auto close = [](double x, double y) { return std::abs(x - y) <= 2e-3 * std::max(std::abs(x), std::abs(y)); };
    if (a.rapid != b.rapid || a.placed != b.placed || a.tool != b.tool || a.cutting_edge != b.cutting_edge ||
        a.work_offset != b.work_offset || a.plane != b.plane || std::abs(a.dwell_s - b.dwell_s) > 2e-3)
        return false;
    return a.rapid || (close(a.feed_mm_per_min, b.feed_mm_per_min) && a.spindle == b.spindle &&
                       std::abs(a.rpm - b.rpm) <= 0.6 && a.mist == b.mist && a.flood == b.flood);
}

bool identical(const TraceMotion& a, const TraceMotion& b) {
    if (!same(a.state, b.state) || a.poses.size() != b.poses.size() || a.rotary_travel_deg != b.rotary_travel_deg)
        return false;
    return std::equal(a.poses.begin(), a.poses.end(), b.poses.begin(),
                      [](const TracePose& p, const TracePose& q) { return p.tip_mm == q.tip_mm && p.axis == q.axis; });
}

struct Stretch {
    const TraceMotion* begin;
    const TraceMotion* end;
};

double length(const Stretch& stretch) {
    double sum = 0.0;
    for (const auto* motion = stretch.begin; motion != stretch.end; ++motion)
        for (std::size_t i = 1; i < motion->poses.size(); ++i)
            sum += (motion->poses[i].tip_mm - motion->poses[i - 1].tip_mm).norm();
    return sum;
}

double cutTravel(const Stretch& stretch) {
    double sum = 0.0;
    for (const auto* motion = stretch.begin; motion != stretch.end; ++motion)
        if (!motion->state.rapid) sum += motion->rotary_travel_deg;
    return sum;
}

/// The tool axis counts as a point on a sphere so large that its tolerance is that of the tip.
Eigen::Matrix<double, 6, 1> joined(const TracePose& pose, double axis_rad) {
    Eigen::Matrix<double, 6, 1> out;
    out << pose.tip_mm, tip_mm / axis_rad * pose.axis;
    return out;
}

/// Distance of a pose from a way, at most `tip_mm` of which lets it pass.
bool liesOn(const TracePose& pose, double axis_rad, const TraceState& state, const Stretch& stretch) {
    const auto point = joined(pose, axis_rad);
    for (const auto* motion = stretch.begin; motion != stretch.end; ++motion) {
        if (!same(state, motion->state)) continue;
        for (std::size_t i = 0; i < motion->poses.size(); ++i) {
            const auto from = joined(motion->poses[i == 0 ? 0 : i - 1], axis_rad);
            const Eigen::Matrix<double, 6, 1> way = joined(motion->poses[i], axis_rad) - from;
            const double square = way.squaredNorm();
            const double fraction = square > 0.0 ? std::clamp((point - from).dot(way) / square, 0.0, 1.0) : 0.0;
            if ((point - from - fraction * way).norm() <= tip_mm) return true;
        }
    }
    return false;
}

bool covers(const Stretch& way, const Stretch& stretch) {
    for (const auto* motion = stretch.begin; motion != stretch.end; ++motion) {
        const bool known = motion->state.placed && !motion->poses.empty();
        const bool state_met =
            std::any_of(way.begin, way.end, [&](const TraceMotion& other) { return same(motion->state, other.state); });
        if (!known || !state_met) return false;
        for (std::size_t i = 0; i < motion->poses.size(); ++i) {
            const bool end = i == 0 || i + 1 == motion->poses.size();
            if (!liesOn(motion->poses[i], end ? end_axis_rad : way_axis_rad, motion->state, way)) return false;
        }
    }
    return true;
}

}  // namespace

bool differ(const std::vector<TraceMotion>& first, const std::vector<TraceMotion>& second) {
    Stretch a{first.data(), first.data() + first.size()};
    Stretch b{second.data(), second.data() + second.size()};
    // One equal motion stays on either side: the place where the ways part.
    while (a.end - a.begin > 1 && b.end - b.begin > 1 && identical(*a.begin, *b.begin) &&
           identical(a.begin[1], b.begin[1])) {
        ++a.begin;
        ++b.begin;
    }
    while (a.end - a.begin > 1 && b.end - b.begin > 1 && identical(a.end[-1], b.end[-1]) &&
           identical(a.end[-2], b.end[-2])) {
        --a.end;
        --b.end;
    }
    if (a.begin == a.end || b.begin == b.end) return a.begin != a.end || b.begin != b.end;
    if (std::abs(length(a) - length(b)) > tip_mm || std::abs(cutTravel(a) - cutTravel(b)) > travel_deg) return true;
    return !covers(a, b) || !covers(b, a);
}

}  // namespace cusp::post::verify::test
