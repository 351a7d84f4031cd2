// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Knots, spline, tolerance check, speed, pieces.
#include "window_plan.hpp"

#include "knot_spacing.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace cusp::dynamics {

namespace {

/// Of the spans next to a rest, which run with constant jerk: short against the way on which axes reach full acceleration.
constexpr double rest_mm = 0.1;
constexpr double fewest_spans = 8.0;
constexpr int most_rounds = 7;
constexpr double keep_free = 1e-6;

std::pair<AxisCurve, AxisCurve> halves(const AxisCurve& curve) {
    const auto between = [](const AxisVector& a, const AxisVector& b) {
        AxisVector out;
        for (std::size_t i = 0; i < max_axes; ++i) out[i] = 0.5 * (a[i] + b[i]);
        return out;
    };
    const auto& p = curve.points;
    const AxisVector a = between(p[0], p[1]);
    const AxisVector b = between(p[1], p[2]);
    const AxisVector c = between(p[2], p[3]);
    const AxisVector ab = between(a, b);
    const AxisVector bc = between(b, c);
    const AxisVector middle = between(ab, bc);
    const double length = 0.5 * curve.length;
    return {{{p[0], a, ab, middle}, length}, {{middle, bc, c, p[3]}, length}};
}

class Window {
public:
    Window(const Polyline& path, std::size_t horizon, const std::optional<MotionStart>& start, const AxisLimits& limits,
           double limit_use, const ToolModel& tool)
        : path_(path), horizon_(horizon), start_(start), limits_(limits), limit_use_(limit_use), tool_(tool) {}

    WindowPlan run() {
        smooth();
        plan();
        return std::move(out_);
    }

private:
    [[nodiscard]] double end() const { return path_.vertices()[horizon_].s; }

    /// Tighter knots until tip and tool axis keep their tolerances everywhere.
    void smooth() {
        const double begin = start_ ? start_->knots[2] : path_.vertices().front().s;
        KnotSpacing spacing(path_, horizon_, std::min(rest_mm, (end() - begin) / fewest_spans), !start_);
        for (int round = 0;; ++round) {
            std::vector<double> knots = start_ ? start_->knots : std::vector<double>(3, begin);
            spacing.place(knots.back(), knots);
            spline_.emplace(path_, std::move(knots));
            const std::vector<double> misses = check();
            if (misses.empty() || round == most_rounds) return;
            for (const double s : misses) spacing.tighten(s);
        }
    }

    /// Where the spline leaves a tolerance: at every vertex and in the middle of every span.
    std::vector<double> check() {
        std::vector<double> misses;
        out_.tip_mm = out_.axis_rad = 0.0;
        std::size_t vertex = 0;
        for (std::size_t span = 0; span < spline_->spans(); ++span) {
            const double from = spline_->knot(span);
            const double to = spline_->knot(span + 1);
            while (vertex <= horizon_ && path_.vertices()[vertex].s < from) ++vertex;
            for (; vertex <= horizon_ && path_.vertices()[vertex].s < to; ++vertex)
                measure(span, path_.vertices()[vertex].s, misses);
            measure(span, 0.5 * (from + to), misses);
        }
        return misses;
    }

    void measure(std::size_t span, double s, std::vector<double>& misses) {
        const ToolPlace is = tool_(spline_->curve(span).at(s - spline_->knot(span)));
        const std::size_t edge = path_.edgeAt(s);
        const PathPoint wanted = path_.at(s);
        const double tip = (is.tip_mm - wanted.tool.tip_mm).norm();
        const double axis = geometry::angleBetween(is.axis, wanted.tool.axis);
        double tip_limit = path_.edges()[edge].tolerance_mm;
        double axis_limit = path_.edges()[edge].orientation_tolerance_rad;
        if (edge > 0 && s == path_.vertices()[edge].s) {
            tip_limit = std::min(tip_limit, path_.edges()[edge - 1].tolerance_mm);
            axis_limit = std::min(axis_limit, path_.edges()[edge - 1].orientation_tolerance_rad);
        }
        if (tip > tip_limit || axis > axis_limit) misses.push_back(s);
        out_.tip_mm = std::max(out_.tip_mm, tip);
        out_.axis_rad = std::max(out_.axis_rad, axis);
    }

    /// The feed of every edge that a piece touches.
    [[nodiscard]] double feedLimit(std::size_t piece) const {
        double least = 1e300;
        const double begin = out_.pieces[piece].path_mm;
        const double end_of_piece = std::nextafter(begin + out_.pieces[piece].curve.length, 0.0);
        const std::size_t last = std::min(path_.edgeAt(end_of_piece), horizon_ - 1);
        for (std::size_t edge = path_.edgeAt(begin); edge <= last; ++edge)
            least = std::min(least, path_.edges()[edge].squared_speed);
        return least * (1.0 - keep_free);
    }

    /// Speed needs a finer spline than the path: its knots and the places halfway between them.
    void divide() {
        const std::size_t last = spline_->spans() - 1;
        for (std::size_t span = 0; span <= last; ++span) {
            out_.first_piece.push_back(out_.pieces.size());
            const bool rests = span == last || (span == 0 && !start_);
            if (rests) {
                addPiece(spline_->curve(span), spline_->knot(span));
                continue;
            }
            const auto [left, right] = halves(spline_->curve(span));
            addPiece(left, spline_->knot(span));
            addPiece(right, spline_->knot(span) + left.length);
        }
    }

    void addPiece(const AxisCurve& curve, double s) {
        MotionPiece piece;
        piece.curve = curve;
        piece.path_mm = s;
        piece.block = path_.edges()[path_.edgeAt(s)].block;
        out_.pieces.push_back(piece);
    }

    void plan() {
        divide();
        SpeedProblem problem;
        problem.limits = limits_;
        for (std::size_t i = 0; i < limits_.count; ++i) {
            problem.limits.velocity[i] *= limit_use_;
            problem.limits.acceleration[i] *= limit_use_;
            problem.limits.jerk[i] *= limit_use_;
        }
        const std::size_t last = out_.pieces.size() - 1;
        const std::size_t first = start_ ? 0 : 1;
        for (std::size_t i = first; i < last; ++i) {
            problem.spans.push_back(out_.pieces[i].curve);
            problem.largest.push_back(feedLimit(i));
        }
        problem.end_rest = out_.pieces[last].curve;
        problem.end_largest = feedLimit(last);
        if (!start_) {
            problem.start_rest = out_.pieces[0].curve;
            problem.start_largest = feedLimit(0);
        } else {
            problem.start_squared_speed = start_->squared_speed;
            problem.start_slope = start_->slope;
            for (std::size_t i = 0; i < last && mid(i) < start_->plan.back().first; ++i)
                problem.guess.push_back(plannedBefore(mid(i)));
        }
        take(solveSpeed(problem), first);
    }

    [[nodiscard]] double mid(std::size_t piece) const {
        return out_.pieces[piece].path_mm + 0.5 * out_.pieces[piece].curve.length;
    }

    [[nodiscard]] double plannedBefore(double s) const {
        const auto& known = start_->plan;
        const auto after = std::lower_bound(known.begin() + 1, known.end() - 1, std::pair{s, 0.0});
        const auto before = after - 1;
        const double u = std::clamp((s - before->first) / (after->first - before->first), 0.0, 1.0);
        return (1.0 - u) * before->second + u * after->second;
    }

    void take(const SpeedSolution& solution, std::size_t first) {
        if (!(solution.use <= 1.0 + 0.9 * (1.0 - limit_use_) / limit_use_)) return;
        out_.speed.assign(out_.pieces.size(), SpanSpeed{});
        for (std::size_t i = 0; i < solution.speed.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) out_.speed[first + i][k] = solution.speed[i][k];
        const std::size_t last = out_.pieces.size() - 1;
        for (std::size_t i = first; i < last; ++i)
            out_.pieces[i].law = quadraticSpeedLaw(out_.speed[i], out_.pieces[i].curve.length);
        out_.pieces[last].law = restLaw(out_.speed[last - 1][2], out_.pieces[last].curve.length, false);
        if (!start_) out_.pieces[0].law = restLaw(out_.speed[1][0], out_.pieces[0].curve.length, true);
        out_.knots = spline_->knots();
        // An optimisation that went astray may keep every limit by hardly moving.
        const double time = std::accumulate(out_.pieces.begin(), out_.pieces.end(), 0.0,
                                            [](double sum, const MotionPiece& p) { return sum + p.law.duration_s; });
        out_.usable = time <= timeWithStops(path_, horizon_, limits_);
    }

    /// Constant jerk between rest and the squared speed b at the other end.
    static TimeLaw restLaw(double b, double length, bool starts) {
        const double jerk = 2.0 / 9.0 * b * std::sqrt(b) / (length * length);
        const double duration = 3.0 * length / std::sqrt(b);
        if (starts) return {TimeLaw::Kind::ConstantJerk, 0.0, 0.0, jerk, duration};
        return {TimeLaw::Kind::ConstantJerk, std::sqrt(b), -2.0 / 3.0 * b / length, jerk, duration};
    }

    const Polyline& path_;
    std::size_t horizon_;
    const std::optional<MotionStart>& start_;
    const AxisLimits& limits_;
    double limit_use_;
    const ToolModel& tool_;
    std::optional<PathSpline> spline_;
    WindowPlan out_;
};

}  // namespace

MotionStart WindowPlan::startAt(std::size_t span) const {
    MotionStart out;
    const auto knot = knots.begin() + static_cast<std::ptrdiff_t>(span);
    out.knots.assign(knot, knot + 5);
    const std::size_t piece = first_piece[span];
    out.squared_speed = speed[piece][0];
    out.slope = 2.0 * (speed[piece][1] - speed[piece][0]) / pieces[piece].curve.length;
    for (std::size_t i = piece; i < pieces.size(); ++i)
        out.plan.emplace_back(pieces[i].path_mm + 0.5 * pieces[i].curve.length, speed[i][1]);
    return out;
}

WindowPlan planWindow(const Polyline& path, std::size_t horizon, const std::optional<MotionStart>& start,
                      const AxisLimits& limits, double limit_use, const ToolModel& tool) {
    return Window(path, horizon, start, limits, limit_use, tool).run();
}

}  // namespace cusp::dynamics
