// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The forward step along a pass, by bisection or greedily.
#include "lead_profile.hpp"

#include <cusp/optimizer/finishing/contact_path.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cusp::finishing {

namespace {

constexpr std::size_t most_points = 5'000'000;

double distanceToChord(const Vector3& point, const Vector3& from, const Vector3& to) {
    const Vector3 chord = to - from;
    const double length = chord.squaredNorm();
    const double share = length > 0.0 ? std::clamp(chord.dot(point - from) / length, 0.0, 1.0) : 0.0;
    return (point - from - share * chord).norm();
}

class Walk {
public:
    Walk(const PassCurve& pass, const geometry::Cutter& cutter, const PlanOptions& options)
        : pass_(pass), cutter_(cutter), options_(options), profile_(pass, cutter, options.orientation) {}

    [[nodiscard]] std::vector<double> steps() const {
        std::vector<double> out{0.0};
        if (options_.steps.method == StepOptions::Method::Bisection)
            bisect(0.0, 1.0, 0, out);
        else
            goGreedily(out);
        return out;
    }

    [[nodiscard]] ContactPoint at(double t) const {
        const PassPoint point = pass_.at(t);
        ContactPoint out;
        out.position = point.surface.position;
        out.frame = point.frame;
        out.uv = point.uv;
        out.face = pass_.faceIndex();
        out.lead_rad = profile_.at(t);
        out.cross_curvature_per_mm = geometry::normalCurvature(point.surface, point.frame.normal, point.frame.left);
        out.location = placeTool(cutter_, out.position + options_.orientation.depth_offset_mm * out.frame.normal,
                                 out.frame, toolAxis(out.frame, out.lead_rad, options_.orientation.tilt_rad));
        return out;
    }

private:
    static constexpr int looks = 8;
    static constexpr int deepest = 24;

    [[nodiscard]] bool byLocation() const { return options_.steps.measure == StepOptions::Measure::CutterLocation; }
    [[nodiscard]] Vector3 curveAt(double t) const { return byLocation() ? at(t).location.tip_mm : pass_.position(t); }

    [[nodiscard]] bool holds(double t0, double t1) const {
        const StepOptions& steps = options_.steps;
        const Vector3 from = curveAt(t0);
        const Vector3 to = curveAt(t1);
        if ((to - from).norm() > steps.most_mm) return false;
        for (int i = 1; i < looks; ++i)
            if (distanceToChord(curveAt(std::lerp(t0, t1, static_cast<double>(i) / looks)), from, to) >
                steps.chord_tolerance_mm)
                return false;
        return geometry::angleBetween(at(t0).location.axis, at(t1).location.axis) <= steps.most_turn_rad;
    }

    void bisect(double t0, double t1, int depth, std::vector<double>& out) const {
        if (depth >= deepest || holds(t0, t1)) {
            out.push_back(t1);
            return;
        }
        const double middle = (t0 + t1) / 2.0;
        bisect(t0, middle, depth + 1, out);
        bisect(middle, t1, depth + 1, out);
    }

    /// From each point as far as the tolerance allows; the last two steps of a pass share what is left.
    void goGreedily(std::vector<double>& out) const {
        double step = 1.0;
        while (out.back() < 1.0) {
            const double from = out.back();
            double good = 0.0;
            double bad = std::min(2.0 * step, 1.0 - from);
            if (holds(from, from + bad)) {
                good = bad;
                while (from + good < 1.0 && bad - good <= 0.0) {
                    bad = std::min(2.0 * good, 1.0 - from);
                    if (holds(from, from + bad)) good = bad;
                }
            }
            while (bad - good > std::max(1e-3 * good, 1e-9)) {
                const double middle = (good + bad) / 2.0;
                (holds(from, from + middle) ? good : bad) = middle;
            }
            step = std::max(good, 1e-7);
            out.push_back(from + step >= 1.0 - 1e-9 ? 1.0 : from + step);
        }
        const std::size_t n = out.size();
        if (n >= 3) out[n - 2] = (out[n - 3] + out[n - 1]) / 2.0;
        if (n >= 3 && !(holds(out[n - 3], out[n - 2]) && holds(out[n - 2], out[n - 1])))
            out[n - 2] = out[n - 3] + std::min(step_before(out), out[n - 1] - out[n - 3]);
    }
    [[nodiscard]] double step_before(const std::vector<double>& out) const {
        const double from = out[out.size() - 3];
        double good = 0.0;
        double bad = out.back() - from;
        for (int i = 0; i < 40; ++i) {
            const double middle = (good + bad) / 2.0;
            (holds(from, from + middle) ? good : bad) = middle;
        }
        return good;
    }

    const PassCurve& pass_;
    const geometry::Cutter& cutter_;
    const PlanOptions& options_;
    LeadProfile profile_;
};

bool isPlain(const geometry::Cutter& cutter) {
    constexpr double close_mm = 1e-9;
    const double radius = cutter.diameter_mm / 2.0;
    return radius > 0.0 && cutter.corner_radius_mm >= 0.0 && cutter.point_angle_rad == 0.0 &&
           cutter.taper_angle_rad == 0.0 &&
           std::abs(cutter.corner_e_mm + cutter.corner_radius_mm - radius) < close_mm &&
           std::abs(cutter.corner_f_mm - cutter.corner_radius_mm) < close_mm;
}

}  // namespace

std::span<const ContactPoint> ContactPath::pass(std::uint32_t index) const {
    const auto before = [](const ContactPoint& point, std::uint32_t wanted) { return point.pass < wanted; };
    const auto first = std::lower_bound(points.begin(), points.end(), index, before);
    const auto last = std::lower_bound(first, points.end(), index + 1, before);
    return {first, last};
}

base::Result<ContactPath> walkPasses(const std::vector<PassCurve>& passes, const geometry::Cutter& cutter,
                                     const PlanOptions& options) {
    ContactPath out;
    out.cutter = cutter;
    out.options = options;
    for (const PassCurve& pass : passes) {
        PlanOptions of_pass = options;
        const auto& factors = options.orientation.pass_safety;
        if (pass.lane() < factors.size()) of_pass.orientation.curvature_safety *= factors[pass.lane()];
        const Walk walk(pass, cutter, of_pass);
        for (const double t : walk.steps()) {
            out.points.push_back(walk.at(t));
            out.points.back().pass = out.passes;
            out.points.back().lane = pass.lane();
        }
        ++out.passes;
        if (out.points.size() > most_points)
            return base::fail(
                "finishing.too-many-points",
                fmt::format("more than {} points; a larger chord tolerance or step-over needs fewer", most_points));
    }
    return out;
}

base::Result<ContactPath> planContacts(const Workpiece& part, const geometry::Cutter& cutter,
                                       const PlanOptions& options) {
    if (auto problems = options.check(); problems.hasErrors()) return base::fail(std::move(problems));
    if (!isPlain(cutter))
        return base::fail("finishing.cutter",
                          "a path is planned for flat, ball and toroidal mills without taper; this cutter is another");
    auto passes = layOutPasses(part.faces, part.shape, cutter, options);
    if (!passes) return base::fail(passes.error());
    return walkPasses(*passes, cutter, options);
}

}  // namespace cusp::finishing
