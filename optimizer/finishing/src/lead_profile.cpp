// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Three passes over stations: wanted, slope-limited upper envelope, average of running maxima.
#include "lead_profile.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::finishing {

namespace {

/// The smallest values no less than `leads` that change by no more than `slope` per mm.
void limitSlope(std::vector<double>& leads, const std::vector<double>& along, double slope) {
    for (std::size_t i = 1; i < leads.size(); ++i)
        leads[i] = std::max(leads[i], leads[i - 1] - slope * (along[i] - along[i - 1]));
    for (std::size_t i = leads.size() - 1; i-- > 0;)
        leads[i] = std::max(leads[i], leads[i + 1] - slope * (along[i + 1] - along[i]));
}

/// The average over a window of the running maximum over the same window is no less than the value in its middle.
std::vector<double> smoothed(const std::vector<double>& leads, std::size_t half) {
    const std::size_t n = leads.size();
    std::vector<double> highest(n);
    std::vector<double> out(n);
    for (std::size_t i = 0; i < n; ++i) {
        const auto from = leads.begin() + static_cast<std::ptrdiff_t>(i - std::min(i, half));
        const auto to = leads.begin() + static_cast<std::ptrdiff_t>(std::min(n, i + half + 1));
        highest[i] = *std::max_element(from, to);
    }
    for (std::size_t i = 0; i < n; ++i) {
        double sum = 0.0;
        // Beyond the ends the last value holds, so that the window stays symmetric and the profile smooth.
        for (std::size_t k = 0; k <= 2 * half; ++k) sum += highest[std::clamp(i + k, half, n - 1 + half) - half];
        out[i] = sum / static_cast<double>(2 * half + 1);
    }
    return out;
}

}  // namespace

LeadProfile::LeadProfile(const PassCurve& pass, const geometry::Cutter& cutter, const OrientationOptions& orientation) {
    if (!orientation.adaptive) {
        leads_ = {orientation.lead_rad};
        return;
    }
    constexpr double station_mm = 0.5;
    const auto count = static_cast<std::size_t>(std::clamp(std::ceil(pass.length() / station_mm), 32.0, 2048.0)) + 1;
    std::vector<double> along(count, 0.0);
    Vector3 before = Vector3::Zero();
    for (std::size_t i = 0; i < count; ++i) {
        const PassPoint point = pass.at(static_cast<double>(i) / static_cast<double>(count - 1));
        leads_.push_back(wantedLead(cutter, point, orientation));
        if (i > 0) along[i] = along[i - 1] + (point.surface.position - before).norm();
        before = point.surface.position;
    }
    limitSlope(leads_, along, orientation.lead_change_rad_per_mm);
    const double spacing = along.back() / static_cast<double>(count - 1);
    const double half = spacing > 0.0 ? orientation.smoothing_mm / (2.0 * spacing) : 0.0;
    leads_ = smoothed(leads_, static_cast<std::size_t>(std::min(half, static_cast<double>(count - 1))));
}

double LeadProfile::at(double t) const {
    if (leads_.size() == 1) return leads_.front();
    const double along = std::clamp(t, 0.0, 1.0) * static_cast<double>(leads_.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(along), leads_.size() - 2);
    return std::lerp(leads_[i], leads_[i + 1], along - static_cast<double>(i));
}

}  // namespace cusp::finishing
