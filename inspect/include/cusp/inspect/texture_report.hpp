// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A stylus profile evaluated: form taken off, waviness and roughness separated, parameters of each.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/inspect/texture_form.hpp>
#include <cusp/inspect/texture_parameters.hpp>
#include <cusp/inspect/texture_profile.hpp>

#include <string>
#include <vector>

namespace cusp::inspect {

enum class FormRemoval {
    None,   ///< the heights as they are
    Line,   ///< levelled: a least-squares line
    Curve,  ///< a polynomial of the order with the smallest AICc, half-waves longer than twice the cut-off
};

struct TextureOptions {
    FormRemoval form = FormRemoval::Line;
    double cutoff_mm = 0.8;  ///< λc: roughness is what is shorter
    double short_cutoff_mm =
        0.0;                   ///< λs: what is shorter is noise and left out of P; 0: none, as in Fountas 2017, fig. 12
    double end_cutoffs = 0.5;  ///< R and W leave out this many cut-offs at each end
    TextureConditions conditions;  ///< but `sampling_length_mm` and `least_length_mm`, which follow from the cut-off
};

/// Heights in mm over the mean line, at equal distances.
struct TextureBand {
    char letter = 'P';
    double begin_mm = 0.0;  ///< along the trace
    std::vector<double> height_mm;
    std::vector<TextureParameter> parameters;
};

struct TextureReport {
    StylusProfile profile;
    TextureOptions options;
    std::string form;  ///< what was taken off, one sentence
    TextureBand primary;
    TextureBand roughness;
    TextureBand waviness;
    std::vector<std::string> notes;  ///< what to know of the conditions, a sentence each
};

/// P: the trace without its form (and without what is shorter than λs). W: its Gaussian low-pass at λc; R: the rest. R's
/// parameters are means over sampling lengths of λc.
/// Errors: `texture.options` (a cut-off that is not positive, or λs ≥ λc), `texture.too-coarse` (fewer than 10 points in a
/// cut-off), `texture.too-short` (less than one sampling length between the ends left out).
[[nodiscard]] base::Result<TextureReport> evaluateTexture(StylusProfile profile, const TextureOptions& options);

/// One profile of `cusp texture --json`: docs/json.md.
[[nodiscard]] base::Json toJson(const TextureReport& report);

}  // namespace cusp::inspect
