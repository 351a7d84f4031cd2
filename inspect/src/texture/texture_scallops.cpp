// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Scallops of a section: ridges between valleys, small ones left out.
#include <cusp/inspect/texture_form.hpp>

#include "texture/texture_portions.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

namespace cusp::inspect {

namespace {

constexpr std::size_t least_points = 8;
constexpr double least_points_per_step = 4.0;
constexpr double least_height_share = 0.25;
constexpr double least_length_share = 0.2;

double percentile(std::vector<double> values, double share) {
    const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + at, values.end());
    return values[static_cast<std::size_t>(at)];
}

/// Between points: the arc length at a place counted in points.
double positionAt(std::span<const double> position_mm, double place) {
    const auto i = std::min(static_cast<std::size_t>(place), position_mm.size() - 2);
    const double share = place - static_cast<double>(i);
    return position_mm[i] + share * (position_mm[i + 1] - position_mm[i]);
}

/// Where the curve is highest within a portion.
double ridgeOf(const TextureCurve& curve, const Portion& portion) {
    double best = portion.from;
    double highest = -std::numeric_limits<double>::infinity();
    for (const TextureCurve::Piece& piece : curve.pieces()) {
        const double at = static_cast<double>(piece.interval) + piece.to;
        if (at >= portion.from && at <= portion.to && piece.z_to > highest) {
            highest = piece.z_to;
            best = at;
        }
    }
    return best;
}

}  // namespace

base::Result<Scallops> findScallops(std::span<const double> position_mm, std::span<const double> over_form_mm,
                                    const ScallopOptions& options) {
    const std::size_t points = position_mm.size();
    if (points != over_form_mm.size() || points < least_points)
        return base::fail("form.points", fmt::format("{} points; {} are needed at least", points, least_points));
    const double length_mm = position_mm.back() - position_mm.front();
    const double step_mm = length_mm / static_cast<double>(points - 1);
    if (options.planned_step_over_mm > 0.0 && step_mm * least_points_per_step > options.planned_step_over_mm)
        return base::fail("scallops.too-coarse",
                          fmt::format("points lie {:.6g} mm apart; scallops of a step-over of {:.6g} mm need {:.6g} mm",
                                      step_mm, options.planned_step_over_mm,
                                      options.planned_step_over_mm / least_points_per_step));

    const std::vector<double> values(over_form_mm.begin(), over_form_mm.end());
    const double low = percentile(values, 0.05);
    const double high = percentile(values, 0.95);
    const TextureCurve curve(over_form_mm);
    const double middle = 0.5 * (low + high);
    const auto portions = significant(portionsAt(curve, middle), least_height_share * (high - low),
                                      least_length_share * options.planned_step_over_mm / step_mm);
    Scallops out;
    double heights = 0.0;
    for (std::size_t i = 1; i + 1 < portions.size(); ++i) {
        if (!portions[i].isPeak()) continue;
        const double height = portions[i].extreme - 0.5 * (portions[i - 1].extreme + portions[i + 1].extreme);
        heights += height;
        out.max_height_mm = std::max(out.max_height_mm, height);
        out.ridge_mm.push_back(positionAt(position_mm, ridgeOf(curve, portions[i])));
    }
    out.count = out.ridge_mm.size();
    if (out.count > 0) out.mean_height_mm = heights / static_cast<double>(out.count);
    if (out.count > 1)
        out.mean_spacing_mm = (out.ridge_mm.back() - out.ridge_mm.front()) / static_cast<double>(out.count - 1);
    if (options.planned_step_over_mm > 0.0) out.planned_count = length_mm / options.planned_step_over_mm;
    return out;
}

}  // namespace cusp::inspect
