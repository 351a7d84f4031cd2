// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Many parts: capability and trend of every characteristic.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/inspect/qif_results.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cusp::inspect {

/// The same characteristic of the same feature on every part, in the order the parts were measured. mm or rad.
struct CapabilitySeries {
    std::string name;
    std::string kind;
    std::string feature;  ///< empty: the characteristic names none
    bool is_angle = false;
    std::optional<double> target, lower, upper;
    std::vector<double> values;
    std::vector<std::size_t> parts;  ///< of each value

    double mean = 0.0;
    double min = 0.0;
    double max = 0.0;
    /// All values about their mean, n − 1: what the process did over all parts.
    std::optional<double> overall_deviation;
    /// From part to part only: mean moving range / 1.128 (ISO 7870-2:2013, individuals): what the process could hold.
    std::optional<double> within_deviation;
    std::size_t beyond_limits = 0;

    /// ISO 22514-2:2017 with these deviations: (upper − lower)/6σ, and the smaller of (upper − mean)/3σ, (mean − lower)/3σ.
    /// C with `within_deviation`, P with `overall_deviation`. Cp and Pp need both limits; with one limit Cpk and Ppk are of
    /// that side. Absent with no spread or no limit.
    std::optional<double> cp, cpk, pp, ppk;

    /// Least-squares slope from part to part, and the two-sided probability that an order without trend looks like this
    /// (Mann 1945, Kendall 1975: rank test with ties, normal approximation; from 8 values on).
    std::optional<double> slope_per_part;
    std::optional<double> trend_probability;
    /// Values farther than 3 within_deviation from the mean (Shewhart's rule).
    std::vector<std::size_t> out_of_control;
};

/// Series in the order in which characteristics and features first appear. Files are taken one after the other: parts count
/// on; a characteristic is the same when name, kind and feature are.
/// Errors: `capability.limits` when files state different limits for one characteristic.
[[nodiscard]] base::Result<std::vector<CapabilitySeries>> capabilityOf(std::span<const QifResults> files);

/// The summary of `cusp capability`: docs/json.md.
[[nodiscard]] base::Json capabilityJson(std::span<const QifResults> files, std::span<const CapabilitySeries> series);

}  // namespace cusp::inspect
