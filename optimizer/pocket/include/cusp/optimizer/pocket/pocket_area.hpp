// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where material is, and where the middle of the tool may go.
#pragma once

#include <cusp/optimizer/pocket/region.hpp>

#include <vector>

namespace cusp::pocket {

/// The contours of a job. What is to be removed is the stock inside a pocket and outside every island; without a pocket, the
/// whole stock outside the islands. A pocket that is drawn beyond the edge of the stock is open there.
struct PocketContours {
    std::vector<Polygon> stock;
    std::vector<Polygon> pockets;
    std::vector<Polygon> islands;
};

struct PocketArea {
    Region stock;
    Region material;   ///< to be removed, finishing allowance left on
    Region allowed;    ///< places of the tool's middle that cut nothing that must stay
    Region coverable;  ///< of the material, what the tool reaches
    double radius_mm = 0.0;
    double unreachable_area_mm2 = 0.0;  ///< material in corners and gaps the tool does not fit into
};

/// Errors: `pocket.no-stock`, `pocket.no-material` (nothing to remove), `pocket.tool-too-large` (the tool fits nowhere, with
/// the largest that would).
[[nodiscard]] base::Result<PocketArea> areaFor(const PocketContours& contours, double tool_diameter_mm,
                                               double allowance_mm);

}  // namespace cusp::pocket
