// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Deviations of all points, and what a histogram and a few numbers say of them.
#include <cusp/inspect/deviation.hpp>

#include <algorithm>
#include <cmath>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

namespace cusp::inspect {
namespace {

/// The element in the middle; of an even number, the mean of the two.
double medianOf(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

PointDeviation deviationAt(const Vector3& moved, const geometry::Footpoint& foot, double offset_mm) {
    PointDeviation out;
    out.nominal = foot.position;
    out.normal = foot.normal;
    out.deviation_mm = foot.distance_mm - offset_mm;
    if (!foot.on_boundary) return out;
    const Vector3 away = moved - foot.position;
    const double along_mm = away.dot(foot.normal);
    out.deviation_mm = along_mm - offset_mm;
    out.beyond_edge_mm = (away - along_mm * foot.normal).norm();
    return out;
}

}  // namespace

std::vector<PointDeviation> deviationsOf(std::span<const Vector3> points, const RigidTransform& nominal_from_measured,
                                         const geometry::NominalShape& nominal, double offset_mm) {
    std::vector<Vector3> moved(points.size());
    std::transform(points.begin(), points.end(), moved.begin(),
                   [&](const Vector3& p) { return nominal_from_measured * p; });
    std::vector<geometry::Footpoint> footpoints(points.size());
    nominal.closest(moved, footpoints, false);
    std::vector<PointDeviation> out(points.size());
    const oneapi::tbb::blocked_range<std::size_t> all(0, points.size(), 4096);
    oneapi::tbb::parallel_for(all, [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i)
            out[i] = deviationAt(moved[i], footpoints[i], offset_mm);
    });
    return out;
}

DeviationStatistics statisticsOf(std::span<const double> deviations_mm) {
    DeviationStatistics out;
    out.count = deviations_mm.size();
    if (deviations_mm.empty()) return out;
    double sum = 0.0;
    double square_sum = 0.0;
    for (std::size_t i = 0; i < deviations_mm.size(); ++i) {
        const double d = deviations_mm[i];
        sum += d;
        square_sum += d * d;
        if (d < deviations_mm[out.min_point]) out.min_point = i;
        if (d > deviations_mm[out.max_point]) out.max_point = i;
    }
    const auto n = static_cast<double>(out.count);
    out.min_mm = deviations_mm[out.min_point];
    out.max_mm = deviations_mm[out.max_point];
    out.profile_mm = 2.0 * std::max(std::abs(out.min_mm), std::abs(out.max_mm));
    out.mean_mm = sum / n;
    out.rms_mm = std::sqrt(square_sum / n);
    double scatter = 0.0;
    for (const double d : deviations_mm) scatter += (d - out.mean_mm) * (d - out.mean_mm);
    if (out.count > 1) out.standard_deviation_mm = std::sqrt(scatter / (n - 1.0));
    std::vector<double> values(deviations_mm.begin(), deviations_mm.end());
    out.median_mm = medianOf(values);
    for (double& value : values) value = std::abs(value - out.median_mm);
    out.mad_mm = medianOf(values);
    return out;
}

Histogram histogramOf(std::span<const double> deviations_mm, std::size_t wanted_bins) {
    Histogram out;
    if (deviations_mm.empty() || wanted_bins == 0) return out;
    const auto [low, high] = std::minmax_element(deviations_mm.begin(), deviations_mm.end());
    // Equal deviations still fill one bin of some width.
    const double range = std::max(*high - *low, 1e-9);
    const double wanted = range / static_cast<double>(wanted_bins);
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    out.bin_width_mm = 10.0 * decade;
    for (const double factor : {5.0, 2.0, 1.0})
        if (factor * decade >= wanted) out.bin_width_mm = factor * decade;
    const double first = std::floor(*low / out.bin_width_mm);
    out.low_mm = first * out.bin_width_mm;
    const auto binOf = [&](double d) {
        return static_cast<std::size_t>(std::max(0.0, std::floor(d / out.bin_width_mm) - first));
    };
    out.counts.assign(binOf(*high) + 1, 0);
    for (const double d : deviations_mm) ++out.counts[binOf(d)];
    return out;
}

double outlierDistance(const DeviationStatistics& statistics, const OutlierRule& rule) {
    return std::max(rule.factor * 1.4826 * statistics.mad_mm, rule.floor_mm);
}

}  // namespace cusp::inspect
