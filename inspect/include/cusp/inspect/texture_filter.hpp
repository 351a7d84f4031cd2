// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The linear profile filter that separates roughness from waviness: Gaussian, ISO 16610-21.
#pragma once

#include <span>
#include <vector>

namespace cusp::inspect {

/// The low-pass of a profile, of the same size; roughness is profile minus low-pass.
///
/// Weights s(x) = exp(−x²/2σ²) with σ = λc/π·√(ln 2/2), which lets half of a wave of length λc through (ISO 16610-21:2011,
/// 4.1: α = √(ln 2/π), s = exp(−π(x/αλc)²)/(αλc)). They reach to 1.3 λc, where they have fallen to 4e-11; their sum is 1.
///
/// Ends: within 1.3 λc of an end a part of the weights has no profile under it. There the weights are those of a straight
/// line fitted locally with the same Gaussian (ISO 16610-28:2016, moment retainment of order 1): a straight profile passes
/// unchanged to its very end. What the low-pass says there of waves still differs from the inside; evaluations leave out
/// half a cut-off at each end, by which the weights missing have fallen to 0.4 %.
/// `cutoff_mm` and `spacing_mm` must be above 0.
[[nodiscard]] std::vector<double> gaussianLowPass(std::span<const double> heights, double spacing_mm, double cutoff_mm);

/// How much of a wave of length `wavelength_mm` the low-pass lets through: exp(−π(αλc/λ)²).
[[nodiscard]] double gaussianTransmission(double wavelength_mm, double cutoff_mm);

}  // namespace cusp::inspect
