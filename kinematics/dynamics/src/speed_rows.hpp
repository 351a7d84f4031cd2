// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The limits of every axis as linear inequalities in the spline of squared speed.
#pragma once

#include "speed_program.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace cusp::dynamics {

using Triple = std::array<double, 3>;

/// a · (c[span - 1], c[span], c[span + 1]) <= bound.
struct SpeedRow {
    std::size_t span = 0;
    Triple a{};
    double bound = 0.0;
};

/// |r · c + constant| <= limit / √b, a jerk; b is the Bernstein coefficient `b · c + b_constant`.
struct JerkRow {
    std::size_t span = 0;
    Triple r{};
    double constant = 0.0;
    Triple b{};
    double b_constant = 0.0;
    double limit = 0.0;
};

/// b is a C1 quadratic spline: span j has one coefficient of its own, c[j], between two that follow from its neighbours.
class SpeedRows {
public:
    explicit SpeedRows(const SpeedProblem& problem);

    [[nodiscard]] SpanSpeed speedOf(std::size_t span, const std::vector<double>& c) const;
    /// Limits of b and of acceleration.
    [[nodiscard]] const std::vector<SpeedRow>& linear() const { return linear_; }
    [[nodiscard]] const std::vector<JerkRow>& jerk() const { return jerk_; }

private:
    struct Map {
        std::array<Triple, 3> of_c{};  ///< rows: the three Bernstein coefficients
        Triple constant{};
    };
    void map(const SpeedProblem& problem);
    void addSpeed(const SpeedProblem& problem, std::size_t span);
    void addAxis(const SpeedProblem& problem, std::size_t span, std::size_t axis);
    void addLinear(std::size_t span, const Triple& of_b, double limit);

    std::vector<Map> maps_;
    std::vector<SpeedRow> linear_;
    std::vector<JerkRow> jerk_;
};

}  // namespace cusp::dynamics
