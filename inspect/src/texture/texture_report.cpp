// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From a trace to P, R and W, and their JSON.
#include <cusp/inspect/texture_filter.hpp>
#include <cusp/inspect/texture_report.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <utility>

namespace cusp::inspect {

namespace {

constexpr double least_points_per_cutoff = 10.0;
constexpr double least_length_share = 0.01;  // ISO 4287:1997, 3.2.7: 1 % of the sampling length
constexpr double usual_sampling_lengths = 5.0;

base::Result<void> checkOptions(const StylusProfile& profile, const TextureOptions& options) {
    if (!(options.cutoff_mm > 0.0) || !(options.short_cutoff_mm >= 0.0) || !(options.end_cutoffs >= 0.0) ||
        options.short_cutoff_mm >= options.cutoff_mm)
        return base::fail("texture.options",
                          fmt::format("cut-offs must be positive, the short one below the other: {:.6g} and {:.6g} mm",
                                      options.short_cutoff_mm, options.cutoff_mm));
    if (profile.spacing_mm * least_points_per_cutoff > options.cutoff_mm)
        return base::fail("texture.too-coarse",
                          fmt::format("points lie {:.6g} mm apart: a cut-off of {:.6g} mm needs 10 of them or more",
                                      profile.spacing_mm, options.cutoff_mm));
    const double left = profile.lengthMm() - 2.0 * options.end_cutoffs * options.cutoff_mm;
    if (left < options.cutoff_mm * (1.0 - 1e-9))
        return base::fail(
            "texture.too-short",
            fmt::format("a trace of {:.6g} mm leaves {:.6g} mm between its ends: less than one cut-off of "
                        "{:.6g} mm",
                        profile.lengthMm(), std::max(0.0, left), options.cutoff_mm));
    return {};
}

base::Result<std::string> takeOffForm(std::vector<double>& heights, const StylusProfile& profile,
                                      const TextureOptions& options) {
    if (options.form == FormRemoval::None) return std::string("Form: none taken off.");
    std::vector<double> positions(heights.size());
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = static_cast<double>(i) * profile.spacing_mm;
    FormOptions form;
    if (options.form == FormRemoval::Line) form.order = 1;
    form.shortest_half_wave_mm = 2.0 * options.cutoff_mm;
    const auto fit = fitForm(positions, heights, form);
    if (!fit) return base::fail(fit.error());
    for (std::size_t i = 0; i < heights.size(); ++i) heights[i] -= fit->form_mm[i];
    return options.form == FormRemoval::Line ? std::string("Form: levelled by a least-squares line.") : fit->text;
}

TextureBand bandOf(char letter, std::vector<double> heights, double begin_mm, double spacing_mm,
                   const TextureConditions& conditions) {
    TextureBand band{letter, begin_mm, std::move(heights), {}};
    band.parameters = textureParameters(letter, band.height_mm, spacing_mm, conditions);
    return band;
}

/// What is between the ends that R and W leave out.
std::vector<double> inner(const std::vector<double>& heights, std::size_t left_out) {
    return {heights.begin() + static_cast<std::ptrdiff_t>(left_out),
            heights.end() - static_cast<std::ptrdiff_t>(left_out)};
}

void addNotes(TextureReport& report) {
    const TextureOptions& o = report.options;
    const double lengths =
        static_cast<double>(report.roughness.height_mm.size() - 1) * report.profile.spacing_mm / o.cutoff_mm;
    report.notes.push_back(
        fmt::format("Gaussian filter (ISO 16610-21), cut-off {:.6g} mm; R and W leave out {:.6g} mm at each "
                    "end, where the filter has too little profile under it.",
                    o.cutoff_mm, o.end_cutoffs * o.cutoff_mm));
    report.notes.push_back(o.short_cutoff_mm > 0.0
                               ? fmt::format("What is shorter than {:.6g} mm is left out.", o.short_cutoff_mm)
                               : std::string("No filter against noise: P is unfiltered."));
    if (lengths < usual_sampling_lengths - 1e-6)
        report.notes.push_back(
            fmt::format("R is the mean over {:.0f} sampling lengths; ISO 4288 wants 5.", std::floor(lengths + 1e-6)));
}

base::Json toJson(const std::vector<TextureParameter>& parameters) {
    base::Json out = base::Json::array();
    for (const TextureParameter& parameter : parameters) {
        base::Json entry;
        entry["name"] = parameter.name;
        entry["value"] = parameter.value ? base::Json(*parameter.value) : base::Json(nullptr);
        entry["unit"] = parameter.unit;
        if (!parameter.condition.empty()) entry["condition"] = parameter.condition;
        entry["source"] = parameter.source;
        out.push_back(entry);
    }
    return out;
}

}  // namespace

base::Result<TextureReport> evaluateTexture(StylusProfile profile, const TextureOptions& options) {
    if (const auto checked = checkOptions(profile, options); !checked) return base::fail(checked.error());
    TextureReport report;
    std::vector<double> heights = profile.height_mm;
    auto form = takeOffForm(heights, profile, options);
    if (!form) return base::fail(form.error());
    report.form = *std::move(form);
    if (options.short_cutoff_mm > 0.0) heights = gaussianLowPass(heights, profile.spacing_mm, options.short_cutoff_mm);

    std::vector<double> waviness = gaussianLowPass(heights, profile.spacing_mm, options.cutoff_mm);
    std::vector<double> roughness(heights.size());
    for (std::size_t i = 0; i < heights.size(); ++i) roughness[i] = heights[i] - waviness[i];
    const auto left_out =
        static_cast<std::size_t>(std::llround(options.end_cutoffs * options.cutoff_mm / profile.spacing_mm));
    const double begin_mm = static_cast<double>(left_out) * profile.spacing_mm;
    TextureConditions whole = options.conditions;
    whole.least_length_mm = least_length_share * options.cutoff_mm;
    whole.sampling_length_mm = 0.0;
    TextureConditions sampled = whole;
    sampled.sampling_length_mm = options.cutoff_mm;
    report.primary = bandOf('P', std::move(heights), 0.0, profile.spacing_mm, whole);
    report.roughness = bandOf('R', inner(roughness, left_out), begin_mm, profile.spacing_mm, sampled);
    report.waviness = bandOf('W', inner(waviness, left_out), begin_mm, profile.spacing_mm, whole);
    report.profile = std::move(profile);
    report.options = options;
    addNotes(report);
    return report;
}

base::Json toJson(const TextureReport& report) {
    base::Json out;
    out["profile_file"] = report.profile.source;
    out["points"] = report.profile.height_mm.size();
    out["spacing_mm"] = report.profile.spacing_mm;
    out["length_mm"] = report.profile.lengthMm();
    out["tip_radius_mm"] =
        report.profile.tip_radius_mm ? base::Json(*report.profile.tip_radius_mm) : base::Json(nullptr);
    out["cutoff_mm"] = report.options.cutoff_mm;
    out["short_cutoff_mm"] = report.options.short_cutoff_mm;
    out["left_out_at_ends_mm"] = report.roughness.begin_mm;
    out["form"] = report.form;
    out["notes"] = report.notes;
    out["parameters"] = {{"P", toJson(report.primary.parameters)},
                         {"R", toJson(report.roughness.parameters)},
                         {"W", toJson(report.waviness.parameters)}};
    return out;
}

}  // namespace cusp::inspect
