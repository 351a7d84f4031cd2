// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Sorting measurements into series, and the figures of each.
#include <cusp/inspect/capability.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace cusp::inspect {

namespace {

using Limit = std::optional<double>;

constexpr std::size_t least_for_trend = 8;
/// Of the range of two normal values: 2/√π.
const double d2_of_two = 2.0 / std::sqrt(std::numbers::pi);

void setSpread(CapabilitySeries& s) {
    const auto n = static_cast<double>(s.values.size());
    for (const double value : s.values) s.mean += value / n;
    const auto [low, high] = std::minmax_element(s.values.begin(), s.values.end());
    s.min = *low;
    s.max = *high;
    if (s.values.size() < 2) return;
    double squares = 0.0;
    double ranges = 0.0;
    for (std::size_t i = 0; i < s.values.size(); ++i) {
        squares += (s.values[i] - s.mean) * (s.values[i] - s.mean);
        if (i > 0) ranges += std::abs(s.values[i] - s.values[i - 1]);
    }
    s.overall_deviation = std::sqrt(squares / (n - 1.0));
    s.within_deviation = ranges / (n - 1.0) / d2_of_two;
}

/// A spread of rounding only is none: the parts are all alike as far as they were measured.
bool isSpread(const Limit& deviation, double mean) { return deviation && *deviation > 1e-12 * (1.0 + std::abs(mean)); }

Limit indexOf(const CapabilitySeries& s, const Limit& deviation) {
    if (!s.lower || !s.upper || !isSpread(deviation, s.mean)) return std::nullopt;
    return (*s.upper - *s.lower) / (6.0 * *deviation);
}

Limit nearerIndexOf(const CapabilitySeries& s, const Limit& deviation) {
    if ((!s.lower && !s.upper) || !isSpread(deviation, s.mean)) return std::nullopt;
    Limit nearer;
    if (s.upper) nearer = (*s.upper - s.mean) / (3.0 * *deviation);
    if (s.lower) {
        const double below = (s.mean - *s.lower) / (3.0 * *deviation);
        nearer = nearer ? std::min(*nearer, below) : below;
    }
    return nearer;
}

void setIndices(CapabilitySeries& s) {
    s.cp = indexOf(s, s.within_deviation);
    s.cpk = nearerIndexOf(s, s.within_deviation);
    s.pp = indexOf(s, s.overall_deviation);
    s.ppk = nearerIndexOf(s, s.overall_deviation);
    for (std::size_t i = 0; i < s.values.size(); ++i) {
        if ((s.lower && s.values[i] < *s.lower) || (s.upper && s.values[i] > *s.upper)) ++s.beyond_limits;
        if (isSpread(s.within_deviation, s.mean) && std::abs(s.values[i] - s.mean) > 3.0 * *s.within_deviation)
            s.out_of_control.push_back(s.parts[i]);
    }
}

double slopeOf(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    const double middle = (n - 1.0) / 2.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += (static_cast<double>(i) - middle) * values[i];
    return sum / (n * (n * n - 1.0) / 12.0);
}

/// Kendall's S, its variance with ties, and the probability of one as large.
Limit trendProbability(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    double s = 0.0;
    std::map<double, double> ties;
    for (std::size_t i = 0; i < values.size(); ++i) {
        ties[values[i]] += 1.0;
        for (std::size_t j = i + 1; j < values.size(); ++j)
            s += values[j] > values[i] ? 1.0 : (values[j] < values[i] ? -1.0 : 0.0);
    }
    double variance = n * (n - 1.0) * (2.0 * n + 5.0);
    for (const auto& [value, count] : ties) variance -= count * (count - 1.0) * (2.0 * count + 5.0);
    variance /= 18.0;
    if (!(variance > 0.0)) return std::nullopt;
    // Corrected for continuity.
    const double z = std::max(0.0, std::abs(s) - 1.0) / std::sqrt(variance);
    return std::erfc(z / std::numbers::sqrt2);
}

void setTrend(CapabilitySeries& s) {
    if (s.values.size() < 2) return;
    s.slope_per_part = slopeOf(s.values);
    if (s.values.size() >= least_for_trend) s.trend_probability = trendProbability(s.values);
}

bool sameLimit(const Limit& a, const Limit& b) {
    if (a.has_value() != b.has_value()) return false;
    return !a || std::abs(*a - *b) <= 1e-12 * (1.0 + std::abs(*a));
}

base::Json jsonOf(const Limit& value) { return value ? base::Json(*value) : base::Json(nullptr); }

base::Json toJson(const CapabilitySeries& s) {
    const std::string unit = s.is_angle ? "_rad" : "_mm";
    base::Json out;
    out["name"] = s.name;
    out["kind"] = s.kind;
    out["feature"] = s.feature.empty() ? base::Json(nullptr) : base::Json(s.feature);
    out["target" + unit] = jsonOf(s.target);
    out["lower" + unit] = jsonOf(s.lower);
    out["upper" + unit] = jsonOf(s.upper);
    out["count"] = s.values.size();
    out["mean" + unit] = s.mean;
    out["min" + unit] = s.min;
    out["max" + unit] = s.max;
    out["overall_deviation" + unit] = jsonOf(s.overall_deviation);
    out["within_deviation" + unit] = jsonOf(s.within_deviation);
    out["cp"] = jsonOf(s.cp);
    out["cpk"] = jsonOf(s.cpk);
    out["pp"] = jsonOf(s.pp);
    out["ppk"] = jsonOf(s.ppk);
    out["beyond_limits"] = s.beyond_limits;
    out["slope" + unit + "_per_part"] = jsonOf(s.slope_per_part);
    out["trend_probability"] = jsonOf(s.trend_probability);
    out["out_of_control"] = s.out_of_control;
    out["values" + unit] = s.values;
    out["parts"] = s.parts;
    return out;
}

}  // namespace

base::Result<std::vector<CapabilitySeries>> capabilityOf(std::span<const QifResults> files) {
    std::vector<CapabilitySeries> out;
    std::map<std::tuple<std::string, std::string, std::string>, std::size_t> index;
    std::size_t parts_before = 0;
    for (const QifResults& file : files) {
        for (const QifMeasurement& measured : file.measurements) {
            const QifCharacteristic& c = file.characteristics[measured.characteristic];
            const auto [at, is_new] = index.try_emplace({c.name, c.kind, measured.feature}, out.size());
            if (is_new) {
                CapabilitySeries made;
                made.name = c.name;
                made.kind = c.kind;
                made.feature = measured.feature;
                made.is_angle = c.is_angle;
                made.target = c.target;
                made.lower = c.lower;
                made.upper = c.upper;
                out.push_back(std::move(made));
            }
            CapabilitySeries& series = out[at->second];
            if (!sameLimit(series.lower, c.lower) || !sameLimit(series.upper, c.upper))
                return base::fail("capability.limits",
                                  fmt::format("'{}' has other limits than in the files before", c.name),
                                  {file.source, 0, 0, {}});
            series.values.push_back(measured.value);
            series.parts.push_back(parts_before + measured.part);
        }
        parts_before += file.parts.size();
    }
    for (CapabilitySeries& series : out) {
        setSpread(series);
        setIndices(series);
        setTrend(series);
    }
    return out;
}

base::Json capabilityJson(std::span<const QifResults> files, std::span<const CapabilitySeries> series) {
    base::Json out = base::jsonReport("capability", 1);
    out["files"] = base::Json::array();
    out["parts"] = base::Json::array();
    for (const QifResults& file : files) {
        out["files"].push_back({{"file", file.source},
                                {"qif_version", file.version},
                                {"parts", file.parts.size()},
                                {"measurements", file.measurements.size()},
                                {"without_value", file.without_value}});
        for (const QifPart& part : file.parts) out["parts"].push_back(part.label);
    }
    out["characteristics"] = base::Json::array();
    for (const CapabilitySeries& one : series) out["characteristics"].push_back(toJson(one));
    return out;
}

}  // namespace cusp::inspect
