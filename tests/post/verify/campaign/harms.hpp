// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One thing wrong in a program, at a place drawn at random.
#pragma once

#include "drawn_program.hpp"

#include <functional>
#include <string>
#include <vector>

namespace cusp::post::verify::test {

struct Harm {
    std::string name;
    /// False, and the program as it was, where it offers no place.
    std::function<bool(DrawnProgram& program, base::Random& random)> apply;
};

[[nodiscard]] const std::vector<Harm>& allHarms();

}  // namespace cusp::post::verify::test
