// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Weighted objective (Fountas 2017 eq. 9), exponential fitness (eq. 10), lexicographic order.
#include <cusp/optimizer/evolution/objective.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cusp::optimizer {

base::Result<WeightedObjective> WeightedObjective::create(std::vector<Criterion> criteria) {
    base::Diagnostics report;
    double sum = 0.0;
    for (const Criterion& criterion : criteria) {
        const base::Location where{.file = {}, .line = 0, .column = 0, .key = criterion.name};
        if (!std::isfinite(criterion.weight) || criterion.weight < 0.0)
            report.error("evolution.weights",
                         fmt::format("weight {}; a weight is a number from 0 upwards", criterion.weight), where);
        if (!std::isfinite(criterion.best) || !std::isfinite(criterion.worst) || criterion.best >= criterion.worst)
            report.error("evolution.criterion-range",
                         fmt::format("best {} must be below worst {}", criterion.best, criterion.worst), where);
        sum += criterion.weight;
    }
    if (!report.hasErrors() && !(sum > 0.0))
        report.error("evolution.weights",
                     "every weight is zero, so that nothing is asked for; give one criterion a weight");
    if (report.hasErrors()) return base::fail(std::move(report));
    for (Criterion& criterion : criteria) criterion.weight /= sum;
    return WeightedObjective(std::move(criteria));
}

double WeightedObjective::value(std::span<const double> values) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < criteria_.size(); ++i) {
        const Criterion& c = criteria_[i];
        // A criterion without weight must not spoil the sum where it is infinite: 0 · ∞ is no number.
        if (c.weight > 0.0) sum += c.weight * ((values[i] - c.best) / (c.worst - c.best));
    }
    return sum;
}

std::vector<Criterion> withRangesOf(std::vector<Criterion> criteria, std::span<const std::vector<double>> samples) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<double> low(criteria.size(), infinity);
    std::vector<double> high(criteria.size(), -infinity);
    for (const std::vector<double>& row : samples) {
        if (!std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); })) continue;
        for (std::size_t i = 0; i < criteria.size(); ++i) {
            low[i] = std::min(low[i], row[i]);
            high[i] = std::max(high[i], row[i]);
        }
    }
    for (std::size_t i = 0; i < criteria.size(); ++i) {
        if (low[i] > high[i]) continue;  // nothing finite was seen: the range stays as it is
        criteria[i].best = low[i];
        criteria[i].worst = high[i] > low[i] ? high[i] : low[i] + 1.0;
    }
    return criteria;
}

std::vector<double> exponentialFitness(std::span<const double> objectives, FitnessScale scale) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double z : objectives)
        if (std::isfinite(z)) {
            low = std::min(low, z);
            high = std::max(high, z);
        }
    const bool scaled = scale == FitnessScale::Population && high > low;
    const auto mapped = [&](double z) { return scaled ? (z - low) / (high - low) : z; };
    double sum = 0.0;
    for (const double z : objectives)
        if (std::isfinite(z)) sum += mapped(z);
    // Population scale with all equal, or every objective zero: nothing tells the candidates apart.
    const bool equal = !(sum > 0.0) || (scale == FitnessScale::Population && !scaled);
    std::vector<double> out;
    out.reserve(objectives.size());
    for (const double z : objectives) {
        if (!std::isfinite(z)) {
            out.push_back(0.0);
            continue;
        }
        const double m = mapped(z);
        out.push_back(equal ? 1.0 : sum * std::exp(-m * m));
    }
    return out;
}

bool lexicographicallyLess(std::span<const double> a, std::span<const double> b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
}

}  // namespace cusp::optimizer
