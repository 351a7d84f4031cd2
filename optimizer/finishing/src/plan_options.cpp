// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What must hold for the options of a plan.
#include <cusp/base/units.hpp>
#include <cusp/optimizer/finishing/plan_options.hpp>

#include <cmath>
#include <fmt/format.h>
#include <string>
#include <string_view>

namespace cusp::finishing {

base::Diagnostics PlanOptions::check() const {
    base::Diagnostics report;
    const auto demand = [&](bool holds, std::string_view name, double value, std::string_view rule) {
        if (!holds)
            report.error("finishing.option", fmt::format("this is {:g}; it must be {}", value, rule),
                         {.file = {}, .line = 0, .column = 0, .key = std::string(name)});
    };
    demand(passes.step_over_mm > 0.0 && std::isfinite(passes.step_over_mm), "passes.step_over_mm", passes.step_over_mm,
           "above 0");
    demand(passes.placement != PassOptions::Placement::Scallop || passes.scallop_mm > 0.0, "passes.scallop_mm",
           passes.scallop_mm, "above 0");
    demand(!passes.count || *passes.count > 0, "passes.count", static_cast<double>(passes.count.value_or(0)),
           "above 0");
    const auto length = [](const std::array<double, 3>& v) { return std::hypot(v[0], v[1], v[2]); };
    constexpr double shortest = 1e-6;
    demand(length(passes.plane_normal) > shortest, "passes.plane_normal", length(passes.plane_normal),
           "a direction, longer than 0");
    demand(length(links.up) > shortest, "links.up", length(links.up), "a direction, longer than 0");
    constexpr double widest_deg = 80.0;
    const double lead = base::degFromRad(orientation.lead_rad);
    const double tilt = base::degFromRad(orientation.tilt_rad);
    const double most = base::degFromRad(orientation.lead_max_rad);
    demand(lead >= 0.0 && lead <= widest_deg, "orientation.lead_deg", lead, "0 to 80");
    demand(std::abs(tilt) <= widest_deg, "orientation.tilt_deg", tilt, "-80 to 80");
    demand(!orientation.adaptive || (most >= lead && most <= widest_deg), "orientation.lead_max_deg", most,
           "no less than lead_deg and at most 80");
    demand(!orientation.adaptive || orientation.curvature_safety > 0.0, "orientation.curvature_safety",
           orientation.curvature_safety, "above 0");
    demand(!orientation.adaptive || orientation.lead_change_rad_per_mm > 0.0, "orientation.lead_change_deg_per_mm",
           base::degFromRad(orientation.lead_change_rad_per_mm), "above 0");
    demand(!orientation.adaptive || orientation.smoothing_mm >= 0.0, "orientation.smoothing_mm",
           orientation.smoothing_mm, "0 or more");
    demand(steps.chord_tolerance_mm > 0.0, "steps.chord_tolerance_mm", steps.chord_tolerance_mm, "above 0");
    demand(steps.most_mm > 0.0, "steps.step_max_mm", steps.most_mm, "above 0");
    demand(steps.most_turn_rad > 0.0, "steps.turn_max_deg", base::degFromRad(steps.most_turn_rad), "above 0");
    demand(links.lift_mm > 0.0, "links.lift_mm", links.lift_mm, "above 0");
    demand(links.run_in_mm >= 0.0, "links.run_in_mm", links.run_in_mm, "0 or more");
    demand(links.run_out_mm >= 0.0, "links.run_out_mm", links.run_out_mm, "0 or more");
    for (std::size_t i = 0; i < passes.places.size(); ++i)
        demand(passes.places[i] >= (i == 0 ? 0.0 : passes.places[i - 1]) && passes.places[i] <= 1.0, "passes.places",
               passes.places[i], "in 0 to 1, and no less than the one before");
    for (const double factor : orientation.pass_safety)
        demand(factor > 0.0, "orientation.pass_safety", factor, "above 0");
    demand(links.clearance_mm > 0.0, "links.clearance_mm", links.clearance_mm, "above 0");
    demand(feed_mm_per_s > 0.0, "feed.feed_mm_per_min", base::mmPerMinFromMmPerS(feed_mm_per_s), "above 0");
    demand(links.approach_feed_mm_per_s > 0.0, "feed.approach_feed_mm_per_min",
           base::mmPerMinFromMmPerS(links.approach_feed_mm_per_s), "above 0");
    return report;
}

}  // namespace cusp::finishing
