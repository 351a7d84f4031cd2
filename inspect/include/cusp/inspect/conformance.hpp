// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Decision of conformance with a tolerance under measurement uncertainty, by ISO 14253-1.
#pragma once

#include <cusp/geometry/frames.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace cusp::inspect {

/// Limits of the deviation along the normal. A profile zone of total width t (ISO 1101) is −t/2 … +t/2.
struct ToleranceLimits {
    double lower_mm = 0.0;
    double upper_mm = 0.0;
};

enum class Verdict {
    NotAsked,  ///< no tolerance was given
    Accept,
    Reject,
    Undecided,
};
/// "not-asked", "accept", "reject", "undecided".
[[nodiscard]] std::string_view verdictName(Verdict verdict);

enum class DecisionRule {
    /// ISO 14253-1:2017: accept when the probability of conforming is at least 95 %, reject when that of not conforming is.
    Probability,
    /// The rule before it: limits shrunk, for rejection widened, by the expanded uncertainty U = 2u.
    GuardBand,
};
[[nodiscard]] std::string_view ruleName(DecisionRule rule);

/// A standard uncertainty of one deviation and where it comes from.
struct Uncertainty {
    double standard_mm = 0.0;
    bool stated = false;  ///< by the user; otherwise computed from the points
    std::string source;   ///< one sentence for the report
};

struct Decision {
    Verdict verdict = Verdict::NotAsked;
    ToleranceLimits limits;
    DecisionRule rule = DecisionRule::Probability;
    Uncertainty uncertainty;
    double least_conforming_probability = 1.0;  ///< smallest over the points, normal distribution
    std::size_t worst_point = 0;                ///< index of that point
    std::size_t points_outside = 0;             ///< deviations beyond the limits, uncertainty left aside
    std::string reason;                         ///< one sentence
};

/// Probability that the true value lies within the limits, for a normal distribution about the measured one.
[[nodiscard]] double conformingProbability(double deviation_mm, const ToleranceLimits& limits, double standard_mm);

/// The part is accepted when every point is, rejected when one point is, undecided otherwise. With u = 0 there is nothing
/// undecided. Needs at least one deviation.
[[nodiscard]] Decision decide(std::span<const double> deviations_mm, const ToleranceLimits& limits,
                              const Uncertainty& uncertainty, DecisionRule rule);

/// Standard uncertainty of a single point's deviation from how neighbours differ: σ = median|Δ| / (0.6745·√2) over pairs
/// of neighbours along a space-filling curve. It sees noise of probing and short-wave form, never systematic errors.
/// One position (mm) per deviation; fewer than three give 0.
[[nodiscard]] Uncertainty uncertaintyFromNeighbours(std::span<const geometry::Vector3> positions,
                                                    std::span<const double> deviations_mm);

}  // namespace cusp::inspect
