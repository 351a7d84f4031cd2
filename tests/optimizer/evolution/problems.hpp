// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Problems with known optima for the tests of the engines.
#pragma once

#include <cusp/optimizer/evolution/search.hpp>

#include <cmath>
#include <numbers>

namespace test_problems {

/// Fountas 2017 eq. 13 (Bohachevsky): least at (0, 0), where it is 0.
inline double bohachevsky(const cusp::optimizer::Values& v) {
    using std::numbers::pi;
    return v[0] * v[0] + v[1] * v[1] - 0.3 * std::cos(3.0 * pi * v[0]) - 0.4 * std::cos(4.0 * pi * v[1]) + 0.7;
}

inline cusp::optimizer::Encoding bohachevskyGenes(int bits, cusp::optimizer::Coding coding) {
    return cusp::optimizer::Encoding::create({{.name = "x", .bits = bits, .lower = -1.0, .upper = 1.0},
                                              {.name = "y", .bits = bits, .lower = -1.0, .upper = 1.0}},
                                             coding)
        .value();
}

}  // namespace test_problems
