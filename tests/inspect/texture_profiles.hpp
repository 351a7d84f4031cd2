// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Profiles with known parameters, sampled; lengths in mm.
#pragma once

#include <cusp/inspect/texture_parameters.hpp>

#include <cmath>
#include <cstddef>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <string>
#include <vector>

namespace cusp::inspect::test {

/// Heights at 0, spacing, … of a function of x.
inline std::vector<double> sampled(const std::function<double(double)>& z, double spacing_mm, std::size_t steps) {
    std::vector<double> heights;
    for (std::size_t i = 0; i <= steps; ++i) heights.push_back(z(static_cast<double>(i) * spacing_mm));
    return heights;
}

/// A full wave between −1 and 1 per unit of `turns`, rising from 0, made of straight flanks.
inline double triangleWave(double turns) {
    const double phase = turns - std::floor(turns);
    if (phase < 0.25) return 4.0 * phase;
    if (phase < 0.75) return 2.0 - 4.0 * phase;
    return 4.0 * phase - 4.0;
}

inline double valueOf(const std::vector<TextureParameter>& parameters, const std::string& name) {
    for (const TextureParameter& parameter : parameters)
        if (parameter.name == name) {
            EXPECT_TRUE(parameter.value.has_value()) << name;
            return parameter.value.value_or(NAN);
        }
    ADD_FAILURE() << "no parameter " << name;
    return NAN;
}

/// What a parameter must be, in its own unit.
struct Expected {
    const char* name;
    double value;
};

inline void expectAll(const std::vector<TextureParameter>& parameters, const std::vector<Expected>& expected,
                      double relative) {
    for (const auto& [name, value] : expected)
        EXPECT_NEAR(valueOf(parameters, name), value, relative * std::max(std::abs(value), 1e-3)) << name;
}

}  // namespace cusp::inspect::test
