// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The usual query, near the surface and away from edges: two evaluations, and a proof by the reach of the cell.
#pragma once

#include "cell_polynomial.hpp"
#include "patch_cells.hpp"
#include "start_grid.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace cusp::geometry::detail {

/// A foot with the derivatives there, by the parameters s and t of its cell.
struct QuickFoot {
    std::uint32_t patch = 0;
    double u = 0.0;  ///< of the patch
    double v = 0.0;
    Vector3 position;
    Vector3 ds;
    Vector3 dt;
};

class QuickSearch {
public:
    QuickSearch() = default;
    /// `reaches` holds what ReachFinder promises for each cell.
    QuickSearch(std::span<const BezierPatch* const> patches, std::span<const PatchCell> cells,
                std::span<const double> reaches);

    /// True with the proven nearest point in `foot`; false when there is no proof, which says nothing about the query.
    [[nodiscard]] bool find(const Vector3& query, QuickFoot& foot) const;

private:
    struct Cell {
        CellPolynomial shape;
        LanePoint middle;
        /// Rows of the pseudo-inverse of J at the middle: from an offset to (s, t).
        Lanes to_s{};
        Lanes to_t{};
        /// The foot has to end within these: the scope of the reach, and the patch.
        double low_s = 0.0;
        double high_s = 0.0;
        double low_t = 0.0;
        double high_t = 0.0;
        double squared_reach = 0.0;
        /// A Newton step of this squared length leaves an error below 1e-12 mm.
        double last_step_mm2 = 0.0;
        double middle_u = 0.0;
        double middle_v = 0.0;
        double half_u = 0.0;
        double half_v = 0.0;
        std::uint32_t patch = 0;
    };
    /// Beside: the foot is not within the scope of the cell; its position says where it is.
    enum class Ending : std::uint8_t { Proved, Beside, Lost };
    [[nodiscard]] static Ending findFrom(const Cell& cell, const Vector3& query, QuickFoot& foot);
    [[nodiscard]] static Cell cellOf(const PatchCell& cell, const CellPolynomial& shape, double reach_mm);

    StartGrid grid_;
    std::vector<std::uint32_t> index_;  ///< from a cell to its place in `cells_`, or StartGrid::none
    std::vector<Cell> cells_;
};

}  // namespace cusp::geometry::detail
