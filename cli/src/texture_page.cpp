// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Curves thinned to what a screen can show, without losing a peak.
#include "texture_page.hpp"

#include <cusp/pages/render.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace cusp::cli {

namespace {

using base::Json;

constexpr std::size_t most_points = 8'000;
constexpr double um_per_mm = 1000.0;
constexpr double steps_per_um = 1e5;
constexpr double steps_per_mm = 1e6;

double rounded(double value, double steps) { return std::round(value * steps) / steps; }

/// `partner` is drawn at the same places, where it has points; null elsewhere.
Json curvesOf(const inspect::TextureBand& band, const inspect::TextureBand* partner, double spacing_mm) {
    Json x = Json::array();
    Json height = Json::array();
    Json other = Json::array();
    const auto shift = partner == nullptr ? 0 : std::llround((partner->begin_mm - band.begin_mm) / spacing_mm);
    for (const std::size_t i : outlineOf(band.height_mm, most_points)) {
        x.push_back(rounded(band.begin_mm + static_cast<double>(i) * spacing_mm, steps_per_mm));
        height.push_back(rounded(band.height_mm[i] * um_per_mm, steps_per_um));
        if (partner == nullptr) continue;
        const auto at = static_cast<std::ptrdiff_t>(i) - shift;
        const bool inside = at >= 0 && at < std::ssize(partner->height_mm);
        other.push_back(inside
                            ? Json(rounded(partner->height_mm[static_cast<std::size_t>(at)] * um_per_mm, steps_per_um))
                            : Json(nullptr));
    }
    Json out{{"x_mm", x}, {"height_um", height}};
    if (partner != nullptr) out["waviness_um"] = other;
    return out;
}

}  // namespace

std::vector<std::size_t> outlineOf(std::span<const double> values, std::size_t most) {
    std::vector<std::size_t> out;
    const std::size_t stretches = std::max<std::size_t>(1, most / 2);
    if (values.size() <= 2 * stretches) {
        for (std::size_t i = 0; i < values.size(); ++i) out.push_back(i);
        return out;
    }
    out.push_back(0);
    for (std::size_t k = 0; k < stretches; ++k) {
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(k * values.size() / stretches);
        const auto end = values.begin() + static_cast<std::ptrdiff_t>((k + 1) * values.size() / stretches);
        const auto [low, high] = std::minmax_element(begin, end);
        out.push_back(static_cast<std::size_t>(std::min(low, high) - values.begin()));
        out.push_back(static_cast<std::size_t>(std::max(low, high) - values.begin()));
    }
    out.push_back(values.size() - 1);
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
}

Json textureSummary(std::span<const inspect::TextureReport> reports) {
    Json summary = base::jsonReport("texture", 1);
    summary["profiles"] = Json::array();
    for (const inspect::TextureReport& report : reports) summary["profiles"].push_back(inspect::toJson(report));
    return summary;
}

base::Result<std::string> texturePage(std::span<const inspect::TextureReport> reports) {
    Json document = textureSummary(reports);
    for (std::size_t i = 0; i < reports.size(); ++i) {
        const inspect::TextureReport& report = reports[i];
        const double spacing_mm = report.profile.spacing_mm;
        document["profiles"][i]["curves"] = {{"primary", curvesOf(report.primary, &report.waviness, spacing_mm)},
                                             {"roughness", curvesOf(report.roughness, nullptr, spacing_mm)}};
    }
    return base::jsonText(document).and_then(
        [](const std::string& json) { return pages::renderPage("texture", json); });
}

}  // namespace cusp::cli
