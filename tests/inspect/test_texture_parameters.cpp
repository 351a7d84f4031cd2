// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Parameters of sine, triangle, arcs and sums against their closed forms.
#include "texture_profiles.hpp"

#include <cusp/base/random.hpp>

#include <algorithm>
#include <array>
#include <set>

namespace cusp::inspect::test {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double amplitude_mm = 0.0013;
constexpr double wave_mm = 0.08;
constexpr std::size_t waves = 20;

double degrees(double slope) { return std::atan(slope) * 180.0 / pi; }

std::vector<TextureParameter> primary(const std::vector<double>& heights, double spacing_mm,
                                      const TextureConditions& conditions = {}) {
    return textureParameters('P', heights, spacing_mm, conditions);
}

TEST(TextureParameters, SineHasItsClosedForms) {
    constexpr std::size_t per_wave = 4000;
    const double spacing_mm = wave_mm / per_wave;
    const auto heights =
        sampled([](double x) { return amplitude_mm * std::sin(2.0 * pi * x / wave_mm); }, spacing_mm, waves * per_wave);
    const auto found = primary(heights, spacing_mm);
    const double a = amplitude_mm * 1000.0;
    const double steepest = 2.0 * pi * amplitude_mm / wave_mm;
    // Mean of √(1 + m²cos²): (2/π)·√(1 + m²)·E(k), k² = m²/(1 + m²).
    const double root = std::sqrt(1.0 + steepest * steepest);
    const double longer = 2.0 / pi * root * std::comp_ellint_2(steepest / root) - 1.0;
    const double ratio = std::acos((a - 1.0) / a) / pi;
    const double lid = a * std::cos(0.2 * pi);
    expectAll(found,
              {{"Pa", 2.0 * a / pi},
               {"Pq", a / std::sqrt(2.0)},
               {"Pp", a},
               {"Pv", a},
               {"Pt", 2.0 * a},
               {"Pz", 2.0 * a},
               {"Psk", 0.0},
               {"Pku", 1.5},
               {"PTp", 100.0 * ratio},
               {"Pmr", 100.0 * ratio},
               {"PHTp", 2.0 * lid},
               {"Pdc", 2.0 * lid},
               {"PH", a * (std::cos(0.05 * pi) - std::cos(0.9 * pi))},
               {"PSm", wave_mm},
               {"Pc", 2.0 * a},
               {"PDq", degrees(steepest / std::sqrt(2.0))},
               {"PDa", degrees(4.0 * amplitude_mm / wave_mm)},
               {"PLq", wave_mm},
               {"PLa", wave_mm},
               {"PLo", 100.0 * longer},
               {"PzJIS", 2.0 * a},
               {"P3z", 2.0 * a},
               {"PD", 1.0 / wave_mm},
               {"PS", wave_mm},
               {"PVo", (lid * 0.8 + a * std::sin(0.2 * pi) / pi) / 1000.0}},
              1e-9);
    EXPECT_EQ(valueOf(found, "PHSC"), 20.0);
    EXPECT_NEAR(valueOf(found, "PPc"), 1.0 / wave_mm, 1e-9);
}

TEST(TextureParameters, TriangleIsExactWithCornersAtSamples) {
    // Few samples are enough: the flanks are straight.
    constexpr std::size_t per_wave = 40;
    const double spacing_mm = wave_mm / per_wave;
    const auto heights =
        sampled([](double x) { return amplitude_mm * triangleWave(x / wave_mm); }, spacing_mm, waves * per_wave);
    const auto found = primary(heights, spacing_mm);
    const double a = amplitude_mm * 1000.0;
    const double slope = 4.0 * amplitude_mm / wave_mm;
    const double lid = a * (1.0 - 2.0 * 0.2);
    expectAll(found,
              {{"Pa", a / 2.0},
               {"Pq", a / std::sqrt(3.0)},
               {"Pp", a},
               {"Pt", 2.0 * a},
               {"Psk", 0.0},
               {"Pku", 1.8},
               {"Pmr", 100.0 * 1.0 / (2.0 * a)},
               {"Pdc", 2.0 * a * 0.6},
               {"PH", 2.0 * a * 0.85},
               {"PSm", wave_mm},
               {"Pc", 2.0 * a},
               {"PDq", degrees(slope)},
               {"PDa", degrees(slope)},
               {"PLq", 2.0 * pi * amplitude_mm / std::sqrt(3.0) / slope},
               {"PLo", 100.0 * (std::sqrt(1.0 + slope * slope) - 1.0)},
               {"PS", wave_mm},
               {"PVo", (lid + a) * (lid + a) / (4.0 * a) / 1000.0}},
              1e-9);
}

TEST(TextureParameters, ArcsOfABallHaveTheirClosedForms) {
    // Scallops: arcs of radius R side by side, ridges between them at samples.
    constexpr double R = 0.8;
    constexpr double pitch_mm = 0.4;
    constexpr std::size_t per_arc = 2000;
    const double spacing_mm = pitch_mm / per_arc;
    const double half = pitch_mm / 2.0;
    const double ridge = std::sqrt(R * R - half * half);
    const double integral = 0.5 * (half * ridge + R * R * std::asin(half / R));  // of √(R² − x²), 0 … half
    const double mean = R - integral / half;
    const double mean_square = 2.0 * R * R - half * half / 3.0 - 2.0 * R * integral / half;
    const auto arcs = [&](double x) {
        const double from_middle = std::fmod(x, pitch_mm) - half;
        return R - std::sqrt(R * R - from_middle * from_middle) - mean;
    };
    const auto heights = sampled(arcs, spacing_mm, 12 * per_arc);
    const auto found = primary(heights, spacing_mm, {.depth_mm = 0.004});
    const auto level = [&](double above) {  // with the share `above` of the length over it
        const double x = half * (1.0 - above);
        return R - std::sqrt(R * R - x * x);
    };
    const double at_depth = R - ridge - 0.004;
    const double x_depth = std::sqrt(R * R - (R - at_depth) * (R - at_depth));
    const double x_mean = std::sqrt(R * R - (R - mean) * (R - mean));
    const double below = x_mean * (mean - R) + 0.5 * (x_mean * (R - mean) + R * R * std::asin(x_mean / R));
    // Mean slope: up and down by the height once in each half.
    expectAll(found,
              {{"Pt", 1000.0 * (R - ridge)},
               {"Pv", 1000.0 * mean},
               {"Pq", 1000.0 * std::sqrt(mean_square - mean * mean)},
               {"Pa", 1000.0 * 2.0 * below / half},
               {"Pmr", 100.0 * (1.0 - x_depth / half)},
               {"Pdc", 1000.0 * (level(0.2) - level(0.8))},
               {"PDa", degrees((R - ridge) / half)},
               {"PLo", 100.0 * (R * std::asin(half / R) / half - 1.0)},
               {"PSm", pitch_mm},
               {"PS", pitch_mm}},
              1e-9);
    EXPECT_EQ(valueOf(found, "PHSC"), 11.0);  // those at the ends are not whole
}

TEST(TextureParameters, SumsOfSinesAddTheirSquares) {
    constexpr std::size_t per_wave = 2000;
    const double spacing_mm = wave_mm / per_wave;
    const double small_mm = amplitude_mm / 3.0;
    const auto heights = sampled(
        [small_mm](double x) {
            return amplitude_mm * std::sin(2.0 * pi * x / (4.0 * wave_mm)) +
                   small_mm * std::sin(2.0 * pi * x / wave_mm + 0.7);
        },
        spacing_mm, waves * per_wave);
    const auto found = primary(heights, spacing_mm);
    const double q_mm = std::hypot(amplitude_mm, small_mm) / std::sqrt(2.0);
    const double slope = 2.0 * pi / wave_mm * std::hypot(amplitude_mm / 4.0, small_mm) / std::sqrt(2.0);
    expectAll(found, {{"Pq", 1000.0 * q_mm}, {"PDq", degrees(slope)}, {"PLq", 2.0 * pi * q_mm / slope}}, 1e-9);
}

TEST(TextureParameters, SmallWavesDoNotMakeElements) {
    // A ripple of 4 % of the height crosses the mean line several times at each flank, and is no element (rule: 10 %).
    constexpr std::size_t per_wave = 1000;
    const double spacing_mm = wave_mm / per_wave;
    const auto heights = sampled(
        [](double x) {
            return amplitude_mm * (std::sin(2.0 * pi * x / wave_mm) + 0.08 * std::sin(2.0 * pi * 31.0 * x / wave_mm));
        },
        spacing_mm, waves * per_wave);
    const auto found = primary(heights, spacing_mm);
    EXPECT_NEAR(valueOf(found, "PSm"), wave_mm, 1e-9);
    EXPECT_LT(valueOf(found, "PS"), wave_mm / 20.0);
}

TEST(TextureParameters, PerSamplingLengthAreMeans) {
    // Amplitude 1 in the first half, 3 in the second: z is the mean of both, t sees both.
    constexpr std::size_t per_wave = 400;
    const double spacing_mm = wave_mm / per_wave;
    const double middle_mm = waves / 2 * wave_mm;
    const auto heights = sampled(
        [middle_mm](double x) {
            const double factor = x < middle_mm - 1e-12 ? 1.0 : 3.0;
            return factor * amplitude_mm * std::sin(2.0 * pi * x / wave_mm);
        },
        spacing_mm, waves * per_wave);
    const auto found = textureParameters('R', heights, spacing_mm, {.sampling_length_mm = middle_mm});
    EXPECT_NEAR(valueOf(found, "Rz"), 2.0 * 2.0 * amplitude_mm * 1000.0, 1e-6);
    EXPECT_NEAR(valueOf(found, "Rt"), 2.0 * 3.0 * amplitude_mm * 1000.0, 1e-6);
    EXPECT_NEAR(valueOf(found, "Ra"), 2.0 * 2.0 * amplitude_mm * 1000.0 / pi, 1e-6);
}

/// Weierstrass and Mandelbrot's function with known dimension, and Brownian motion (1.5).
TEST(TextureParameters, FractalDimensionWithinItsTolerance) {
    constexpr std::size_t steps = std::size_t{1} << 15U;
    for (const double dimension : {1.2, 1.5, 1.8}) {
        base::Random random(17);
        double mean = 0.0;
        constexpr int profiles = 4;
        for (int k = 0; k < profiles; ++k) {
            std::vector<std::array<double, 3>> waves_of;  // frequency, amplitude, phase
            for (double frequency = 1.0; frequency < 4.0 * steps; frequency *= 1.5)
                waves_of.push_back({frequency, std::pow(frequency, dimension - 2.0), random.uniform(0.0, 2.0 * pi)});
            const auto weierstrass = [&](double x) {
                double sum = 0.0;
                for (const auto& [frequency, amplitude, phase] : waves_of)
                    sum += amplitude * std::sin(2.0 * pi * frequency * x + phase);
                return sum;
            };
            mean += valueOf(primary(sampled(weierstrass, 1.0 / steps, steps), 1.0 / steps), "Pfd") / profiles;
        }
        EXPECT_LE(mean, dimension + 0.05);
        EXPECT_GE(mean, dimension - (dimension > 1.5 ? 0.1 : 0.05));
    }
    const auto sine = sampled([](double x) { return std::sin(2.0 * pi * x); }, 1.0 / steps, steps);
    EXPECT_NEAR(valueOf(primary(sine, 1.0 / steps), "Pfd"), 1.0, 0.05);
}

TEST(TextureParameters, EveryOneHasASourceAndAFlatProfileNoNonsense) {
    const std::vector<double> flat(200, 0.0);
    const auto found = primary(flat, 0.001);
    std::set<std::string> names;
    for (const TextureParameter& parameter : found) {
        EXPECT_FALSE(parameter.source.empty()) << parameter.name;
        EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name << " twice";
        EXPECT_TRUE(std::isfinite(parameter.value.value_or(0.0))) << parameter.name;
    }
    for (const char* name :
         {"Pa",  "Pq",    "Pp",  "Pv", "Pt",  "Psk",  "Pku", "Pz",  "PTp", "PHTp", "PSm", "PDq", "PLq", "PLo",
          "PPc", "PzJIS", "P3z", "Pc", "Pfd", "PHSC", "PDa", "PLa", "PH",  "PD",   "PS",  "PVo", "Pmr", "Pdc"})
        EXPECT_TRUE(names.count(name) == 1) << name;
    for (const char* absent : {"PSm", "Pc", "PLq", "PLa", "PzJIS", "P3z", "Pfd", "PS", "PD"})
        for (const TextureParameter& parameter : found)
            EXPECT_FALSE(parameter.name == absent && parameter.value.has_value()) << absent;
}

}  // namespace
}  // namespace cusp::inspect::test
