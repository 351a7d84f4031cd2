// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The problem of Fountas 2017: tool, step-over, lead, tilt and discretisation against machining error and number of points.
#pragma once

#include <cusp/optimizer/evolution/encoding.hpp>
#include <cusp/optimizer/evolution/evaluation.hpp>
#include <cusp/optimizer/evolution/objective.hpp>
#include <cusp/optimizer/finishing/contact_path.hpp>
#include <cusp/optimizer/finishing/cut_contact.hpp>
#include <cusp/toolpath/tool_library.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cusp::finishing {

struct PaperProblem {
    std::vector<toolpath::Tool> tools;
    std::array<double, 2> step_over_share{0.20, 0.45};  ///< of the diameter
    std::array<double, 2> lead_rad{0.0, 0.0872664625997165};
    std::array<double, 2> tilt_rad{0.0, 0.0349065850398866};
    std::array<double, 2> chord_tolerance_mm{0.005, 0.01};
    double error_weight = 0.5;  ///< against the number of points; the paper gives no weights
    double edge_radius_mm = 0.0;
    PlanOptions options;  ///< everything that is not searched for
    int normalising_samples = 256;
};

/// A decoded chromosome.
struct PaperCandidate {
    std::size_t tool = 0;
    double step_over_mm = 0.0;
    double lead_rad = 0.0;
    double tilt_rad = 0.0;
    double chord_tolerance_mm = 0.0;
};

/// 46 bits as in the paper: tool 4, step-over 12, lead 10, tilt 10, discretisation 10. Errors: those of `Encoding::create`.
/// The paper has plain binary; in the Gray code neighbouring values differ by one bit.
[[nodiscard]] base::Result<optimizer::Encoding> paperEncoding(const PaperProblem& problem,
                                                              optimizer::Coding coding = optimizer::Coding::Gray);
[[nodiscard]] PaperCandidate candidateOf(const PaperProblem& problem, const optimizer::Values& values);
[[nodiscard]] PlanOptions optionsOf(const PaperProblem& problem, const PaperCandidate& candidate);

/// What the paper asks of a candidate.
struct PaperCriteria {
    /// Mean chord error (eq. 1–3) + mean size of the scallop at the step-over + h_u, mm. The scallop is that of eq. 4's circle
    /// on a surface of the curvature there is across the feed, and counts as an overcut does where the circle is the flatter: on
    /// a flat it would vanish at lead 0, where eq. 4 is singular, and every tool would end there.
    double error_mm = 0.0;
    double points = 0.0;
};
/// Of contacts whoever made them, with the candidate's step-over, lead and tilt.
[[nodiscard]] PaperCriteria criteriaOf(std::span<const CutContact> contacts, const PaperProblem& problem,
                                       const PaperCandidate& candidate);
/// Errors: those of `planContacts`.
[[nodiscard]] base::Result<PaperCriteria> paperCriteria(const Workpiece& part, const PaperProblem& problem,
                                                        const PaperCandidate& candidate);

/// Eq. 9 with each criterion mapped to 0 … 1 between its extremes over candidates spread evenly over the ranges (Halton 1960),
/// the same for every seed. Errors: those of `paperCriteria`.
[[nodiscard]] base::Result<optimizer::WeightedObjective> paperObjective(const Workpiece& part,
                                                                        const PaperProblem& problem);

/// `details` of an evaluation are error_mm and points. A flat cutter at lead 0 and tilt 0 is not allowed (infinite).
[[nodiscard]] optimizer::EvaluateBatch paperEvaluator(const Workpiece& part, const PaperProblem& problem,
                                                      const optimizer::WeightedObjective& objective);

}  // namespace cusp::finishing
