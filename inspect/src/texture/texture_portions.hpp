// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Peaks and valleys of a profile: the portions between crossings of a level, small ones left out by rule.
#pragma once

#include "texture/texture_curve.hpp"

#include <vector>

namespace cusp::inspect {

/// A stretch on one side of a level; x in units of the spacing, extreme relative to the level.
struct Portion {
    double from = 0.0;
    double to = 0.0;
    double extreme = 0.0;  ///< > 0: a peak; < 0: a valley
    bool begins = false;   ///< at a crossing, not where the profile begins
    bool ends = false;     ///< likewise

    [[nodiscard]] bool whole() const { return begins && ends; }
    [[nodiscard]] bool isPeak() const { return extreme > 0.0; }
};

/// In order along the profile, peaks and valleys in turn.
[[nodiscard]] std::vector<Portion> portionsAt(const TextureCurve& curve, double level);

/// Only those that are higher than `least_height` and longer than `least_length`; a smaller one is taken into what is
/// before it, and neighbours of the same side become one (ISO 4287:1997, 3.2.7).
[[nodiscard]] std::vector<Portion> significant(const std::vector<Portion>& portions, double least_height,
                                               double least_length);

/// The local maxima of the curve, x in units of the spacing; ends of the profile are none.
[[nodiscard]] std::vector<double> localPeaks(const TextureCurve& curve);

/// How often the curve comes from above +band to below −band.
[[nodiscard]] std::size_t passagesThrough(const TextureCurve& curve, double band);

}  // namespace cusp::inspect
