// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The finishing path with the fewest passes that keeps a budget everywhere, judged by the exact envelope.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/toolpath/cl_reader.hpp>
#include <cusp/toolpath/tool_library.hpp>

#include <cstddef>
#include <string>

namespace cusp::loop {

struct BudgetOptions {
    double budget_mm = 0.004;  ///< overcut and material left, both at most this, on the whole surface
    double feed_mm_per_min = 3000.0;
    double spindle_rpm = 9950.0;
    std::size_t most_passes = 400;
};

struct BudgetPath {
    toolpath::ToolPath path;
    std::size_t passes = 0;
    std::size_t judged = 0;  ///< paths planned and judged on the way
    double step_over_mm = 0.0;
    double overcut_mm = 0.0;
    double undercut_mm = 0.0;
};

/// Passes across Y, equally far apart along the surface, the lead matched to its curvature; their number is halved in until
/// one fewer would break the budget. The contact is set deeper by two fifths of the budget, so that ridges and floors share it.
/// Errors: those of the planner; `budget.not-met` (with the best that was found).
[[nodiscard]] base::Result<BudgetPath> planWithinBudget(const geometry::ParametricSurface& nominal,
                                                        const toolpath::Tool& tool, const BudgetOptions& options);

}  // namespace cusp::loop
