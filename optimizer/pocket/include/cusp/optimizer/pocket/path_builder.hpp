// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From an order of preference to a path that keeps the engagement limit on every step (Mitić 2023, steps 1–12).
#pragma once

#include <cusp/optimizer/pocket/flat_path.hpp>
#include <cusp/optimizer/pocket/point_map.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cusp::pocket {

struct BuildOptions {
    double limit_deg = 90.0;  ///< engagement on a step; 360: none
    double cell_mm = 0.0;     ///< raster of the material; 0: a fifth of the spacing, at most a 25th of the radius
    double link_mm = 60.0;    ///< longer ways through cleared ground are lifted over
};

/// Walks the points of a map. From where the tool stands it takes, among the neighbours that still have material under the
/// tool, the one with the lowest `preference` whose engagement on the way keeps the limit; of equals the one straight ahead.
/// Where there is none, it moves to a point it has been at (or outside) from which the most preferred point left can be cut,
/// by a straight link where the way is cleared, else lifted. Where nothing can be cut within the limit, a helix opens a new
/// place, and where that does not help either the step with the least engagement is taken and marked.
class PathBuilder {
public:
    PathBuilder(const PocketArea& area, const PointMap& map, const BuildOptions& options);
    ~PathBuilder();
    PathBuilder(const PathBuilder&) = delete;
    PathBuilder& operator=(const PathBuilder&) = delete;

    /// `preference`: one number a point. Safe from several threads.
    [[nodiscard]] FlatPath build(const std::vector<double>& preference, const std::string& name) const;

private:
    struct Ground;
    std::unique_ptr<Ground> ground_;
};

}  // namespace cusp::pocket
