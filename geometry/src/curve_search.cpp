// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// As for patches, in one dimension: a piece whose bound promises nothing better than what is known is left.
#include "curve_search.hpp"

#include "bernstein.hpp"
#include "exact_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::geometry::detail {
namespace {

/// A lower bound of the squared distance from the origin of the net: the least quotient of Bernstein coefficients of |N|² and
/// w², and the place it belongs to.
struct CurveBound {
    double least_squared = std::numeric_limits<double>::infinity();
    double place = 0.5;

    explicit CurveBound(const BezierCurve& curve) {
        const std::size_t n = curve.net().size() - 1;
        double largest = 0.0;
        for (std::size_t k = 0; k <= 2 * n; ++k) {
            double space = 0.0;
            double weight = 0.0;
            for (std::size_t i = k > n ? k - n : 0; i <= std::min(k, n); ++i) {
                const double share = binomial(n, i) * binomial(n, k - i);
                const auto& a = curve.net()[i];
                const auto& b = curve.net()[k - i];
                space += share * a.head<3>().dot(b.head<3>());
                weight += share * a[3] * b[3];
            }
            const double quotient = space / weight;
            largest = std::max(largest, quotient);
            if (quotient < least_squared) {
                least_squared = quotient;
                place = static_cast<double>(k) / static_cast<double>(2 * n);
            }
        }
        constexpr double rounding = 2e-15;
        least_squared = std::max(0.0, least_squared - rounding * largest);
    }
};

class CurveSearch {
public:
    CurveSearch(const BezierCurve& about_query, CurveFoot& foot) : curve_(about_query), foot_(foot) {}

    void run(const BezierCurve& piece, double low, double high) {
        const CurveBound bound(piece);
        if (!canImprove(bound.least_squared)) return;
        polish(low + bound.place * (high - low));
        if (!canImprove(bound.least_squared)) return;
        const double middle = 0.5 * (low + high);
        if (!(middle > low && middle < high)) return;
        const auto [left, right] = piece.split();
        run(left, low, middle);
        run(right, middle, high);
    }
    [[nodiscard]] bool improved() const { return improved_; }

private:
    [[nodiscard]] bool canImprove(double least_squared) const {
        const double enough = std::max(0.0, std::sqrt(foot_.squared_mm2) * (1.0 - 4e-15) - search_tolerance_mm);
        return least_squared < enough * enough;
    }

    /// Newton's method on C·C′ from t, as long as it leads nearer; only the best place on the way counts.
    void polish(double t) {
        double last = std::numeric_limits<double>::infinity();
        for (int i = 0; i < 20; ++i) {
            const CurvePoint p = curve_.evaluate(t);
            const double squared = p.position.squaredNorm();
            if (squared < foot_.squared_mm2) {
                foot_ = {t, squared, p.position};
                improved_ = true;
            }
            // Near the end only rounding decides what is nearer; the step itself says more.
            if (!(squared <= last * (1.0 + 1e-14))) return;
            last = squared;
            const double bend = p.first.squaredNorm() + p.position.dot(p.second);
            const double slope = p.position.dot(p.first);
            const double step = bend > 0.0 ? -slope / bend : -slope / p.first.squaredNorm();
            const double next = std::clamp(t + step, 0.0, 1.0);
            if (!(std::abs(next - t) * p.first.norm() > 1e-13)) return;
            t = next;
        }
    }

    const BezierCurve& curve_;
    CurveFoot& foot_;
    bool improved_ = false;
};

}  // namespace

bool searchCurve(const BezierCurve& curve, const Vector3& query, CurveFoot& foot) {
    const BezierCurve about_query = curve.about(query);
    CurveSearch search(about_query, foot);
    search.run(about_query, 0.0, 1.0);
    if (search.improved()) foot.position += query;
    return search.improved();
}

}  // namespace cusp::geometry::detail
