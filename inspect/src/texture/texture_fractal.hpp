// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The fractal dimension of a profile by its variation (Dubuc, Quiniou, Roques-Carmes, Tricot, Zucker 1989).
#pragma once

#include <optional>
#include <span>

namespace cusp::inspect {

/// 2 − the slope of log V against log ε, where V(ε) is the mean over x of (highest − lowest height within ± ε), for ε from 8
/// samples to 1/16 of the profile, doubling. 1 for a smooth profile, up to 2. Absent for a flat or short profile.
[[nodiscard]] std::optional<double> fractalDimension(std::span<const double> heights);

}  // namespace cusp::inspect
