// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The flags of `cusp inspect` as text, and what they mean.
#pragma once

#include <cusp/inspect/inspection.hpp>
#include <cusp/inspect/point_reader.hpp>

#include <optional>
#include <string>
#include <vector>

namespace cusp::cli {

struct InspectFlags {
    std::string points_file;
    std::string nominal;
    bool flip_nominal = false;
    std::string output;
    std::string format;
    std::string columns;
    std::string units;
    std::string decimal;
    std::string kind;
    std::optional<double> probe_radius_mm;
    double probe_form_mm = 0.0;
    std::string fit = "least-squares";
    std::vector<std::string> lock;
    std::string loss = "squared";
    double loss_scale_mm = 0.0;
    bool weights = false;
    std::string start = "given";
    std::string references;
    std::string sections;
    std::optional<double> section_width_mm;
    double step_over_mm = 0.0;
    std::vector<double> limits_mm;
    std::optional<double> profile_t_mm;
    std::optional<double> uncertainty_mm;
    std::string rule = "probability";
    std::string judge;
    std::string qif_schema;
    bool json = false;
};

[[nodiscard]] inspect::PointReaderOptions readerOptions(const InspectFlags& flags);

/// All but the start pose. Errors: `sections.text`, `inspect.limits`.
[[nodiscard]] base::Result<inspect::InspectionOptions> inspectionOptions(const InspectFlags& flags);

}  // namespace cusp::cli
