// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A path in the plane of one level, and what is measured on it.
#pragma once

#include <cusp/optimizer/pocket/pocket_area.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace cusp::pocket {

enum class StepKind {
    Cut,    ///< at the feed, in material or along it
    Link,   ///< at the feed, through what is cleared
    Rapid,  ///< lifted, over everything
    Helix,  ///< lifted to above `to`, then down about it on a helix: the way into a pocket closed all around
};

struct FlatStep {
    Point to;
    StepKind kind = StepKind::Cut;
    double helix_radius_mm = 0.0;
    bool over_limit = false;  ///< taken though the engagement limit is exceeded: there was no other way
};

struct FlatPath {
    std::string name;
    Point start;
    std::vector<FlatStep> steps;
};

struct Engagement {
    double max_deg = 0.0;
    double mean_deg = 0.0;           ///< over the length that is in material
    double share_above_limit = 0.0;  ///< of that length
    double cut_length_mm = 0.0;      ///< feed moves with material in front
    double air_cut_mm = 0.0;         ///< feed moves without
    double rapid_mm = 0.0;
    std::vector<double> step_max_deg;  ///< of each step of the path
};

/// Measured from geometry: at points at most `spacing_mm` apart, the arc of the cutter's rim that is inside the material and
/// inside nothing the path swept before, its ends found to 0.01°. No straight-line formula and no pixels. Nothing is in front
/// of a helix: it is an entry of its own, made at a feed of its own.
[[nodiscard]] Engagement measureEngagement(const FlatPath& path, const PocketArea& area, double limit_deg,
                                           double spacing_mm);

/// Changes of direction between feed moves (eq. 16, turns counted: its 1/Y divides by zero on a straight path).
[[nodiscard]] std::size_t turnsOf(const FlatPath& path);

/// Coverable material the path leaves, on a raster of `cell_mm`.
[[nodiscard]] double unclearedArea(const FlatPath& path, const PocketArea& area, double cell_mm);

/// Deepest cut into what must stay: how far a place of the tool's middle is outside the allowed region (0 where none is).
[[nodiscard]] double gougeOf(const FlatPath& path, const PocketArea& area);

}  // namespace cusp::pocket
