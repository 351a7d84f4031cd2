// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Every parameter from one continuous curve, in the order of Fountas 2017, fig. 12.
#include <cusp/base/units.hpp>
#include <cusp/inspect/texture_parameters.hpp>

#include "texture/texture_curve.hpp"
#include "texture/texture_fractal.hpp"
#include "texture/texture_portions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <functional>
#include <numbers>

namespace cusp::inspect {

namespace {

using Value = std::optional<double>;

constexpr double um_per_mm = 1000.0;

/// One stretch of the profile, with what several parameters share.
struct Stretch {
    Stretch(std::span<const double> heights_mm, double spacing_mm_, const TextureConditions& conditions_)
        : curve(heights_mm),
          samples(heights_mm),
          spacing_mm(spacing_mm_),
          conditions(conditions_),
          portions(portionsAt(curve, 0.0)),
          elements(significant(portions, conditions_.height_share * (curve.highest() - curve.lowest()),
                               conditions_.least_length_mm / spacing_mm_)) {}

    double lengthMm() const { return curve.length() * spacing_mm; }
    double q() const {
        return std::sqrt(curve.mean([](double z, double) { return z * z; }));
    }
    double a() const {
        return curve.mean([](double z, double) { return std::abs(z); });
    }
    /// Of the angle's tangent.
    double rmsSlope() const {
        return std::sqrt(curve.mean([](double, double slope) { return slope * slope; })) / spacing_mm;
    }

    TextureCurve curve;
    std::span<const double> samples;
    double spacing_mm;
    TextureConditions conditions;
    std::vector<Portion> portions;  ///< about the mean line
    std::vector<Portion> elements;  ///< the significant ones
};

double moment(const Stretch& s, int power) {
    const double q = s.q();
    if (!(q > 0.0)) return 0.0;
    return s.curve.mean([q, power](double z, double) { return std::pow(z / q, power); });
}

/// The mean absolute slope: how much the curve goes up and down in all.
double meanSlope(const Stretch& s) {
    double travel = 0.0;
    for (const TextureCurve::Piece& piece : s.curve.pieces()) travel += std::abs(piece.z_to - piece.z_from);
    return travel / s.lengthMm();
}

double lengthening(const Stretch& s) {
    const double spacing = s.spacing_mm;
    // √(1 + m²) − 1 without cancellation.
    return s.curve.mean([spacing](double, double slope) {
        const double m = slope / spacing;
        return m * m / (1.0 + std::sqrt(1.0 + m * m));
    });
}

/// Whole elements: from the first crossing to the last one of the same direction.
std::size_t wholeElements(const Stretch& s) {
    const auto whole = std::count_if(s.elements.begin(), s.elements.end(), [](const Portion& p) { return p.whole(); });
    return static_cast<std::size_t>(whole) / 2;
}

/// The first of the portions that make whole elements.
std::size_t firstWhole(const Stretch& s) { return s.elements.front().begins ? 0 : 1; }

Value elementWidth(const Stretch& s) {
    const std::size_t count = wholeElements(s);
    if (count == 0) return {};
    const std::size_t first = firstWhole(s);
    const double width = s.elements[first + 2 * count - 1].to - s.elements[first].from;
    return width * s.spacing_mm / static_cast<double>(count);
}

Value elementHeight(const Stretch& s) {
    const std::size_t count = wholeElements(s);
    if (count == 0) return {};
    double sum = 0.0;
    for (std::size_t i = 0; i < 2 * count; ++i) sum += std::abs(s.elements[firstWhole(s) + i].extreme);
    return sum / static_cast<double>(count);
}

/// Heights of peaks (sign 1) or depths of valleys (sign −1), the largest first.
std::vector<double> extremes(const Stretch& s, double sign) {
    std::vector<double> out;
    for (const Portion& portion : s.portions)
        if (sign * portion.extreme > 0.0) out.push_back(sign * portion.extreme);
    std::sort(out.begin(), out.end(), std::greater<>());
    return out;
}

Value tenPointHeight(const Stretch& s) {
    constexpr std::size_t wanted = 5;
    const auto peaks = extremes(s, 1.0);
    const auto valleys = extremes(s, -1.0);
    if (peaks.size() < wanted || valleys.size() < wanted) return {};
    double sum = 0.0;
    for (std::size_t i = 0; i < wanted; ++i) sum += peaks[i] + valleys[i];
    return sum / static_cast<double>(wanted);
}

Value thirdHeight(const Stretch& s) {
    constexpr std::size_t third = 2;
    const auto peaks = extremes(s, 1.0);
    const auto valleys = extremes(s, -1.0);
    if (peaks.size() <= third || valleys.size() <= third) return {};
    return peaks[third] + valleys[third];
}

Value peakDistance(const Stretch& s) {
    const auto peaks = localPeaks(s.curve);
    if (peaks.size() < 2) return {};
    return (peaks.back() - peaks.front()) * s.spacing_mm / static_cast<double>(peaks.size() - 1);
}

double highSpots(const Stretch& s) {
    const auto portions = portionsAt(s.curve, s.curve.highest() - s.conditions.depth_mm);
    return static_cast<double>(
        std::count_if(portions.begin(), portions.end(), [](const Portion& p) { return p.whole() && p.isPeak(); }));
}

double heightBetween(const Stretch& s, double low_ratio, double high_ratio) {
    return s.curve.levelAtRatio(low_ratio) - s.curve.levelAtRatio(high_ratio);
}

double voidUnder(const Stretch& s) {
    const double lid = s.curve.levelAtRatio(s.conditions.void_ratio);
    return s.curve.mean([lid](double z, double) { return std::max(0.0, lid - z); }, lid);
}

/// The profile as stretches of one sampling length, what is left over at its end left out; or whole.
std::vector<Stretch> stretchesOf(std::span<const double> heights_mm, double spacing_mm,
                                 const TextureConditions& conditions) {
    const auto steps = static_cast<std::size_t>(std::llround(conditions.sampling_length_mm / spacing_mm));
    std::vector<Stretch> out;
    if (steps >= 2)
        for (std::size_t first = 0; first + steps < heights_mm.size(); first += steps)
            out.emplace_back(heights_mm.subspan(first, steps + 1), spacing_mm, conditions);
    if (out.empty()) out.emplace_back(heights_mm, spacing_mm, conditions);
    return out;
}

/// Collects parameters: means over the sampling lengths, or of the whole profile.
class Table {
public:
    Table(char letter, std::span<const double> heights_mm, double spacing_mm, const TextureConditions& conditions)
        : letter_(letter),
          stretches_(stretchesOf(heights_mm, spacing_mm, conditions)),
          whole_(heights_mm, spacing_mm, conditions) {}

    const Stretch& whole() const { return whole_; }

    /// Mean over the sampling lengths that have it.
    void mean(std::string_view name, std::string unit, double scale, std::string_view source,
              const std::function<Value(const Stretch&)>& parameter, std::string condition = {}) {
        double sum = 0.0;
        std::size_t count = 0;
        for (const Stretch& stretch : stretches_)
            if (const Value value = parameter(stretch)) {
                sum += *value;
                ++count;
            }
        add(name, std::move(unit), count == 0 ? Value() : Value(scale * sum / static_cast<double>(count)), source,
            std::move(condition));
    }

    void overAll(std::string_view name, std::string unit, double scale, std::string_view source, Value value,
                 std::string condition = {}) {
        add(name, std::move(unit), value ? Value(scale * *value) : value, source, std::move(condition));
    }

    std::vector<TextureParameter> take() { return std::move(parameters_); }

private:
    void add(std::string_view name, std::string unit, Value value, std::string_view source, std::string condition) {
        parameters_.push_back({letter_ + std::string(name), std::move(unit), value, std::move(condition), source});
    }

    char letter_;
    std::vector<Stretch> stretches_;
    Stretch whole_;
    std::vector<TextureParameter> parameters_;
};

void addHeights(Table& table) {
    table.mean("a", "um", um_per_mm, "ISO 4287:1997, 4.2.1", [](const Stretch& s) { return s.a(); });
    table.mean("q", "um", um_per_mm, "ISO 4287:1997, 4.2.2", [](const Stretch& s) { return s.q(); });
    table.mean("p", "um", um_per_mm, "ISO 4287:1997, 4.1.1", [](const Stretch& s) { return s.curve.highest(); });
    table.mean("v", "um", um_per_mm, "ISO 4287:1997, 4.1.2", [](const Stretch& s) { return -s.curve.lowest(); });
    const TextureCurve& whole = table.whole().curve;
    table.overAll("t", "um", um_per_mm, "ISO 4287:1997, 4.1.5", whole.highest() - whole.lowest());
    table.mean("sk", "", 1.0, "ISO 4287:1997, 4.2.3", [](const Stretch& s) { return moment(s, 3); });
    table.mean("ku", "", 1.0, "ISO 4287:1997, 4.2.4", [](const Stretch& s) { return moment(s, 4); });
    table.mean("z", "um", um_per_mm, "ISO 4287:1997, 4.1.3",
               [](const Stretch& s) { return s.curve.highest() - s.curve.lowest(); });
}

void addHybrids(Table& table) {
    const auto angle = [](double slope) { return base::degFromRad(std::atan(slope)); };
    table.mean("Dq", "deg", 1.0, "ISO 4287:1997, 4.4.1", [angle](const Stretch& s) { return angle(s.rmsSlope()); });
    table.mean("Lq", "mm", 1.0, "ISO 4287-1:1984", [](const Stretch& s) -> Value {
        if (!(s.rmsSlope() > 0.0)) return {};
        return 2.0 * std::numbers::pi * s.q() / s.rmsSlope();
    });
    table.mean("Lo", "percent", 100.0, "ISO 4287-1:1984, profile length ratio less 1", lengthening);
    table.mean("Da", "deg", 1.0, "ISO 4287-1:1984", [angle](const Stretch& s) { return angle(meanSlope(s)); });
    table.mean("La", "mm", 1.0, "ISO 4287-1:1984", [](const Stretch& s) -> Value {
        if (!(meanSlope(s) > 0.0)) return {};
        return 2.0 * std::numbers::pi * s.a() / meanSlope(s);
    });
}

void addBearing(Table& table) {
    const Stretch& s = table.whole();
    const TextureConditions& c = s.conditions;
    const std::string depth = fmt::format("{:.6g} um under the highest peak", c.depth_mm * um_per_mm);
    const std::string ratios = fmt::format("{:.6g}%-{:.6g}%", 100.0 * c.low_ratio, 100.0 * c.high_ratio);
    const double share = s.curve.materialRatio(s.curve.highest() - c.depth_mm);
    const double height_mm = heightBetween(s, c.low_ratio, c.high_ratio);
    constexpr double swedish_low = 0.05;
    constexpr double swedish_high = 0.90;
    table.overAll("Tp", "percent", 100.0, "ISO 4287-1:1984, bearing ratio", share, depth);
    table.overAll("HTp", "um", um_per_mm, "Taylor Hobson", height_mm, ratios);
    table.overAll("mr", "percent", 100.0, "ISO 4287:1997, 4.5.4", share, depth);
    table.overAll("dc", "um", um_per_mm, "ISO 4287:1997, 4.5.3", height_mm, ratios);
    table.overAll("H", "um", um_per_mm, "SMS 671:1975", heightBetween(s, swedish_low, swedish_high), "5%-90%");
    table.overAll("Vo", "mm3_per_mm2", 1.0, "ISO 25178-2:2012, Vv(mr), of a profile", voidUnder(s),
                  fmt::format("lid at {:.6g}%", 100.0 * c.void_ratio));
    table.overAll("HSC", "peaks", 1.0, "Taylor Hobson", highSpots(s), depth);
}

void addSpacings(Table& table) {
    const Stretch& s = table.whole();
    table.mean("Sm", "mm", 1.0, "ISO 4287:1997, 4.3.1", elementWidth);
    table.mean("c", "um", um_per_mm, "ISO 4287:1997, 4.1.4", elementHeight);
    table.overAll("Pc", "per_mm", 1.0, "EN 10049:2005",
                  static_cast<double>(passagesThrough(s.curve, s.conditions.peak_band_mm)) / s.lengthMm(),
                  fmt::format("+/- {:.6g} um", s.conditions.peak_band_mm * um_per_mm));
    table.mean("D", "per_mm", 1.0, "ISO 4287-1:1984", [](const Stretch& stretch) -> Value {
        const Value width = elementWidth(stretch);
        if (!width) return {};
        return 1.0 / *width;
    });
    table.mean("S", "mm", 1.0, "ISO 4287-1:1984", peakDistance);
    table.mean("zJIS", "um", um_per_mm, "JIS B 0601:2001, annex 1", tenPointHeight);
    table.mean("3z", "um", um_per_mm, "Daimler-Benz N 31007:1983", thirdHeight);
    table.overAll("fd", "", 1.0, "Dubuc et al. 1989", fractalDimension(s.samples));
}

}  // namespace

std::vector<TextureParameter> textureParameters(char letter, std::span<const double> heights_mm, double spacing_mm,
                                                const TextureConditions& conditions) {
    Table table(letter, heights_mm, spacing_mm, conditions);
    addHeights(table);
    addHybrids(table);
    addBearing(table);
    addSpacings(table);
    return table.take();
}

}  // namespace cusp::inspect
