// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The decision rules of ISO 14253-1, and an uncertainty from the points themselves.
#include <cusp/inspect/conformance.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fmt/format.h>
#include <numbers>
#include <numeric>
#include <vector>

namespace cusp::inspect {
namespace {

constexpr double level = 0.95;

/// P(X > x) of the standard normal distribution, accurate in both tails.
double upperTail(double x) { return 0.5 * std::erfc(x / std::numbers::sqrt2); }

Verdict verdictOf(double d, const ToleranceLimits& limits, double u, DecisionRule rule) {
    if (rule == DecisionRule::GuardBand) {
        const double expanded = 2.0 * u;
        if (d >= limits.lower_mm + expanded && d <= limits.upper_mm - expanded) return Verdict::Accept;
        if (d < limits.lower_mm - expanded || d > limits.upper_mm + expanded) return Verdict::Reject;
        return Verdict::Undecided;
    }
    const double conforming = conformingProbability(d, limits, u);
    if (conforming >= level) return Verdict::Accept;
    return 1.0 - conforming >= level ? Verdict::Reject : Verdict::Undecided;
}

std::string reasonOf(const Decision& out, std::size_t rejected, std::size_t undecided, std::size_t count) {
    switch (out.verdict) {
        case Verdict::Accept: return fmt::format("each of {} points conforms", count);
        case Verdict::Reject: return fmt::format("{} of {} points do not conform", rejected, count);
        case Verdict::Undecided:
            return fmt::format("of {} points {} lie too close to a limit for the uncertainty of {:.4g} mm", count,
                               undecided, out.uncertainty.standard_mm);
        case Verdict::NotAsked: break;
    }
    return {};
}

/// The bits of three coordinates of 21 bits each, interleaved: points near each other are mostly near in this order.
std::uint64_t mortonKey(const geometry::Vector3& unit) {
    std::uint64_t key = 0;
    constexpr double cells = 2097151.0;
    for (unsigned axis = 0; axis < 3; ++axis) {
        const auto cell =
            static_cast<std::uint64_t>(std::clamp(unit[static_cast<Eigen::Index>(axis)], 0.0, 1.0) * cells);
        for (unsigned bit = 0; bit < 21; ++bit) key |= ((cell >> bit) & 1U) << (3U * bit + axis);
    }
    return key;
}

std::vector<std::uint32_t> spatialOrder(std::span<const geometry::Vector3> positions) {
    geometry::Vector3 low = positions.front();
    geometry::Vector3 high = low;
    for (const auto& p : positions) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
    }
    const double extent = std::max((high - low).maxCoeff(), 1e-300);
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
        keys[i] = {mortonKey((positions[i] - low) / extent), static_cast<std::uint32_t>(i)};
    std::sort(keys.begin(), keys.end());
    std::vector<std::uint32_t> order(keys.size());
    std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
    return order;
}

}  // namespace

double conformingProbability(double deviation_mm, const ToleranceLimits& limits, double standard_mm) {
    if (!(standard_mm > 0.0)) return deviation_mm >= limits.lower_mm && deviation_mm <= limits.upper_mm ? 1.0 : 0.0;
    const double below = (limits.lower_mm - deviation_mm) / standard_mm;
    const double above = (limits.upper_mm - deviation_mm) / standard_mm;
    return std::max(0.0, 1.0 - upperTail(-below) - upperTail(above));
}

Decision decide(std::span<const double> deviations_mm, const ToleranceLimits& limits, const Uncertainty& uncertainty,
                DecisionRule rule) {
    Decision out;
    out.limits = limits;
    out.rule = rule;
    out.uncertainty = uncertainty;
    std::size_t rejected = 0;
    std::size_t undecided = 0;
    double least_margin = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < deviations_mm.size(); ++i) {
        const double d = deviations_mm[i];
        const Verdict verdict = verdictOf(d, limits, uncertainty.standard_mm, rule);
        rejected += verdict == Verdict::Reject ? 1U : 0U;
        undecided += verdict == Verdict::Undecided ? 1U : 0U;
        // The distance to the limits orders points that all have probability 0 or 1 to the last digit.
        const double margin = std::min(d - limits.lower_mm, limits.upper_mm - d);
        if (margin < 0.0) ++out.points_outside;
        if (margin >= least_margin) continue;
        least_margin = margin;
        out.worst_point = i;
    }
    if (!deviations_mm.empty())
        out.least_conforming_probability =
            conformingProbability(deviations_mm[out.worst_point], limits, uncertainty.standard_mm);
    out.verdict = rejected > 0 ? Verdict::Reject : (undecided > 0 ? Verdict::Undecided : Verdict::Accept);
    out.reason = reasonOf(out, rejected, undecided, deviations_mm.size());
    return out;
}

Uncertainty uncertaintyFromNeighbours(std::span<const geometry::Vector3> positions,
                                      std::span<const double> deviations_mm) {
    Uncertainty out;
    out.source = "computed from how neighbouring points differ; systematic errors of the measurement are not in it";
    if (deviations_mm.size() < 3) return out;
    const auto order = spatialOrder(positions);
    std::vector<double> steps;
    for (std::size_t i = 1; i < order.size(); ++i)
        steps.push_back(std::abs(deviations_mm[order[i]] - deviations_mm[order[i - 1]]));
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    constexpr double normal_quartile = 0.674489750196082;
    out.standard_mm = *middle / (normal_quartile * std::numbers::sqrt2);
    return out;
}

}  // namespace cusp::inspect
