// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A primal-dual interior point method on a band matrix: time grows with the number of spans, not with its cube.
//
// Minimise Σ h / √c, the time, over the coefficients c of squared speed. Jerk is limited by J / √b, which is convex in b;
// its tangent at the present solution lies below it, so a solution of the linearised limits keeps the true ones, and the
// tangent moves along with the solution (the convex-concave procedure, Lipp and Boyd 2016).
#include "speed_program.hpp"

#include "speed_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::dynamics {

namespace {

constexpr int most_iterations = 100;
/// Relative to the time: what further iterations could gain.
constexpr double gap = 1e-3;
/// Of a limit; callers leave more of it unused.
constexpr double feasible = 1e-3;
constexpr int iterations_per_tangent = 4;
constexpr double first_mu = 0.3;  ///< of the time
constexpr double first_centring = 0.2;

/// A symmetric matrix with two bands beside its diagonal.
class BandMatrix {
public:
    explicit BandMatrix(std::size_t n) : d0_(n), d1_(n), d2_(n) {}
    void clear() {
        for (auto* band : {&d0_, &d1_, &d2_}) std::fill(band->begin(), band->end(), 0.0);
    }
    void addDiagonal(std::size_t i, double value) { d0_[i] += value; }
    /// weight · a aᵀ at rows i-1, i, i+1.
    void addOuter(std::size_t i, const Triple& a, double weight) {
        const std::size_t n = d0_.size();
        const double left = weight * a[0];
        const double middle = weight * a[1];
        d0_[i] += middle * a[1];
        if (i > 0) {
            d0_[i - 1] += left * a[0];
            d1_[i - 1] += left * a[1];
            if (i + 1 < n) d2_[i - 1] += left * a[2];
        }
        if (i + 1 < n) {
            d0_[i + 1] += weight * a[2] * a[2];
            d1_[i] += middle * a[2];
        }
    }
    /// Row and column 0 no longer count.
    void pinFirst() {
        d0_[0] = 1.0;
        d1_[0] = d2_[0] = 0.0;
    }
    /// Solves in place; the matrix is gone afterwards. False when it is not positive definite.
    bool solve(std::vector<double>& x) {
        const std::size_t n = d0_.size();
        for (std::size_t i = 0; i < n; ++i) {
            if (!(d0_[i] > 0.0)) return false;
            const double l1 = d1_[i] / d0_[i];
            const double l2 = d2_[i] / d0_[i];
            if (i + 1 < n) {
                d0_[i + 1] -= l1 * d1_[i];
                d1_[i + 1] -= l1 * d2_[i];
                x[i + 1] -= l1 * x[i];
            }
            if (i + 2 < n) {
                d0_[i + 2] -= l2 * d2_[i];
                x[i + 2] -= l2 * x[i];
            }
            d1_[i] = l1;
            d2_[i] = l2;
        }
        for (std::size_t i = n; i-- > 0;) {
            x[i] /= d0_[i];
            if (i + 1 < n) x[i] -= d1_[i] * x[i + 1];
            if (i + 2 < n) x[i] -= d2_[i] * x[i + 2];
        }
        return true;
    }

private:
    std::vector<double> d0_;
    std::vector<double> d1_;
    std::vector<double> d2_;
};

double dot(const Triple& a, std::size_t span, const std::vector<double>& c) {
    double sum = a[1] * c[span];
    if (span > 0) sum += a[0] * c[span - 1];
    if (span + 1 < c.size()) sum += a[2] * c[span + 1];
    return sum;
}

class InteriorPoint {
public:
    explicit InteriorPoint(const SpeedProblem& problem)
        : problem_(problem),
          rows_(problem),
          n_(problem.spans.size()),
          pinned_(!problem.start_rest),
          c_(n_),
          step_(n_),
          matrix_(n_) {}

    SpeedSolution run(bool steady) {
        steady_ = steady;
        start();
        SpeedSolution out;
        for (; out.iterations < most_iterations; ++out.iterations) {
            if (!iterate()) break;
            if (mu_ * static_cast<double>(all_.size()) < gap * time() && residual_ < feasible) break;
        }
        // Numbers gone astray: the guess is worth more.
        if (!std::all_of(c_.begin(), c_.end(), [](double c) { return std::isfinite(c); })) start();
        out.use = use();
        for (std::size_t j = 0; j < n_; ++j) out.speed.push_back(rows_.speedOf(j, c_));
        return out;
    }

private:
    /// From the guess, or from rest where there is none, slowed down until it keeps every limit.
    void start() {
        guess();
        all_ = rows_.linear();
        all_.resize(all_.size() + 2 * rows_.jerk().size());
        for (int i = 0; i < 20 && !pinned_; ++i) {
            linearise();
            const double most = use();
            if (most <= 0.9) break;
            for (double& c : c_) c *= 0.8 / most;
        }
        linearise();
        count_ = 1;
        centring_ = first_centring;
        slack_.resize(all_.size());
        price_.resize(all_.size());
        mu_ = first_mu * time() / static_cast<double>(all_.size());
        for (std::size_t i = 0; i < all_.size(); ++i) {
            slack_[i] = std::max(0.05, all_[i].bound - dot(all_[i].a, all_[i].span, c_));
            price_[i] = mu_ / slack_[i];
        }
    }

    /// What jerk and acceleration over one span's length can reach: b rises by about b / h there. Where the plan before has a speed, that.
    void guess() {
        double ahead = problem_.end_rest.length;
        for (const AxisCurve& curve : problem_.spans) ahead += curve.length;
        for (std::size_t j = 0; j < n_; ++j) {
            const AxisCurve& curve = problem_.spans[j];
            double jerk = 1e300;
            double acceleration = 1e300;
            for (std::size_t axis = 0; axis < problem_.limits.count; ++axis) {
                const double way = std::abs(curve.points[3][axis] - curve.points[0][axis]);
                if (way <= 1e-12 * curve.length) continue;
                jerk = std::min(jerk, problem_.limits.jerk[axis] * curve.length / way);
                acceleration = std::min(acceleration, problem_.limits.acceleration[axis] * curve.length / way);
            }
            c_[j] = std::min(std::pow(jerk * curve.length * curve.length, 2.0 / 3.0), acceleration * curve.length);
            if (steady_) {
                ahead -= curve.length;
                c_[j] = std::min(problem_.start_squared_speed,
                                 std::min(std::pow(jerk * ahead * ahead, 2.0 / 3.0), acceleration * ahead));
            } else if (j < problem_.guess.size())
                c_[j] = std::max(problem_.guess[j], c_[j]);
        }
        for (const SpeedRow& row : rows_.linear())
            if (row.a[1] > 0.0 && row.a[0] == 0.0 && row.a[2] == 0.0)
                c_[row.span] = std::min(c_[row.span], 0.9 * row.bound / row.a[1]);
        if (pinned_) c_[0] = problem_.start_squared_speed + 0.5 * problem_.start_slope * problem_.spans[0].length;
    }

    [[nodiscard]] double time() const {
        double sum = 0.0;
        for (std::size_t j = 0; j < n_; ++j) sum += problem_.spans[j].length / std::sqrt(c_[j]);
        return sum;
    }

    /// Both sides of every jerk limit, with the tangent of b^(-1/2); scaled so that the bound is about one. One tangent serves
    /// a whole span (of several, the mixture of their coefficients proves nothing): the one that leaves most room.
    void linearise() {
        std::size_t at = rows_.linear().size();
        const auto& jerk = rows_.jerk();
        for (std::size_t first = 0; first < jerk.size();) {
            std::size_t end = first;
            while (end < jerk.size() && jerk[end].span == jerk[first].span) ++end;
            const double reference = bestReference(first, end);
            for (; first < end; ++first) at = addTangents(jerk[first], reference, at);
        }
    }

    std::size_t addTangents(const JerkRow& row, double reference, std::size_t at) {
        const double scale = std::sqrt(reference) / row.limit;
        const double pull = 0.5 / reference;
        for (const double side : {1.0, -1.0}) {
            SpeedRow& out = all_[at++];
            out.span = row.span;
            for (std::size_t i = 0; i < 3; ++i) out.a[i] = side * scale * row.r[i] + pull * row.b[i];
            out.bound = 1.5 - side * scale * row.constant - pull * row.b_constant;
        }
        return at;
    }

    [[nodiscard]] double bestReference(std::size_t first, std::size_t end) const {
        const std::size_t span = rows_.jerk()[first].span;
        const SpanSpeed b = rows_.speedOf(span, c_);
        std::array<double, 5> worst{};
        const std::array<double, 5> candidates = {b[1], b[0], b[2], 0.5 * (b[0] + b[1]), 0.5 * (b[1] + b[2])};
        for (std::size_t i = first; i < end; ++i) {
            const JerkRow& row = rows_.jerk()[i];
            const double jerk = std::abs(dot(row.r, span, c_) + row.constant) / row.limit;
            const double here = dot(row.b, span, c_) + row.b_constant;
            for (std::size_t k = 0; k < candidates.size(); ++k)
                worst[k] = std::max(worst[k], jerk * std::sqrt(candidates[k]) + 0.5 * here / candidates[k]);
        }
        return candidates[static_cast<std::size_t>(std::min_element(worst.begin(), worst.end()) - worst.begin())];
    }

    /// The tangents have moved: slacks of limits that hold are what they are.
    void takeSlacks() {
        for (std::size_t i = rows_.linear().size(); i < all_.size(); ++i) {
            const double slack = all_[i].bound - dot(all_[i].a, all_[i].span, c_);
            slack_[i] = std::max(slack, 0.1 * slack_[i]);
        }
    }

    bool iterate() {
        if (count_++ % iterations_per_tangent == 0) {
            linearise();
            takeSlacks();
        }
        matrix_.clear();
        for (std::size_t j = 0; j < n_; ++j) {
            const double slope = 0.5 * problem_.spans[j].length / (c_[j] * std::sqrt(c_[j]));
            step_[j] = slope;
            matrix_.addDiagonal(j, 1.5 * slope / c_[j]);
        }
        const double target = centring_ * mu_;
        residual_ = 0.0;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            const SpeedRow& row = all_[i];
            const double miss = dot(row.a, row.span, c_) + slack_[i] - row.bound;
            residual_ = std::max(residual_, std::abs(miss));
            const double inverse = 1.0 / slack_[i];
            const double pull = (target + price_[i] * miss) * inverse;
            matrix_.addOuter(row.span, row.a, price_[i] * inverse);
            if (row.span > 0) step_[row.span - 1] -= pull * row.a[0];
            step_[row.span] -= pull * row.a[1];
            if (row.span + 1 < n_) step_[row.span + 1] -= pull * row.a[2];
        }
        if (pinned_) {
            matrix_.pinFirst();
            step_[0] = 0.0;
        }
        if (!matrix_.solve(step_)) return false;
        return advance(target);
    }

    /// As far along the step as slacks, prices and squared speeds stay above zero.
    bool advance(double target) {
        constexpr double keep = 0.99;
        double primal = 1.0 / keep;
        double dual = 1.0 / keep;
        for (std::size_t j = 0; j < n_; ++j)
            if (step_[j] < 0.0) primal = std::min(primal, -0.7 * c_[j] / step_[j]);
        slack_step_.resize(all_.size());
        price_step_.resize(all_.size());
        for (std::size_t i = 0; i < all_.size(); ++i) {
            const SpeedRow& row = all_[i];
            const double miss = dot(row.a, row.span, c_) + slack_[i] - row.bound;
            slack_step_[i] = -miss - dot(row.a, row.span, step_);
            price_step_[i] = (target - price_[i] * slack_step_[i]) / slack_[i] - price_[i];
            if (slack_step_[i] < -slack_[i] * 0.9) primal = std::min(primal, -slack_[i] / slack_step_[i]);
            if (price_step_[i] < -price_[i] * 0.9) dual = std::min(dual, -price_[i] / price_step_[i]);
        }
        primal = std::min(1.0, keep * primal);
        dual = std::min(1.0, keep * dual);
        if (!std::isfinite(primal) || !std::isfinite(dual)) return false;
        for (std::size_t j = 0; j < n_; ++j) c_[j] += primal * step_[j];
        double sum = 0.0;
        for (std::size_t i = 0; i < all_.size(); ++i) {
            slack_[i] += primal * slack_step_[i];
            price_[i] += dual * price_step_[i];
            sum += slack_[i] * price_[i];
        }
        mu_ = sum / static_cast<double>(all_.size());
        const double shorter = std::min(primal, dual);
        centring_ = shorter > 0.9 ? 0.1 : (shorter > 0.5 ? 0.25 : 0.6);
        return std::isfinite(mu_);
    }

    /// With the tangents taken last: whatever they were taken at, a limit that holds against them holds.
    [[nodiscard]] double use() const {
        double most = 0.0;
        for (const SpeedRow& row : all_) most = std::max(most, 1.0 + dot(row.a, row.span, c_) - row.bound);
        return most;
    }

    const SpeedProblem& problem_;
    SpeedRows rows_;
    std::size_t n_;
    bool pinned_;
    std::vector<double> c_;
    std::vector<double> step_;
    BandMatrix matrix_;
    std::vector<SpeedRow> all_;
    std::vector<double> slack_;
    std::vector<double> price_;
    std::vector<double> slack_step_;
    std::vector<double> price_step_;
    bool steady_ = false;  ///< the guess: go on with the speed of the start
    int count_ = 0;
    double mu_ = 0.0;
    double centring_ = first_centring;
    double residual_ = 0.0;
};

}  // namespace

double largestAfterRest(const AxisCurve& curve, const AxisLimits& limits, double largest) {
    // x' = v (x/h)^(2/3), x'' = 2/3 v²/h (x/h)^(1/3), x''' = 2/9 v³/h², all growing along the span.
    const double h = curve.length;
    double out = largest;
    for (std::size_t axis = 0; axis < limits.count; ++axis) {
        double d = 0.0;
        double e = 0.0;
        for (std::size_t k = 0; k < 3; ++k)
            d = std::max(d, 3.0 * std::abs(curve.points[k + 1][axis] - curve.points[k][axis]) / h);
        for (std::size_t k = 0; k < 2; ++k)
            e = std::max(
                e, 6.0 * std::abs(curve.points[k][axis] - 2.0 * curve.points[k + 1][axis] + curve.points[k + 2][axis]) /
                       (h * h));
        const double f = 6.0 *
                         std::abs(curve.points[3][axis] - 3.0 * curve.points[2][axis] + 3.0 * curve.points[1][axis] -
                                  curve.points[0][axis]) /
                         (h * h * h);
        if (d > 0.0) out = std::min(out, limits.velocity[axis] * limits.velocity[axis] / (d * d));
        const double acceleration = e + 2.0 / 3.0 * d / h;
        if (acceleration > 0.0) out = std::min(out, limits.acceleration[axis] / acceleration);
        const double jerk = f + 2.0 * e / h + 2.0 / 9.0 * d / (h * h);
        if (jerk > 0.0) out = std::min(out, std::pow(limits.jerk[axis] / jerk, 2.0 / 3.0));
    }
    return out;
}

SpeedSolution solveSpeed(const SpeedProblem& problem) {
    InteriorPoint method(problem);
    SpeedSolution out = method.run(false);
    if (out.use <= 1.0 + feasible || problem.start_rest) return out;
    SpeedSolution other = method.run(true);
    return other.use < out.use ? other : out;
}

}  // namespace cusp::dynamics
