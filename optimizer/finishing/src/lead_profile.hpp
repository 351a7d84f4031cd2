// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The lead along a pass: as the surface wants it, and no rougher than the axes can follow.
#pragma once

#include <cusp/optimizer/finishing/pass_layout.hpp>

#include <vector>

namespace cusp::finishing {

class LeadProfile {
public:
    /// Never below what the surface wants: where the lead must change faster than it may, it is raised ahead of the place.
    LeadProfile(const PassCurve& pass, const geometry::Cutter& cutter, const OrientationOptions& orientation);
    [[nodiscard]] double at(double t) const;

private:
    std::vector<double> leads_;  ///< at equal steps of t; one when constant
};

}  // namespace cusp::finishing
