// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Deviation fields against what they were made of: poses, polynomials, noise, scallops, gaps; and their JSON.
#include <cusp/base/random.hpp>
#include <cusp/geometry/deviation_field.hpp>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <vector>

namespace cusp::geometry {
namespace {

/// A bowl 100 mm × 80 mm, seen from +Z.
DeviationSample onBowl(double x_mm, double y_mm) {
    DeviationSample out;
    out.position = {x_mm, y_mm, 0.004 * x_mm * x_mm + 0.006 * y_mm * y_mm};
    out.normal = Vector3(-0.008 * x_mm, -0.012 * y_mm, 1.0).normalized();
    return out;
}

std::vector<DeviationSample> cloud(base::Random& random, std::size_t count) {
    std::vector<DeviationSample> out;
    out.reserve(count);
    for (std::size_t i = 0; i < count; ++i) out.push_back(onBowl(random.uniform(-50, 50), random.uniform(-40, 40)));
    return out;
}

/// Lines 30 mm apart with a point every half millimetre, as a measuring machine scans them.
std::vector<DeviationSample> lines() {
    std::vector<DeviationSample> out;
    for (const double x : {-45.0, -15.0, 15.0, 45.0})
        for (int k = -80; k <= 80; ++k) out.push_back(onBowl(x, 0.5 * k));
    return out;
}

double rmsOf(const std::vector<double>& values) {
    double sum = 0.0;
    for (const double value : values) sum += value * value;
    return std::sqrt(sum / static_cast<double>(values.size()));
}

TEST(DeviationField, APoseIsSeparatedAndTheFormIsLeftAlone) {
    base::Random random(11);
    auto samples = cloud(random, 3000);
    const Vector3 shift(0.02, -0.01, 0.03);
    const Vector3 turn(1e-4, -2e-4, 3e-4);
    for (auto& s : samples) s.deviation_mm = s.normal.dot(shift + turn.cross(s.position));
    const auto field = DeviationField::fit(samples, {});
    ASSERT_TRUE(field);
    for (const auto& s : cloud(random, 200)) {
        EXPECT_NEAR(field->deviation(s.position, s.normal), s.normal.dot(shift + turn.cross(s.position)), 1e-9);
        EXPECT_NEAR(field->form(s.position), 0.0, 1e-9);
    }
    EXPECT_LT(field->data().residual_mm, 1e-9);
}

TEST(DeviationField, ACubicPolynomialIsMetBetweenTheSamples) {
    base::Random random(12);
    const auto truth = [](const Vector3& p) {
        const double x = p.x() / 50.0;
        const double y = p.y() / 40.0;
        return 0.01 * (0.5 - x + 2.0 * x * y - x * x * y + 0.7 * y * y * y - 0.4 * x * x * x * y * y);
    };
    auto samples = cloud(random, 5000);
    for (auto& s : samples) s.deviation_mm = truth(s.position);
    DeviationFieldOptions options;
    options.separate_pose = false;
    const auto field = DeviationField::fit(samples, options);
    ASSERT_TRUE(field);
    for (const auto& s : cloud(random, 500)) EXPECT_NEAR(field->form(s.position), truth(s.position), 2e-6);
}

TEST(DeviationField, NoiseIsAveragedNotFollowed) {
    // A perfect fit with p freedoms has the mean square σ²·p/N against the truth.
    base::Random random(13);
    const double sigma_mm = 0.002;
    const auto truth = [](const Vector3& p) { return 0.02 * std::sin(0.05 * p.x()) * std::cos(0.04 * p.y()); };
    auto samples = cloud(random, 2000);
    for (auto& s : samples) s.deviation_mm = truth(s.position) + random.normal(0.0, sigma_mm);
    const auto field = DeviationField::fit(samples, {});
    ASSERT_TRUE(field);
    std::vector<double> error;
    error.reserve(samples.size());
    for (const auto& s : samples) error.push_back(field->deviation(s.position, s.normal) - truth(s.position));
    const double expected_mm = sigma_mm * std::sqrt(field->data().effective_freedoms / 2000.0);
    EXPECT_LT(rmsOf(error), 1.5 * expected_mm);
    EXPECT_LT(field->data().effective_freedoms, 80.0);
    EXPECT_NEAR(field->data().residual_mm, sigma_mm, 0.1 * sigma_mm);
}

TEST(DeviationField, ScallopsAreNotChased) {
    // Ridges 5 mm apart, ten times higher than the noise: exactly measured, and yet no part of the field.
    base::Random random(14);
    const auto truth = [](const Vector3& p) { return 0.015 * std::sin(0.06 * p.y()) + 1e-4 * p.x(); };
    const auto scallop = [](const Vector3& p) { return 0.008 * std::cos(2.0 * std::numbers::pi * p.y() / 5.0); };
    auto samples = lines();
    for (auto& s : samples) s.deviation_mm = truth(s.position) + scallop(s.position) + random.normal(0.0, 0.0005);
    DeviationFieldOptions options;
    options.shortest_wave_mm = 20.0;
    const auto field = DeviationField::fit(samples, options);
    ASSERT_TRUE(field);
    std::vector<double> error;
    error.reserve(samples.size());
    for (const auto& s : samples) error.push_back(field->deviation(s.position, s.normal) - truth(s.position));
    EXPECT_LT(rmsOf(error), 0.001);
    EXPECT_NEAR(field->data().residual_mm, 0.008 / std::numbers::sqrt2, 0.0005);
}

TEST(DeviationField, GapsBetweenSectionsAreBridged) {
    const auto truth = [](const Vector3& p) { return 0.02 * std::sin(0.03 * p.x()) + 0.01 * std::cos(0.05 * p.y()); };
    base::Random random(15);
    auto samples = lines();
    for (auto& s : samples) s.deviation_mm = truth(s.position) + random.normal(0.0, 0.0003);
    const auto field = DeviationField::fit(samples, {});
    ASSERT_TRUE(field);
    double worst = 0.0;
    for (int i = -9; i <= 9; ++i)
        for (int k = -8; k <= 8; ++k) {
            const auto s = onBowl(5.0 * i, 5.0 * k);
            worst = std::max(worst, std::abs(field->deviation(s.position, s.normal) - truth(s.position)));
        }
    EXPECT_LT(worst, 0.0015);  // of 0.03; a chord over 30 mm alone would be off by 0.002
}

/// Four sections 30 mm apart that wander a little, as footpoints do, with 200 points each.
std::vector<DeviationSample> sections(base::Random& random) {
    std::vector<DeviationSample> out;
    for (const double x : {-45.0, -15.0, 15.0, 45.0}) {
        const double phase = random.uniform(0.0, 6.0);
        for (int k = 0; k < 200; ++k)
            out.push_back(onBowl(x + 0.2 * std::sin(0.4 * k + phase), -40.0 + 80.0 * k / 199.0));
    }
    return out;
}

TEST(DeviationField, WhatHangsTogetherAlongSectionsMakesNoWavesBetweenThem) {
    // Scallops, chords and the path's own waves: 5 µm, from 2 mm to 12 mm long, the same for points side by side. Found on the
    // sections is what was made, and between them nothing larger than on them.
    const auto truth = [](const Vector3& p) {
        return 0.008 * std::sin(0.03 * p.x() + 0.5) * std::cos(0.035 * p.y()) + 1e-4 * p.x();
    };
    for (std::uint64_t seed = 100; seed < 130; ++seed) {
        base::Random random(seed);
        auto samples = sections(random);
        for (std::size_t line = 0; line < 4; ++line)
            for (const double wave_mm : {2.0, 3.5, 6.0, 12.0}) {
                const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
                const double k_per_mm = 2.0 * std::numbers::pi / wave_mm;
                for (std::size_t i = 200 * line; i < 200 * (line + 1); ++i)
                    samples[i].deviation_mm += 0.00125 * std::sin(k_per_mm * samples[i].position.y() + phase);
            }
        double largest = 0.0;
        for (auto& s : samples) {
            s.deviation_mm += truth(s.position) + random.normal(0.0, 0.0003);
            largest = std::max(largest, std::abs(s.deviation_mm));
        }
        const auto field = DeviationField::fit(samples, {});
        ASSERT_TRUE(field);
        std::vector<double> on;
        on.reserve(samples.size());
        for (const auto& s : samples) on.push_back(field->deviation(s.position, s.normal) - truth(s.position));
        EXPECT_LT(rmsOf(on), 0.001) << "seed " << seed;
        double between = 0.0;
        double off = 0.0;
        for (int i = -45; i <= 45; i += 3)
            for (int k = -40; k <= 40; k += 4) {
                const auto s = onBowl(i, k);
                const double found_mm = field->deviation(s.position, s.normal);
                between = std::max(between, std::abs(found_mm));
                off = std::max(off, std::abs(found_mm - truth(s.position)));
            }
        EXPECT_LT(between, 1.2 * largest) << "seed " << seed;
        EXPECT_LT(off, 0.004) << "seed " << seed;
    }
}

TEST(DeviationField, AClosedPartHasItsFieldInSpace) {
    base::Random random(16);
    const auto truth = [](const Vector3& p) { return 1e-5 * p.x() * p.y() / 10.0 + 0.003 * std::sin(0.1 * p.z()); };
    std::vector<DeviationSample> samples;
    for (int i = 0; i < 4000; ++i) {
        const Vector3 n = Vector3(random.normal(), random.normal(), random.normal()).normalized();
        samples.push_back({30.0 * n, n, truth(30.0 * n)});
    }
    const auto field = DeviationField::fit(samples, {});
    ASSERT_TRUE(field);
    EXPECT_EQ(field->data().axes[2].degree, 3);
    for (int i = 0; i < 200; ++i) {
        const Vector3 n = Vector3(random.normal(), random.normal(), random.normal()).normalized();
        EXPECT_NEAR(field->deviation(30.0 * n, n), truth(30.0 * n), 2e-4);
    }
}

TEST(DeviationField, OneLineAndFewPointsGiveNoWildValues) {
    std::vector<DeviationSample> samples;
    for (int i = 0; i < 12; ++i) {
        samples.push_back(onBowl(0.0, 6.0 * i - 33.0));
        samples.back().deviation_mm = i % 2 == 0 ? 0.001 : -0.001;
    }
    const auto field = DeviationField::fit(samples, {});
    ASSERT_TRUE(field);
    for (int y = -40; y <= 40; ++y) {
        const auto s = onBowl(0.0, y);
        EXPECT_LT(std::abs(field->deviation(s.position, s.normal)), 0.003);
    }
    samples.pop_back();
    const auto refused = DeviationField::fit(samples, {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().front().code, "deviation-field.too-few");
    samples.push_back(samples.front());
    samples.back().deviation_mm = std::nan("");
    const auto not_finite = DeviationField::fit(samples, {});
    ASSERT_FALSE(not_finite);
    EXPECT_EQ(not_finite.error().front().code, "deviation-field.not-finite");
}

TEST(DeviationField, OutsideTheSamplesTheFormKeepsItsValue) {
    base::Random random(17);
    auto samples = cloud(random, 2000);
    for (auto& s : samples) s.deviation_mm = 1e-4 * s.position.x() * s.position.x() / 50.0;
    const auto field = DeviationField::fit(samples, {});
    ASSERT_TRUE(field);
    const FieldAxis& axis = field->data().axes[0];
    EXPECT_EQ(field->form({axis.high_mm + 30.0, 0.0, 5.0}), field->form({axis.high_mm + 300.0, 0.0, 5.0}));
    EXPECT_TRUE(field->covers(samples.front().position));
    EXPECT_FALSE(field->covers({200.0, 0.0, 5.0}));
}

DeviationField someField() {
    base::Random random(18);
    auto samples = lines();
    for (auto& s : samples) s.deviation_mm = 0.01 * std::sin(0.05 * s.position.y()) + random.normal(0.0, 0.001);
    return DeviationField::fit(samples, {}).value();
}

base::Json reportWith(const base::Json& field) {
    base::Json report;
    report["deviation_field"]["datum"] = field;
    report["deviation_field"]["best_fit"] = nullptr;
    report["deviation_field"]["reason"] = "withheld: too few points";
    return report;
}

TEST(DeviationFieldJson, IsReadAsItWasWritten) {
    const DeviationField field = someField();
    const std::string text = base::jsonText(reportWith(field.toJson())).value();
    const auto again = readReportedDeviationField(text, "report.json", "datum");
    ASSERT_TRUE(again);
    for (const auto& s : lines())
        EXPECT_EQ(again->deviation(s.position, s.normal), field.deviation(s.position, s.normal));
    EXPECT_EQ(again->toJson(), field.toJson());
}

std::string problemOf(const base::Json& report, std::string_view frame = "datum") {
    const auto read = readReportedDeviationField(report.dump(), "report.json", frame);
    return read ? "" : toText(read.error().front());
}

TEST(DeviationFieldJson, WhatIsWrongIsNamedByItsPath) {
    const base::Json good = someField().toJson();
    const auto with = [&good](const char* key, const base::Json& value) {
        base::Json changed = good;
        changed[key] = value;
        return problemOf(reportWith(changed));
    };
    const std::string at = "report.json: error: deviation_field.datum";
    base::Json missing = good;
    missing.erase("pivot_mm");
    EXPECT_EQ(problemOf(reportWith(missing)), at + ".pivot_mm: this key is missing [deviation-field.key]");
    EXPECT_EQ(with("cells", "no"), at + ".cells: a list of 3 is needed [deviation-field.key]");
    EXPECT_EQ(with("coefficients_mm", {1.0}), at + ".coefficients_mm: a list of " +
                                                  std::to_string(good["coefficients_mm"].size()) +
                                                  " is needed [deviation-field.key]");
    EXPECT_EQ(with("degrees", {3, 2, 0}), at + ".degrees: a degree is 0 or 3 [deviation-field.value]");
    EXPECT_EQ(with("field_from_nominal", {1, 0, 0, 0, 1, 0, 0, 0, -1}),
              at + ".field_from_nominal: this is no rotation [deviation-field.value]");
    EXPECT_EQ(with("cells", {90000, 90000, 1}),
              at + ".cells: the axes have more than 100000 coefficients [deviation-field.value]");
    EXPECT_EQ(with("schema", 2),
              at + ".schema: schema 2 is not known; this version reads schema 1 [deviation-field.schema]");
    EXPECT_EQ(with("pivot_mm", {1.0, nullptr, 2.0}), at + ".pivot_mm: a number is needed [deviation-field.key]");
    EXPECT_EQ(problemOf(reportWith(good), "best_fit"),
              "report.json: error: deviation_field.best_fit: withheld: too few points [deviation-field.none]");
    EXPECT_EQ(problemOf(base::Json::array()),
              "report.json: error: deviation_field: this report holds no deviation field; it must be the report.json "
              "of cusp inspect [deviation-field.none]");
    EXPECT_EQ(toText(readReportedDeviationField("{", "report.json", "datum").error().front()),
              "report.json: error: this is no JSON document [json.syntax]");
}

}  // namespace
}  // namespace cusp::geometry
