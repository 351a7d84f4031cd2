// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Halves in on the number of passes.
#include <cusp/loop/budget_path.hpp>

#include <cusp/base/units.hpp>
#include <cusp/optimizer/finishing/feasibility.hpp>
#include <cusp/optimizer/finishing/finishing_path.hpp>
#include <cusp/simulation/surface_envelope.hpp>

#include <fmt/format.h>

#include <cstdint>
#include <utility>

namespace cusp::loop {
namespace {

constexpr double grid_mm = 0.5;
/// Of the budget: what the points of a pass may be off its curve, and how much deeper the contact is set.
constexpr double chord_share = 0.15;
constexpr double depth_share = 0.4;

finishing::PlanOptions planOptions(const BudgetOptions& options, std::size_t passes) {
    finishing::PlanOptions out;
    out.passes.placement = finishing::PassOptions::Placement::Arc;
    out.passes.step_over_mm = 1e3;
    out.passes.count = static_cast<std::int64_t>(passes);
    out.passes.on_edges = true;
    out.orientation.adaptive = true;
    out.orientation.lead_rad = base::radFromDeg(1.0);
    out.orientation.depth_offset_mm = -depth_share * options.budget_mm;
    out.steps.chord_tolerance_mm = chord_share * options.budget_mm;
    out.links.run_in_mm = 2.0;
    out.links.run_out_mm = 2.0;
    out.feed_mm_per_s = base::mmPerSFromMmPerMin(options.feed_mm_per_min);
    return out;
}

struct Candidate {
    finishing::FinishingPath path;
    simulation::EnvelopeSummary judged;
    std::size_t passes = 0;

    [[nodiscard]] bool keeps(double budget_mm) const {
        return judged.reached == judged.points && judged.overcut_max_mm <= budget_mm &&
               judged.undercut_max_mm <= budget_mm;
    }
};

base::Result<Candidate> candidate(const finishing::Workpiece& part, const geometry::Cutter& cutter,
                                  const BudgetOptions& options, std::size_t passes) {
    auto contacts = finishing::planContacts(part, cutter, planOptions(options, passes));
    if (!contacts) return base::fail(contacts.error());
    Candidate out{.path = finishing::joinPasses(*std::move(contacts), part), .judged = {}, .passes = passes};
    simulation::EnvelopeOptions envelope;
    envelope.spacing_mm = grid_mm;
    const auto left = simulation::surfaceEnvelope(finishing::cutterPath(out.path), part.faces, envelope);
    if (!left) return base::fail(left.error());
    out.judged = simulation::summaryOf(*left, options.budget_mm);
    return out;
}

}  // namespace

base::Result<BudgetPath> planWithinBudget(const geometry::ParametricSurface& nominal, const toolpath::Tool& tool,
                                          const BudgetOptions& options) {
    const finishing::Workpiece part{.faces = nominal.faces(), .shape = &nominal};
    const geometry::Cutter cutter = tool.cutter();
    if (auto doubts = finishing::checkFeasible(part, cutter, planOptions(options, 2).orientation); doubts.hasErrors())
        return base::fail(std::move(doubts));
    std::size_t too_few = 1;
    std::size_t judged = 1;
    std::size_t enough = 16;
    auto best = candidate(part, cutter, options, enough);
    while (best && !best->keeps(options.budget_mm) && 2 * enough <= options.most_passes) {
        too_few = enough;
        enough *= 2;
        best = candidate(part, cutter, options, enough);
        ++judged;
    }
    if (!best) return base::fail(best.error());
    if (!best->keeps(options.budget_mm))
        return base::fail("budget.not-met",
                          fmt::format("{} passes cut {:.4f} mm too deep and leave {:.4f} mm; the budget is {} mm",
                                      enough, best->judged.overcut_max_mm, best->judged.undercut_max_mm,
                                      options.budget_mm));
    while (enough - too_few > 1) {
        const std::size_t middle = (enough + too_few) / 2;
        auto next = candidate(part, cutter, options, middle);
        if (!next) return base::fail(next.error());
        ++judged;
        if (next->keeps(options.budget_mm)) {
            enough = middle;
            best = std::move(next);
        } else {
            too_few = middle;
        }
    }
    finishing::ClHeading heading{.part_name = "FINISH",
                                 .remark = fmt::format("{} passes within {} mm", enough, options.budget_mm),
                                 .tool = tool,
                                 .spindle_rpm = options.spindle_rpm};
    const double across_mm = nominal.bounds().sizes().y();
    return BudgetPath{.path = finishing::clFile(best->path, heading),
                      .passes = enough,
                      .judged = judged,
                      .step_over_mm = across_mm / static_cast<double>(enough > 1 ? enough - 1 : 1),
                      .overcut_mm = best->judged.overcut_max_mm,
                      .undercut_mm = best->judged.undercut_max_mm};
}

}  // namespace cusp::loop
