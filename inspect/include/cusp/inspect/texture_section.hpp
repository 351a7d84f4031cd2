// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Form and scallops of a measured section: what a CMM line shows between the pose and the texture it cannot see.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/inspect/texture_form.hpp>

#include <optional>
#include <span>
#include <string>

namespace cusp::inspect {

struct SectionForm {
    FormFit form;
    std::optional<Scallops> scallops;
    std::string note;  ///< why there are no scallops, one sentence; empty when there are
};

/// The form under the deviations of a section, and the ridges over it. With a planned step-over (0: not known) the form
/// keeps its half-waves longer than two of them, so that scallops stay over it.
/// Errors: those of `fitForm`.
[[nodiscard]] base::Result<SectionForm> evaluateSection(std::span<const double> arc_length_mm,
                                                        std::span<const double> deviation_mm,
                                                        double planned_step_over_mm);

/// {"form": {"order", "rms_mm", "text"}, "scallops": {"count", "planned_count", "mean_spacing_mm",
/// "planned_step_over_mm", "mean_height_mm", "max_height_mm"} or null, "note"}.
[[nodiscard]] base::Json toJson(const SectionForm& section, double planned_step_over_mm);

}  // namespace cusp::inspect
