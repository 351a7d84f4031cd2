// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Another CAM system as the planner: parameters go to its command, a CL file comes back and is judged.
#pragma once

#include <cusp/geometry/closest_point.hpp>
#include <cusp/optimizer/finishing/paper_problem.hpp>
#include <cusp/simulation/tool_move.hpp>

#include <string>
#include <vector>

namespace cusp::finishing {

/// A command of the shell. It gets one JSON object on standard input (`requestText`) and answers with a CL file on standard output.
struct OutsideCam {
    std::string command;
    double wall_s = 60.0;  ///< one candidate may take so long
};

struct OutsidePath {
    std::string cl_text;  ///< as it came
    simulation::CutterPath path;
    std::vector<CutContact> contacts;
};

/// `schema`, `tool`, `tool_diameter_mm`, `tool_corner_radius_mm`, `step_over_mm`, `lead_deg`, `tilt_deg`, `chord_tolerance_mm`, `feed_mm_per_min`.
[[nodiscard]] std::string requestText(const PaperProblem& problem, const PaperCandidate& candidate);

/// Errors: `finishing.outside-cam` with what the command said and the parameters it was given (exit code not 0, time over,
/// no contact with the part); those of the CL reader, with lines of the answer; `process.*`.
[[nodiscard]] base::Result<OutsidePath> outsidePath(const OutsideCam& cam, const geometry::NominalShape& shape,
                                                    const PaperProblem& problem, const PaperCandidate& candidate);

/// As `paperEvaluator`, on what the command answers; commands run side by side.
[[nodiscard]] optimizer::EvaluateBatch outsideEvaluator(const OutsideCam& cam, const geometry::NominalShape& shape,
                                                        const PaperProblem& problem,
                                                        const optimizer::WeightedObjective& objective);

}  // namespace cusp::finishing
