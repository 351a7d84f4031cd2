// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A section is form, ridges, and what is left.
#include <cusp/inspect/texture_section.hpp>

#include <utility>
#include <vector>

namespace cusp::inspect {

base::Result<SectionForm> evaluateSection(std::span<const double> arc_length_mm, std::span<const double> deviation_mm,
                                          double planned_step_over_mm) {
    FormOptions options;
    options.shortest_half_wave_mm = 2.0 * planned_step_over_mm;
    auto form = fitForm(arc_length_mm, deviation_mm, options);
    if (!form) return base::fail(form.error());
    SectionForm out{*std::move(form), {}, {}};
    std::vector<double> over_form(deviation_mm.begin(), deviation_mm.end());
    for (std::size_t i = 0; i < over_form.size(); ++i) over_form[i] -= out.form.form_mm[i];
    auto scallops = findScallops(arc_length_mm, over_form, {planned_step_over_mm});
    if (scallops)
        out.scallops = *std::move(scallops);
    else
        out.note = scallops.error().front().message;
    return out;
}

base::Json toJson(const SectionForm& section, double planned_step_over_mm) {
    const bool has_plan = planned_step_over_mm > 0.0;
    base::Json out;
    out["form"] = {{"order", section.form.order}, {"rms_mm", section.form.rms_mm}, {"text", section.form.text}};
    if (section.scallops) {
        const Scallops& s = *section.scallops;
        const bool has_spacing = s.count > 1;
        out["scallops"] = {{"count", s.count},
                           {"planned_count", has_plan ? base::Json(s.planned_count) : base::Json(nullptr)},
                           {"mean_spacing_mm", has_spacing ? base::Json(s.mean_spacing_mm) : base::Json(nullptr)},
                           {"planned_step_over_mm", has_plan ? base::Json(planned_step_over_mm) : base::Json(nullptr)},
                           {"mean_height_mm", s.count > 0 ? base::Json(s.mean_height_mm) : base::Json(nullptr)},
                           {"max_height_mm", s.count > 0 ? base::Json(s.max_height_mm) : base::Json(nullptr)}};
    } else {
        out["scallops"] = nullptr;
    }
    out["note"] = section.note;
    return out;
}

}  // namespace cusp::inspect
