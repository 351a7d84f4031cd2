// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Words of flags into options; the command line has checked that they are among those that exist.
#include "inspect_flags.hpp"

#include <cusp/base/units.hpp>

namespace cusp::cli {

namespace {

std::optional<double> unitOf(const std::string& word) {
    if (word == "mm") return 1.0;
    if (word == "inch") return base::mm_per_inch;
    if (word == "m") return 1000.0;
    return std::nullopt;
}

inspect::FitKind fitOf(const std::string& word) {
    if (word == "none") return inspect::FitKind::None;
    return word == "minimax" ? inspect::FitKind::Minimax : inspect::FitKind::LeastSquares;
}

inspect::Loss lossOf(const std::string& word) {
    if (word == "huber") return inspect::Loss::Huber;
    if (word == "cauchy") return inspect::Loss::Cauchy;
    return word == "tukey" ? inspect::Loss::Tukey : inspect::Loss::Squared;
}

base::Result<std::optional<inspect::ToleranceLimits>> limitsOf(const InspectFlags& flags) {
    std::optional<inspect::ToleranceLimits> out;
    if (!flags.limits_mm.empty()) out = {flags.limits_mm[0], flags.limits_mm[1]};
    // The t of a profile tolerance is the whole width of its zone (ISO 1101).
    if (flags.profile_t_mm) out = {-0.5 * *flags.profile_t_mm, 0.5 * *flags.profile_t_mm};
    if (out && !(out->lower_mm < out->upper_mm))
        return base::fail("inspect.limits", "the lower limit must be below the upper one, e.g. --limits-mm=-0.01,0.01");
    return out;
}

}  // namespace

inspect::PointReaderOptions readerOptions(const InspectFlags& flags) {
    inspect::PointReaderOptions out;
    out.format = flags.format;
    out.columns = flags.columns;
    out.mm_per_unit = unitOf(flags.units);
    if (!flags.decimal.empty()) out.decimal = flags.decimal == "comma" ? ',' : '.';
    if (!flags.kind.empty())
        out.kind = flags.kind == "centre" ? inspect::PointKind::Centre : inspect::PointKind::Surface;
    return out;
}

base::Result<inspect::InspectionOptions> inspectionOptions(const InspectFlags& flags) {
    inspect::InspectionOptions out;
    out.fit = fitOf(flags.fit);
    for (const std::string& name : flags.lock)
        for (const inspect::Freedom freedom : inspect::all_freedoms)
            if (name == inspect::freedomName(freedom)) out.locked.at(static_cast<std::size_t>(freedom)) = true;
    out.loss = lossOf(flags.loss);
    out.loss_scale_mm = flags.loss_scale_mm;
    out.use_weights = flags.weights;
    out.planned_step_over_mm = flags.step_over_mm;
    out.probe_radius_mm = flags.probe_radius_mm;
    out.probe_form_error_mm = flags.probe_form_mm;
    out.uncertainty_mm = flags.uncertainty_mm;
    out.rule = flags.rule == "guard-band" ? inspect::DecisionRule::GuardBand : inspect::DecisionRule::Probability;
    out.judge_in_datum = flags.judge == "datum" || out.fit == inspect::FitKind::None;
    const auto limits = limitsOf(flags);
    if (!limits) return base::fail(limits.error());
    out.limits = *limits;
    if (!flags.sections.empty()) {
        auto plan = inspect::parseSectionPlan(flags.sections);
        if (!plan) return base::fail(plan.error());
        plan->width_mm = flags.section_width_mm;
        out.sections = *std::move(plan);
    }
    return out;
}

}  // namespace cusp::cli
