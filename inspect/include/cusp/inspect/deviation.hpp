// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Deviations along the outward normal, their statistics, and which of them are outliers.
#pragma once

#include <cusp/geometry/closest_point.hpp>
#include <cusp/inspect/measured_points.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cusp::inspect {

/// One measured point against the nominal, in the nominal frame, mm.
struct PointDeviation {
    Vector3 nominal = Vector3::Zero();  ///< footpoint on the nominal
    Vector3 normal = Vector3::UnitZ();  ///< there, out of the material
    double deviation_mm = 0.0;          ///< along the normal, > 0 outside the material; probe radius taken off
    double beyond_edge_mm = 0.0;        ///< how far the point lies beyond an edge of the nominal, across the normal

    /// The surface point the measurement speaks of.
    [[nodiscard]] Vector3 surfacePoint() const { return nominal + deviation_mm * normal; }
};

/// Deviations of points moved by `nominal_from_measured`; `offset_mm` is the probe's radius for centres, 0 for surface
/// points. In parallel, the same bits at any number of threads.
[[nodiscard]] std::vector<PointDeviation> deviationsOf(std::span<const Vector3> points,
                                                       const RigidTransform& nominal_from_measured,
                                                       const geometry::NominalShape& nominal, double offset_mm);

struct DeviationStatistics {
    std::size_t count = 0;
    double min_mm = 0.0;
    double max_mm = 0.0;
    double mean_mm = 0.0;
    double rms_mm = 0.0;                 ///< about zero
    double standard_deviation_mm = 0.0;  ///< about the mean, N − 1
    double median_mm = 0.0;
    double mad_mm = 0.0;  ///< median of |deviation − median|
    double profile_mm =
        0.0;  ///< ISO 1101 profile deviation: 2·max|deviation|, the total width of a zone about the nominal
    std::size_t min_point = 0;  ///< index of the extreme
    std::size_t max_point = 0;
};

[[nodiscard]] DeviationStatistics statisticsOf(std::span<const double> deviations_mm);

/// Equal bins from `low_mm` on; every deviation is in one of them.
struct Histogram {
    double low_mm = 0.0;
    double bin_width_mm = 0.0;
    std::vector<std::size_t> counts;
};

/// Bins of a round width (1, 2 or 5 times a power of ten), about `wanted_bins` of them.
[[nodiscard]] Histogram histogramOf(std::span<const double> deviations_mm, std::size_t wanted_bins = 40);

/// The rule for outliers: |deviation − median| > factor · 1.4826 · MAD, but never within `floor_mm` of the median.
/// 1.4826·MAD is σ for a normal distribution, of which factor 5 would flag one point in 1.7 million.
struct OutlierRule {
    double factor = 5.0;
    double floor_mm = 1e-4;
};
[[nodiscard]] double outlierDistance(const DeviationStatistics& statistics, const OutlierRule& rule);

}  // namespace cusp::inspect
