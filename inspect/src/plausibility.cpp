// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Sizes, probe and fit looked at with common sense.
#include "plausibility.hpp"

#include <cusp/inspect/pose_search.hpp>

#include <Eigen/Eigenvalues>
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
    out.reserve(most);
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
    // A few points that lie on the nominal by chance, the others beyond its edges, are no fit.
    constexpr std::size_t one_in = 10;
    const bool fits = summary && one_in * summary->beyond_edge <= points.size();
    return fits ? summary->rms_mm : std::numeric_limits<double>::infinity();
}

struct Flatness {
    bool is_flat = false;
    Vector3 normal = Vector3::UnitZ();
};

/// Flat: the points scatter across their plane by less than a ten-thousandth of how they scatter along it.
Flatness flatnessOf(const std::vector<Vector3>& points) {
    Vector3 center = Vector3::Zero();
    for (const Vector3& p : points) center += (p - points.front()) / static_cast<double>(points.size());
    center += points.front();
    geometry::Matrix3 moments = geometry::Matrix3::Zero();
    for (const Vector3& p : points) moments += (p - center) * (p - center).transpose();
    const Eigen::SelfAdjointEigenSolver<geometry::Matrix3> eigen(moments);
    constexpr double flat = 1e-4;
    return {eigen.eigenvalues()[0] <= flat * flat * eigen.eigenvalues()[2], eigen.eigenvectors().col(0)};
}

/// The share of points that a robust fit leaves aside, when it fits the others well; 0 when it does not.
double outlierShare(const std::vector<Vector3>& points, const geometry::NominalShape& nominal,
                    const InspectionOptions& options, double offset_mm) {
    AlignmentOptions robust;
    robust.fit = options.fit == FitKind::None ? FitKind::None : FitKind::LeastSquares;
    robust.locked = options.locked;
    robust.start = options.start;
    robust.offset_mm = offset_mm;
    robust.loss = Loss::Tukey;
    const auto summary = align(points, nominal, robust);
    if (!summary) return 0.0;
    std::vector<double> sizes;
    for (const PointDeviation& d : deviationsOf(points, summary->nominal_from_measured, nominal, offset_mm))
        sizes.push_back(std::hypot(d.deviation_mm, d.beyond_edge_mm));
    std::sort(sizes.begin(), sizes.end());
    const double spread_mm = 1.4826 * sizes[sizes.size() / 2];
    if (spread_mm > 0.2 * poorFitLimit(nominal)) return 0.0;
    const auto first = std::upper_bound(sizes.begin(), sizes.end(), std::max(5.0 * spread_mm, 1e-4));
    return static_cast<double>(sizes.end() - first) / static_cast<double>(sizes.size());
}

/// The error `inspect.side` when the points fit as centres of a probe inside the material, and far worse otherwise.
std::optional<base::Diagnostics> checkSide(const MeasuredPoints& points, const geometry::NominalShape& nominal,
                                           double as_inner_centres_mm, double otherwise_mm) {
    constexpr double far_better = 0.5;
    constexpr double rounding_mm = 1e-6;
    if (!(as_inner_centres_mm <= poorFitLimit(nominal))) return std::nullopt;
    if (!(as_inner_centres_mm + rounding_mm < far_better * otherwise_mm)) return std::nullopt;
    base::Diagnostics out;
    out.error(
        "inspect.side",
        fmt::format("the points fit as centres of a probe on the inner side of the nominal (rms {:.3g} mm, otherwise "
                    "{:.3g} mm): its outward normal points into the material; turn it by --flip-nominal",
                    as_inner_centres_mm, otherwise_mm),
        fileOf(points));
    return out;
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
    // A handful may lie close together.
    constexpr std::size_t handful = 6;
    if (ratio < too_small && points.size() < handful) return std::nullopt;
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
    if (points.kind != PointKind::Surface)
        if (auto problem = checkSide(points, nominal, rmsWith(sample, nominal, options, -*radius), better_mm))
            return base::fail(*std::move(problem));
    if (points.kind) {
        out.kind = *points.kind;
        out.source = "stated";
        if (centres_fit_better != (out.kind == PointKind::Centre) && worse_mm > 2.5 * better_mm)
            report.warning(
                "inspect.kind",
                fmt::format("stated are {}, but the points fit as {} far better (rms {:.3g} mm instead of {:.3g} "
                            "mm)",
                            out.kind == PointKind::Centre ? "probe centres" : "surface points",
                            centres_fit_better ? "probe centres" : "surface points", better_mm, worse_mm),
                fileOf(points));
    } else {
        if (!(better_mm <= poorFitLimit(nominal)))
            return base::fail(
                "inspect.kind",
                fmt::format("the points fit neither as probe centres nor as surface points: {}; which they "
                            "are can then be said with --points",
                            explainPoorFit(points, nominal, options, *radius).cause),
                fileOf(points));
        constexpr double rounding_mm = 1e-6;
        if (!(worse_mm > 1.5 * better_mm + rounding_mm))
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

std::optional<base::Diagnostics> checkPlane(const MeasuredPoints& points, const geometry::NominalShape& nominal,
                                            const InspectionOptions& options) {
    const bool all_free = std::none_of(options.locked.begin(), options.locked.end(), [](bool lock) { return lock; });
    if (options.fit == FitKind::None || !all_free || points.size() < 4) return std::nullopt;
    const Flatness measured = flatnessOf(points.positions);
    if (!measured.is_flat) return std::nullopt;
    std::vector<Vector3> surface;
    for (const geometry::Footpoint& foot : sampleNominal(nominal, 200)) surface.push_back(foot.position);
    if (surface.size() < 4 || flatnessOf(surface).is_flat) return std::nullopt;
    Eigen::Index across = 0;
    (options.start.linear() * measured.normal).cwiseAbs().maxCoeff(&across);
    constexpr std::array<std::string_view, 3> freedoms{"ty, tz, rx", "tx, tz, ry", "tx, ty, rz"};
    base::Diagnostics out;
    out.error("align.not-determined",
              fmt::format(
                  "the fit is not determined: all {} points lie in one plane, the nominal does not; nothing holds {}; "
                  "measure in other planes too, or lock them",
                  points.size(), freedoms.at(static_cast<std::size_t>(across))),
              fileOf(points));
    return out;
}

double poorFitLimit(const geometry::NominalShape& nominal) {
    constexpr double of_the_size = 0.002;
    return of_the_size * nominal.bounds().diagonal().norm();
}

Doubt explainPoorFit(const MeasuredPoints& points, const geometry::NominalShape& nominal,
                     const InspectionOptions& options, double offset_mm) {
    const double share = outlierShare(sampled(points.positions), nominal, options, offset_mm);
    if (share > 0.0)
        return {"inspect.many-outliers",
                fmt::format(
                    "about {:.0f} % of the points are outliers, which pull the fit; look at them, or fit with --loss "
                    "tukey",
                    100.0 * share)};
    PoseSearchOptions search;
    search.offset_mm = offset_mm;
    if (searchPose(points.positions, nominal, search).rms_mm < poorFitLimit(nominal))
        return {"inspect.poor-fit", "the start is too far off; --start scan finds one"};
    search.mirrored = true;
    if (searchPose(points.positions, nominal, search).rms_mm < poorFitLimit(nominal))
        return {"inspect.poor-fit",
                "the mirror image of the points fits: a mirrored part, or an axis of the wrong sign"};
    return {"inspect.poor-fit", "a wrong nominal, a part far out of shape, or points that are not of this surface"};
}

}  // namespace cusp::inspect
