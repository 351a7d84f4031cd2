// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Gauss–Newton with Levenberg–Marquardt damping on a residual field, with freedoms locked.
#pragma once

#include "alignment/residual_field.hpp"

namespace cusp::inspect {

struct SolveOutcome {
    Termination termination = Termination::MaxIterations;
    int iterations = 0;
    NormalEquations equations;  ///< at the field's parameters
};

/// Minimises the cost from the field's present parameters on; leaves the field at the minimum. `tolerance_mm`: converged
/// when a step changes the residuals by less (rms).
[[nodiscard]] SolveOutcome solveLeastSquares(ResidualField& field, const std::array<bool, 6>& locked,
                                             int max_iterations, double tolerance_mm);

/// Solution of (H + damping·diag H)·x = −g over the free parameters, without the directions H does not see.
[[nodiscard]] Vector6 dampedStep(const NormalEquations& equations, const std::array<bool, 6>& locked, double damping);

/// What the normal matrix says of the free parameters.
struct Determination {
    double condition = 1.0;             ///< largest over smallest eigenvalue
    std::vector<Freedom> undetermined;  ///< as many as the matrix lacks rank: locking them leaves a determined fit
    std::vector<Freedom> weak;          ///< standard deviation at least 100 times that of the best determined direction
    Matrix6 inverse = Matrix6::Zero();  ///< of H, zero for locked parameters
};
[[nodiscard]] Determination determinationOf(const Matrix6& H, const std::array<bool, 6>& locked);

}  // namespace cusp::inspect
