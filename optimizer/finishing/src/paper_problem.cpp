// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Chromosomes of the paper's problem, decoded, planned and judged.
#include <cusp/optimizer/finishing/paper_problem.hpp>
#include <cusp/optimizer/finishing/path_criteria.hpp>

#include <cmath>
#include <limits>

namespace cusp::finishing {

using optimizer::Evaluation;
using optimizer::Values;

namespace {

/// Van der Corput's sequence in a base: the digits of `index` mirrored behind the point.
double mirrored(int index, int base) {
    double out = 0.0;
    double place = 1.0;
    for (; index > 0; index /= base) {
        place /= base;
        out += place * (index % base);
    }
    return out;
}

bool standsUpright(const PaperProblem& problem, const PaperCandidate& candidate) {
    return problem.tools[candidate.tool].cutter().corner_radius_mm == 0.0 && candidate.lead_rad == 0.0 &&
           candidate.tilt_rad == 0.0;
}

}  // namespace

base::Result<optimizer::Encoding> paperEncoding(const PaperProblem& problem, optimizer::Coding coding) {
    const auto tools = static_cast<std::int64_t>(problem.tools.size());
    return optimizer::Encoding::create(
        {{.name = "tool", .bits = 4, .lower = 0.0, .upper = static_cast<double>(tools - 1), .choices = tools},
         {.name = "step_over_share",
          .bits = 12,
          .lower = problem.step_over_share[0],
          .upper = problem.step_over_share[1]},
         {.name = "lead_rad", .bits = 10, .lower = problem.lead_rad[0], .upper = problem.lead_rad[1]},
         {.name = "tilt_rad", .bits = 10, .lower = problem.tilt_rad[0], .upper = problem.tilt_rad[1]},
         {.name = "chord_tolerance_mm",
          .bits = 10,
          .lower = problem.chord_tolerance_mm[0],
          .upper = problem.chord_tolerance_mm[1]}},
        coding);
}

PaperCandidate candidateOf(const PaperProblem& problem, const Values& values) {
    PaperCandidate out;
    out.tool = static_cast<std::size_t>(std::lround(values[0]));
    out.step_over_mm = values[1] * problem.tools[out.tool].diameter_mm;
    out.lead_rad = values[2];
    out.tilt_rad = values[3];
    out.chord_tolerance_mm = values[4];
    return out;
}

PlanOptions optionsOf(const PaperProblem& problem, const PaperCandidate& candidate) {
    PlanOptions out = problem.options;
    out.passes.step_over_mm = candidate.step_over_mm;
    out.orientation.lead_rad = candidate.lead_rad;
    out.orientation.tilt_rad = candidate.tilt_rad;
    out.steps.chord_tolerance_mm = candidate.chord_tolerance_mm;
    return out;
}

PaperCriteria criteriaOf(std::span<const CutContact> contacts, const PaperProblem& problem,
                         const PaperCandidate& candidate) {
    const geometry::Cutter cutter = problem.tools[candidate.tool].cutter();
    Spread chords;
    Spread scallops;
    const double radius = effectiveRadius(cutter, candidate.lead_rad, candidate.tilt_rad);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        if (i > 0 && contacts[i].pass == contacts[i - 1].pass) chords.take(chordError(contacts[i - 1], contacts[i]));
        scallops.take(
            std::abs(scallopHeight(candidate.step_over_mm, radius, contacts[i].cross_curvature_per_mm.value_or(0.0))));
    }
    const double edge = cutter.corner_radius_mm > 0.0 ? 0.0 : edgeUndercut(problem.edge_radius_mm, candidate.lead_rad);
    return {chords.mean + scallops.mean + edge, static_cast<double>(contacts.size())};
}

base::Result<PaperCriteria> paperCriteria(const Workpiece& part, const PaperProblem& problem,
                                          const PaperCandidate& candidate) {
    const auto contacts = planContacts(part, problem.tools[candidate.tool].cutter(), optionsOf(problem, candidate));
    if (!contacts) return base::fail(contacts.error());
    return criteriaOf(contactsOf(*contacts), problem, candidate);
}

base::Result<optimizer::WeightedObjective> paperObjective(const Workpiece& part, const PaperProblem& problem) {
    const auto encoding = paperEncoding(problem);
    if (!encoding) return base::fail(encoding.error());
    std::vector<Values> samples;
    constexpr std::array bases{2, 3, 5, 7, 11};
    for (int i = 1; i <= problem.normalising_samples; ++i) {
        std::vector<std::uint64_t> codes;
        for (std::size_t g = 0; g < bases.size(); ++g)
            codes.push_back(
                static_cast<std::uint64_t>(mirrored(i, bases[g]) * static_cast<double>(encoding->largestCode(g) + 1)));
        samples.push_back(encoding->values(codes));
    }
    const auto judge = optimizer::inParallel([&](const Values& values) -> base::Result<Evaluation> {
        const auto criteria = paperCriteria(part, problem, candidateOf(problem, values));
        if (!criteria) return base::fail(criteria.error());
        return Evaluation{{0.0}, {criteria->error_mm, criteria->points}};
    });
    const auto judged = judge(samples, base::noProgress());
    if (!judged) return base::fail(judged.error());
    std::vector<std::vector<double>> rows;
    for (const Evaluation& evaluation : *judged) rows.push_back(evaluation.details);
    return optimizer::WeightedObjective::create(
        optimizer::withRangesOf({{.name = "error_mm", .weight = problem.error_weight},
                                 {.name = "points", .weight = 1.0 - problem.error_weight}},
                                rows));
}

optimizer::EvaluateBatch paperEvaluator(const Workpiece& part, const PaperProblem& problem,
                                        const optimizer::WeightedObjective& objective) {
    return optimizer::inParallel([part, problem, objective](const Values& values) -> base::Result<Evaluation> {
        const PaperCandidate candidate = candidateOf(problem, values);
        if (standsUpright(problem, candidate)) return Evaluation{{std::numeric_limits<double>::infinity()}, {0.0, 0.0}};
        const auto criteria = paperCriteria(part, problem, candidate);
        if (!criteria) return base::fail(criteria.error());
        return Evaluation{{objective.value(std::array{criteria->error_mm, criteria->points})},
                          {criteria->error_mm, criteria->points}};
    });
}

}  // namespace cusp::finishing
