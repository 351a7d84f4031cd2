// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Which points make a deviation field, and how short its waves may be.
#include "evaluation_field.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cusp::inspect {
namespace {

using geometry::DeviationField;
using geometry::DeviationFieldOptions;
using geometry::DeviationSample;

/// Points that count and are no outliers, in the order of the file.
std::vector<DeviationSample> samplesOf(const Evaluation& evaluation, double edge_tolerance_mm) {
    std::vector<DeviationSample> out;
    auto outlier = evaluation.outliers.begin();  // ascending
    for (std::size_t i = 0; i < evaluation.deviations.size(); ++i) {
        if (outlier != evaluation.outliers.end() && *outlier == i) {
            ++outlier;
            continue;
        }
        const PointDeviation& d = evaluation.deviations[i];
        if (d.beyond_edge_mm <= edge_tolerance_mm) out.push_back({d.nominal, d.normal, d.deviation_mm});
    }
    return out;
}

/// Four step-overs, or what the field would take without a plan if that is longer.
double shortestWave(const std::vector<DeviationSample>& samples, double planned_step_over_mm) {
    if (!(planned_step_over_mm > 0.0)) return 0.0;
    Eigen::AlignedBox3d box;
    for (const DeviationSample& sample : samples) box.extend(sample.position);
    constexpr double step_overs = 4.0;
    constexpr double quarter = 0.25;
    return std::max(step_overs * planned_step_over_mm, box.isEmpty() ? 0.0 : quarter * box.sizes().maxCoeff());
}

}  // namespace

void addDeviationFields(InspectionReport& report, const InspectionOptions& options) {
    if (!report.doubts.empty()) {
        report.no_field = "withheld: " + report.doubts.front();
        return;
    }
    for (Evaluation* evaluation : {&report.datum, &report.best_fit}) {
        const std::vector<DeviationSample> samples = samplesOf(*evaluation, options.edge_tolerance_mm);
        DeviationFieldOptions field;
        field.shortest_wave_mm = shortestWave(samples, options.planned_step_over_mm);
        auto found = DeviationField::fit(samples, field);
        if (found)
            evaluation->field = *std::move(found);
        else
            report.no_field = found.error().front().message;
    }
}

}  // namespace cusp::inspect
