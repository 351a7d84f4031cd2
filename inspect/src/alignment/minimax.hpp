// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Chebyshev fit of a residual field by a sequence of linear programs.
#pragma once

#include "alignment/least_squares.hpp"

namespace cusp::inspect {

/// Makes the largest |residual| as small as it gets from the field's present parameters on (those of least squares); leaves
/// the field at the minimum. Each linear program minimises t subject to |e + J·δ| ≤ t over the free parameters within a
/// trust region; of many points, only those that bind are in it, and it is solved again until no other is violated.
[[nodiscard]] SolveOutcome solveMinimax(ResidualField& field, const std::array<bool, 6>& locked, int max_iterations);

}  // namespace cusp::inspect
