// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Filter, form, scallops and the evaluation of a whole trace.
#include "texture_profiles.hpp"

#include <cusp/base/random.hpp>
#include <cusp/inspect/texture_filter.hpp>
#include <cusp/inspect/texture_report.hpp>
#include <cusp/inspect/texture_section.hpp>

#include <Eigen/Dense>

#include <algorithm>

namespace cusp::inspect::test {
namespace {

constexpr double pi = std::numbers::pi;

TEST(GaussianFilter, LetsWavesThroughAsTheStandardSays) {
    constexpr double cutoff_mm = 0.8;
    EXPECT_NEAR(gaussianTransmission(cutoff_mm, cutoff_mm), 0.5, 1e-15);
    constexpr double spacing_mm = 0.001;
    constexpr std::size_t steps = 8000;
    for (const double wave_mm : {0.1, 0.25, 0.8, 2.5, 4.0}) {
        const auto wave = [wave_mm](double x) { return std::sin(2.0 * pi * x / wave_mm + 0.3); };
        const auto low = gaussianLowPass(sampled(wave, spacing_mm, steps), spacing_mm, cutoff_mm);
        const double through = gaussianTransmission(wave_mm, cutoff_mm);
        EXPECT_NEAR(through, std::exp(-pi * std::pow(std::sqrt(std::log(2.0) / pi) * cutoff_mm / wave_mm, 2)), 1e-14);
        for (std::size_t i = 1041; i + 1041 < low.size(); i += 97)
            ASSERT_NEAR(low[i], through * wave(static_cast<double>(i) * spacing_mm), 1e-10) << wave_mm << " " << i;
    }
}

TEST(GaussianFilter, AStraightProfilePassesToItsEnds) {
    const auto line = sampled([](double x) { return 3.0 - 0.7 * x; }, 0.01, 400);
    const auto low = gaussianLowPass(line, 0.01, 0.8);
    for (std::size_t i = 0; i < line.size(); ++i) ASSERT_NEAR(low[i], line[i], 1e-12) << i;
}

TEST(GaussianFilter, AtTheEndsIsTheLineOfWeightedLeastSquares) {
    base::Random random(5);
    std::vector<double> heights(300);
    for (double& height : heights) height = random.normal();
    const auto low = gaussianLowPass(heights, 0.01, 0.8);
    for (const std::size_t at : {std::size_t{0}, std::size_t{13}, std::size_t{60}, std::size_t{299}}) {
        Eigen::MatrixXd rows(300, 2);
        Eigen::VectorXd values(300);
        const double sigma = 0.8 / pi * std::sqrt(std::log(2.0) / 2.0);
        for (int i = 0; i < 300; ++i) {
            const double x = 0.01 * (i - static_cast<double>(at));
            const double root = std::abs(x) <= 1.3 * 0.8 + 1e-9 ? std::exp(-0.25 * x * x / (sigma * sigma)) : 0.0;
            rows.row(i) << root, root * x;
            values[i] = root * heights[static_cast<std::size_t>(i)];
        }
        const Eigen::VectorXd line = rows.colPivHouseholderQr().solve(values);
        EXPECT_NEAR(low[at], line[0], 1e-11) << at;
    }
}

TEST(TextureReport, SeparatesRoughnessFromWaviness) {
    constexpr double spacing_mm = 0.0005;
    constexpr std::size_t steps = 16'000;  // 8 mm
    const double short_mm = 0.1;
    const double long_mm = 2.0;
    StylusProfile profile;
    profile.spacing_mm = spacing_mm;
    profile.height_mm = sampled(
        [&](double x) { return 0.0006 * std::sin(2.0 * pi * x / short_mm) + 0.004 * std::cos(2.0 * pi * x / long_mm); },
        spacing_mm, steps);
    TextureOptions options;
    options.form = FormRemoval::None;
    options.end_cutoffs = 1.5;  // whole weights everywhere, and whole waves of 2 mm are not cut: 8 − 2.4 = 5.6 mm
    const auto report = evaluateTexture(profile, options);
    ASSERT_TRUE(report.has_value()) << base::toText(report.error());
    const double kept_short = 1.0 - gaussianTransmission(short_mm, 0.8);
    const double kept_long = 1.0 - gaussianTransmission(long_mm, 0.8);
    ASSERT_EQ(report->roughness.height_mm.size(), 11'201U);
    for (std::size_t i = 0; i < report->roughness.height_mm.size(); i += 331) {
        const double x = report->roughness.begin_mm + static_cast<double>(i) * spacing_mm;
        EXPECT_NEAR(report->roughness.height_mm[i],
                    0.0006 * kept_short * std::sin(2.0 * pi * x / short_mm) +
                        0.004 * kept_long * std::cos(2.0 * pi * x / long_mm),
                    1e-12);
        EXPECT_NEAR(report->waviness.height_mm[i] + report->roughness.height_mm[i], report->primary.height_mm[2400 + i],
                    1e-15);
    }
}

TEST(TextureReport, RoughnessOfASineIsItsClosedForm) {
    constexpr double spacing_mm = 0.0001;
    const double wave_mm = 0.2;
    StylusProfile profile;
    profile.spacing_mm = spacing_mm;
    profile.height_mm =
        sampled([wave_mm](double x) { return 0.002 * std::cos(2.0 * pi * x / wave_mm); }, spacing_mm, 64'000);
    TextureOptions options;
    options.form = FormRemoval::None;
    options.end_cutoffs = 1.5;
    const auto report = evaluateTexture(profile, options);
    ASSERT_TRUE(report.has_value());
    const double a_um = 2.0 * (1.0 - gaussianTransmission(wave_mm, 0.8));
    expectAll(report->roughness.parameters,
              {{"Ra", 2.0 * a_um / pi},
               {"Rq", a_um / std::sqrt(2.0)},
               {"Rz", 2.0 * a_um},
               {"RSm", wave_mm},
               {"RLq", wave_mm}},
              1e-9);
}

TEST(TextureReport, LevellingTakesOffALine) {
    constexpr double spacing_mm = 0.001;
    const auto wave = [](double x) { return 0.001 * std::cos(2.0 * pi * x / 0.25); };
    StylusProfile level;
    level.spacing_mm = spacing_mm;
    level.height_mm = sampled(wave, spacing_mm, 6000);  // even about its middle: its own line has no slope
    StylusProfile tilted = level;
    for (std::size_t i = 0; i < tilted.height_mm.size(); ++i)
        tilted.height_mm[i] += 0.7 + 0.02 * static_cast<double>(i) * spacing_mm;
    const auto a = evaluateTexture(level, {});
    const auto b = evaluateTexture(tilted, {});
    ASSERT_TRUE(a.has_value() && b.has_value());
    for (std::size_t i = 0; i < level.height_mm.size(); ++i)
        ASSERT_NEAR(a->primary.height_mm[i], b->primary.height_mm[i], 1e-13);
}

TEST(TextureReport, SaysWhatItCannotDo) {
    StylusProfile profile;
    profile.spacing_mm = 0.001;
    profile.height_mm.assign(1201, 0.0);
    const auto text = [&profile](const TextureOptions& options) {
        const auto report = evaluateTexture(profile, options);
        return report ? std::string("accepted") : base::toText(report.error());
    };
    EXPECT_EQ(text({}), "error: a trace of 1.2 mm leaves 0.4 mm between its ends: less than one cut-off of 0.8 mm "
                        "[texture.too-short]\n");
    EXPECT_EQ(text({.cutoff_mm = 0.008, .conditions = {}}),
              "error: points lie 0.001 mm apart: a cut-off of 0.008 mm needs 10 of them or more "
              "[texture.too-coarse]\n");
    EXPECT_EQ(text({.cutoff_mm = 0.25, .short_cutoff_mm = 0.25, .conditions = {}}),
              "error: cut-offs must be positive, the short one below the other: 0.25 and 0.25 mm [texture.options]\n");
    EXPECT_EQ(text({.cutoff_mm = 0.25, .conditions = {}}), "accepted");
}

TEST(Form, FindsACubicAsAnotherSolverDoes) {
    base::Random random(3);
    std::vector<double> x;
    std::vector<double> z;
    for (int i = 0; i < 200; ++i) {
        x.push_back(0.5 * i + random.uniform(0.0, 0.2));
        z.push_back(0.01 * random.normal() + 1e-5 * std::pow(x.back() - 40.0, 3));
    }
    const auto fit = fitForm(x, z, {.order = 5});
    ASSERT_TRUE(fit.has_value());
    Eigen::MatrixXd powers(200, 6);
    for (int i = 0; i < 200; ++i)
        for (int k = 0; k < 6; ++k) powers(i, k) = std::pow(x[static_cast<std::size_t>(i)] / 100.0, k);
    const Eigen::VectorXd values = Eigen::Map<Eigen::VectorXd>(z.data(), 200);
    const Eigen::VectorXd other = powers * powers.colPivHouseholderQr().solve(values);
    for (int i = 0; i < 200; ++i) EXPECT_NEAR(fit->form_mm[static_cast<std::size_t>(i)], other[i], 1e-11);
}

TEST(Form, ChoosesTheOrderOfTheForm) {
    // AICc overfits now and then by design; it must never choose too little, and seldom too much.
    constexpr int trials = 100;
    int right = 0;
    base::Random random(11);
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> x;
        std::vector<double> z;
        for (int i = 0; i < 205; ++i) {
            x.push_back(0.5 * i);
            const double t = 2.0 * i / 204.0 - 1.0;
            z.push_back(0.004 * (2.5 * t * t * t - 1.5 * t) + 0.001 * random.normal());
        }
        const auto fit = fitForm(x, z, {});
        ASSERT_TRUE(fit.has_value());
        EXPECT_GE(fit->order, 3);
        right += fit->order == 3 ? 1 : 0;
    }
    EXPECT_GE(right, 70);
}

TEST(Form, DoesNotSwallowScallops) {
    std::vector<double> x;
    std::vector<double> z;
    for (int i = 0; i < 205; ++i) {
        x.push_back(0.5 * i);
        const double t = 2.0 * i / 204.0 - 1.0;
        z.push_back(0.006 * t * t + 0.004 * std::abs(std::sin(pi * x.back() / 4.9)));
    }
    const auto fit = fitForm(x, z, {.order = {}, .shortest_half_wave_mm = 9.8});
    ASSERT_TRUE(fit.has_value());
    std::vector<double> over = z;
    for (std::size_t i = 0; i < over.size(); ++i) over[i] -= fit->form_mm[i];
    const auto scallops = findScallops(x, over, {.planned_step_over_mm = 4.9});
    ASSERT_TRUE(scallops.has_value());
    // 102 mm hold 20 whole waves; ridges at 2.45 + 4.9 k up to 100.45.
    EXPECT_EQ(scallops->count, 20U);
    EXPECT_NEAR(scallops->mean_spacing_mm, 4.9, 0.03);
    EXPECT_NEAR(scallops->mean_height_mm, 0.004, 0.0004);
    EXPECT_NEAR(scallops->planned_count, 102.0 / 4.9, 1e-12);
}

TEST(Section, IsFormAndScallopsOverIt) {
    std::vector<double> arc;
    std::vector<double> deviation;
    for (int i = 0; i < 205; ++i) {
        arc.push_back(0.5 * i);
        const double t = 2.0 * i / 204.0 - 1.0;
        deviation.push_back(0.006 * t * t + 0.004 * std::abs(std::sin(pi * arc.back() / 4.9)));
    }
    const auto section = evaluateSection(arc, deviation, 4.9);
    ASSERT_TRUE(section.has_value());
    EXPECT_GE(section->form.order, 2);
    const base::Json json = toJson(*section, 4.9);
    EXPECT_EQ(json["scallops"]["count"], 20);
    EXPECT_NEAR(json["scallops"]["mean_height_mm"].get<double>(), 0.004, 0.0004);
    EXPECT_EQ(json["note"], "");
    // Too coarse for the plan: the form stays, and the reason is told.
    const auto coarse = evaluateSection(arc, deviation, 1.0);
    ASSERT_TRUE(coarse.has_value());
    EXPECT_TRUE(toJson(*coarse, 1.0)["scallops"].is_null());
    EXPECT_EQ(coarse->note, "points lie 0.5 mm apart; scallops of a step-over of 1 mm need 0.25 mm");
}

TEST(Scallops, NeedPointsEnough) {
    std::vector<double> x;
    std::vector<double> z;
    for (int i = 0; i < 60; ++i) {
        x.push_back(0.5 * i);
        z.push_back(std::sin(0.3 * i));
    }
    const auto scallops = findScallops(x, z, {.planned_step_over_mm = 1.0});
    ASSERT_FALSE(scallops.has_value());
    EXPECT_EQ(base::toText(scallops.error()),
              "error: points lie 0.5 mm apart; scallops of a step-over of 1 mm need 0.25 mm "
              "[scallops.too-coarse]\n");
}

TEST(Scallops, AreCountedUnderNoise) {
    // Noise of a tenth of the scallop height must not make or lose ridges.
    base::Random random(29);
    for (int trial = 0; trial < 50; ++trial) {
        std::vector<double> x;
        std::vector<double> z;
        for (int i = 0; i < 400; ++i) {
            x.push_back(0.25 * i);
            z.push_back(0.004 * std::abs(std::sin(pi * x.back() / 4.9)) + 0.0004 * random.normal());
        }
        const auto scallops = findScallops(x, z, {.planned_step_over_mm = 4.9});
        ASSERT_TRUE(scallops.has_value());
        EXPECT_EQ(scallops->count, 20U) << trial;
    }
}

TEST(Form, SaysWhatItCannotDo) {
    const auto text = [](const std::vector<double>& x, const FormOptions& options) {
        const auto fit = fitForm(x, std::vector<double>(x.size(), 1.0), options);
        return fit ? std::string("accepted") : base::toText(fit.error());
    };
    EXPECT_EQ(text({0, 1, 2, 2, 3}, {}), "error: positions must grow; point 4 does not [form.points]\n");
    EXPECT_EQ(text({0, 1, 2}, {.order = 1}), "error: 3 points; 4 are needed at least [form.points]\n");
    EXPECT_EQ(text({0, 1, 2}, {.order = 21}), "error: order 21 of a form; 0 to 20 can be fitted [form.order]\n");
    EXPECT_EQ(text({0, 1, 2}, {}), "accepted");
}

}  // namespace
}  // namespace cusp::inspect::test
