// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Sizes, probe and fit looked at with common sense.
#include "plausibility.hpp"

#include <cusp/inspect/pose_search.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cusp::inspect {
namespace {

base::Location fileOf(const MeasuredPoints& points) {
    base::Location out;
    out.file = points.source;
    return out;
}

/// Every n-th point, so that 2000 are left.
std::vector<Vector3> sampled(const std::vector<Vector3>& points) {
    constexpr std::size_t most = 2000;
    if (points.size() <= most) return points;
    std::vector<Vector3> out;
    for (std::size_t i = 0; i < most; ++i) out.push_back(points[i * points.size() / most]);
    return out;
}

double rmsWith(const std::vector<Vector3>& points, const geometry::NominalShape& nominal,
               const InspectionOptions& options, double offset_mm) {
    AlignmentOptions fit;
    fit.fit = options.fit == FitKind::None ? FitKind::None : FitKind::LeastSquares;
    fit.locked = options.locked;
    fit.start = options.start;
    fit.offset_mm = offset_mm;
    fit.loss = options.loss;
    fit.loss_scale_mm = options.loss_scale_mm;
    const auto summary = align(points, nominal, fit);
    return summary ? summary->rms_mm : std::numeric_limits<double>::infinity();
}

struct Ratio {
    double factor;
    std::string_view text;
};
/// Factors from the unit assumed to the one meant.
constexpr std::array<Ratio, 6> unit_ratios{{{25.4, "inch read as mm"},
                                            {1000.0, "metres read as mm"},
                                            {10.0, "centimetres read as mm"},
                                            {1.0 / 25.4, "mm read as inch"},
                                            {1e-3, "micrometres read as mm"},
                                            {1.0 / 1000.0, "mm read as metres"}}};

}  // namespace

std::optional<base::Diagnostics> checkUnit(const MeasuredPoints& points, const geometry::NominalShape& nominal) {
    Eigen::AlignedBox3d box;
    for (const Vector3& p : points.positions) box.extend(p);
    const double measured_mm = box.diagonal().norm();
    const double nominal_mm = nominal.bounds().diagonal().norm();
    // Points of a part lie within it, but for a table or a fixture; a few may be measured on a tenth of it.
    constexpr double too_large = 4.0;
    constexpr double too_small = 0.1;
    const double ratio = measured_mm / std::max(nominal_mm, 1e-300);
    if (ratio >= too_small && ratio <= too_large) return std::nullopt;
    const Ratio* meant = nullptr;
    for (const Ratio& candidate : unit_ratios)
        if (ratio * candidate.factor >= 0.3 && ratio * candidate.factor <= 1.3 && meant == nullptr) meant = &candidate;
    if (meant == nullptr && ratio <= too_large) return std::nullopt;
    base::Diagnostics out;
    out.error(
        "inspect.unit",
        meant != nullptr
            ? fmt::format("the points span {:.4g} mm, the nominal {:.4g} mm: this looks like {}; say the unit of the "
                          "points with --units",
                          measured_mm, nominal_mm, meant->text)
            : fmt::format("the points span {:.4g} mm, the nominal only {:.4g} mm: wrong unit, wrong nominal, or far "
                          "more than the part",
                          measured_mm, nominal_mm),
        fileOf(points));
    return out;
}

base::Result<ProbeDecision> decideProbe(const MeasuredPoints& points, const geometry::NominalShape& nominal,
                                        const InspectionOptions& options, base::Diagnostics& report) {
    ProbeDecision out;
    const std::optional<double> radius = options.probe_radius_mm ? options.probe_radius_mm : points.probe_radius_mm;
    if (radius && !(*radius >= 0.0 && std::isfinite(*radius)))
        return base::fail("inspect.radius", "the probe's radius must not be negative");
    if (points.kind == PointKind::Centre && !radius)
        return base::fail("inspect.radius",
                          "the points are centres of the probe; its radius is needed: --probe-radius-mm",
                          fileOf(points));
    if (!radius || *radius == 0.0) {
        out.kind = PointKind::Surface;
        out.source = points.kind ? "stated" : "assumed: nothing speaks of a probe";
        return out;
    }
    const std::vector<Vector3> sample = sampled(points.positions);
    const double as_centres_mm = rmsWith(sample, nominal, options, *radius);
    const double as_surface_mm = rmsWith(sample, nominal, options, 0.0);
    const bool centres_fit_better = as_centres_mm < as_surface_mm;
    const double better_mm = std::min(as_centres_mm, as_surface_mm);
    const double worse_mm = std::max(as_centres_mm, as_surface_mm);
    if (points.kind) {
        out.kind = *points.kind;
        out.source = "stated";
        if (centres_fit_better != (out.kind == PointKind::Centre) && worse_mm > 5.0 * better_mm)
            report.warning(
                "inspect.kind",
                fmt::format("stated are {}, but the points fit as {} far better (rms {:.3g} mm instead of {:.3g} "
                            "mm)",
                            out.kind == PointKind::Centre ? "probe centres" : "surface points",
                            centres_fit_better ? "probe centres" : "surface points", better_mm, worse_mm),
                fileOf(points));
    } else {
        if (!(worse_mm > 1.5 * better_mm))
            return base::fail(
                "inspect.kind",
                fmt::format("are the points probe centres or surface points? Both fit (rms {:.3g} mm and {:.3g} "
                            "mm); say --points centre or --points surface",
                            as_centres_mm, as_surface_mm),
                fileOf(points));
        out.kind = centres_fit_better ? PointKind::Centre : PointKind::Surface;
        out.source =
            fmt::format("found: rms {:.3g} mm as centres, {:.3g} mm as surface points", as_centres_mm, as_surface_mm);
    }
    out.radius_mm = out.kind == PointKind::Centre ? *radius : 0.0;
    return out;
}

double poorFitLimit(const geometry::NominalShape& nominal) {
    constexpr double of_the_size = 0.002;
    return of_the_size * nominal.bounds().diagonal().norm();
}

std::string explainPoorFit(const MeasuredPoints& points, const geometry::NominalShape& nominal, double offset_mm,
                           double rms_mm) {
    PoseSearchOptions search;
    search.offset_mm = offset_mm;
    constexpr double clearly_better = 0.33;
    if (searchPose(points.positions, nominal, search).rms_mm < clearly_better * rms_mm)
        return "the start is too far off; --start scan finds one";
    search.mirrored = true;
    if (searchPose(points.positions, nominal, search).rms_mm < clearly_better * rms_mm)
        return "the mirror image of the points fits: a mirrored part, or an axis of the wrong sign";
    return "a wrong nominal, or a part far out of shape";
}

}  // namespace cusp::inspect
