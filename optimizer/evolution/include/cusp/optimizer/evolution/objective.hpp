// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From several criteria to one number, and from numbers to chances of being selected.
#pragma once

#include <cusp/base/result.hpp>

#include <span>
#include <string>
#include <vector>

namespace cusp::optimizer {

/// One criterion, to be minimised: its share in the sum, and the range that is mapped to 0 … 1 before it is weighted.
struct Criterion {
    std::string name;
    double weight = 1.0;
    double best = 0.0;   ///< becomes 0
    double worst = 1.0;  ///< becomes 1; values beyond the range go on linearly
};

/// The weighted objective of Fountas 2017 eq. 9, over criteria normalised by the smallest and largest value of each. The
/// paper gives neither weights nor ranges: here both are part of the problem, fixed for a run, so that objective values of
/// two generations (and of two algorithms) can be compared.
class WeightedObjective {
public:
    /// Weights are divided by their sum. Errors: `evolution.weights` (negative, not finite, or all zero),
    /// `evolution.criterion-range` (not finite, or `best` not below `worst`), with the criterion's name as key.
    [[nodiscard]] static base::Result<WeightedObjective> create(std::vector<Criterion> criteria);

    [[nodiscard]] const std::vector<Criterion>& criteria() const { return criteria_; }
    /// Σ w (value − best) / (worst − best); `values` in the order of the criteria.
    [[nodiscard]] double value(std::span<const double> values) const;

private:
    explicit WeightedObjective(std::vector<Criterion> criteria) : criteria_(std::move(criteria)) {}
    std::vector<Criterion> criteria_;
};

/// Criteria with `best` and `worst` set to the smallest and largest value each takes in `samples` (one row a candidate);
/// where all are equal, a range of one unit. Rows with a value that is not finite are left out.
[[nodiscard]] std::vector<Criterion> withRangesOf(std::vector<Criterion> criteria,
                                                  std::span<const std::vector<double>> samples);

/// Which objective values enter eq. 10.
enum class FitnessScale {
    /// As they are: the paper. Needs objectives ≥ 0, since exp(−z²) grows again below; and where all are far below 1 every
    /// candidate has the same chance, because exp(−z²) is 1 for each.
    Raw,
    /// Mapped to 0 … 1 between the best and the worst of the population: the same pressure at any scale.
    Population,
};

/// Fountas 2017 eq. 10: fitness_i = (Σ z) · exp(−z_i²), larger for smaller objectives z. An infinite z has fitness 0. Where
/// the sum is 0 (every objective is exactly 0) all fitnesses are 1.
[[nodiscard]] std::vector<double> exponentialFitness(std::span<const double> objectives, FitnessScale scale);

/// Whether `a` is better (smaller) than `b`: the first entry that differs decides.
[[nodiscard]] bool lexicographicallyLess(std::span<const double> a, std::span<const double> b);

}  // namespace cusp::optimizer
