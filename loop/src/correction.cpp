// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Compares what two paths leave, point by point.
#include <cusp/loop/correction.hpp>

#include <cusp/simulation/surface_envelope.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::loop {

base::Result<CorrectionCheck> checkCorrection(const toolpath::ToolPath& path, const toolpath::ToolPath& corrected,
                                              const geometry::ParametricSurface& nominal,
                                              const geometry::DeviationField& field,
                                              const toolpath::CompensationOptions& options, double spacing_mm,
                                              double allowed_mm) {
    const auto before_job = cutJob(path);
    if (!before_job) return base::fail(before_job.error());
    const auto after_job = cutJob(corrected);
    if (!after_job) return base::fail(after_job.error());
    simulation::EnvelopeOptions envelope;
    envelope.spacing_mm = spacing_mm;
    const auto before = simulation::surfaceEnvelope(before_job->path, nominal.faces(), envelope);
    if (!before) return base::fail(before.error());
    const auto after = simulation::surfaceEnvelope(after_job->path, nominal.faces(), envelope);
    if (!after) return base::fail(after.error());
    CorrectionCheck out{.allowed_mm = allowed_mm};
    // Where the first path leaves more than this stands stock that no pass made into surface: the strip beside the outer
    // ones. As long as stock stays there, nothing is gouged.
    constexpr double stock_mm = 0.02;
    for (std::size_t i = 0; i < before->points.size(); ++i) {
        const auto& one = before->points[i];
        const auto& other = after->points[i];
        if (!one.reached() || !other.reached()) continue;
        if (one.deviation_mm > stock_mm && other.deviation_mm > 0.0) continue;
        const simulation::GridPoint& at = before->grid.points[i];
        const double change = other.deviation_mm - one.deviation_mm;
        const double meant = toolpath::compensationAt(at.position, at.normal, field, options);
        ++out.points;
        out.max_change_mm = std::max(out.max_change_mm, std::abs(change));
        out.left_mm = std::max(out.left_mm, change - meant);
        if (meant - change > out.gouge_mm) {
            out.gouge_mm = meant - change;
            out.gouge_at_mm = at.position;
        }
    }
    return out;
}

}  // namespace cusp::loop
