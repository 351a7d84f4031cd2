// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Real QIF files: what pugixml's tree says of them, computed with other formulas, is what the stream reader says.
#include "qif_report.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/child_process.hpp>
#include <cusp/inspect/capability.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <map>
#include <pugixml.hpp>
#include <sstream>
#include <string>
#include <vector>

namespace cusp::inspect {
namespace {

const std::string folder = CUSP_SHARED_DATA "/cmm/qif/";

class QifFiles : public ::testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
    }
    static QifResults read(const std::string& name) {
        std::ifstream in(folder + name, std::ios::binary);
        base::Diagnostics warnings;
        auto results = readQif(in, name, warnings);
        EXPECT_TRUE(results.has_value()) << base::toText(results.error());
        return results.value_or(QifResults{});
    }
};

/// Values of one characteristic item and feature item, and their limits, found by walking the tree.
struct Expected {
    std::vector<long double> values;
    double lower = NAN;
    double upper = NAN;
};

pugi::xml_node childWithId(const pugi::xml_node& list, const std::string& id) {
    return list.find_child([&id](const pugi::xml_node& node) { return id == node.attribute("id").value(); });
}

std::map<std::string, Expected> expectedSeries(const pugi::xml_document& document) {
    std::map<std::string, Expected> out;
    const auto root = document.child("QIFDocument");
    const auto characteristics = root.child("Characteristics");
    const auto features = root.child("Features").child("FeatureItems");
    for (const auto& results : root.child("MeasurementsResults").child("MeasurementResultsSet"))
        for (const auto& actual : results.child("MeasuredCharacteristics").child("CharacteristicActuals")) {
            const auto item =
                childWithId(characteristics.child("CharacteristicItems"), actual.child_value("CharacteristicItemId"));
            const auto measured = childWithId(results.child("MeasuredFeatures").child("FeatureActuals"),
                                              actual.child("FeatureActualIds").child_value("Id"));
            const auto feature = childWithId(features, measured.child_value("FeatureItemId"));
            Expected& series = out[std::string(item.child_value("Name")) + "|" + feature.child_value("FeatureName")];
            series.values.push_back(std::stold(actual.child_value("Value")));
            const auto nominal = childWithId(characteristics.child("CharacteristicNominals"),
                                             item.child_value("CharacteristicNominalId"));
            const auto definition = childWithId(characteristics.child("CharacteristicDefinitions"),
                                                nominal.child_value("CharacteristicDefinitionId"));
            if (const auto tolerance = definition.child("Tolerance")) {
                const bool absolute = std::string(tolerance.child_value("DefinedAsLimit")) == "true";
                const double about = absolute ? 0.0 : std::stod(nominal.child_value("TargetValue"));
                series.lower = about + std::stod(tolerance.child_value("MinValue"));
                series.upper = about + std::stod(tolerance.child_value("MaxValue"));
            } else if (definition.child("ToleranceValue").text().as_double() > 0.0) {
                series.upper = definition.child("ToleranceValue").text().as_double();
            }
        }
    return out;
}

void expectIndices(const CapabilitySeries& found, const Expected& expected) {
    const auto n = static_cast<long double>(expected.values.size());
    ASSERT_EQ(found.values.size(), expected.values.size());
    // Two sums instead of deviations from the mean, and the moving ranges by pairs.
    long double sum = 0.0L;
    long double squares = 0.0L;
    long double ranges = 0.0L;
    for (std::size_t i = 0; i < expected.values.size(); ++i) {
        sum += expected.values[i];
        squares += expected.values[i] * expected.values[i];
        if (i > 0) ranges += fabsl(expected.values[i] - expected.values[i - 1]);
    }
    const auto mean = static_cast<double>(sum / n);
    const auto overall = static_cast<double>(sqrtl(fmaxl(0.0L, (squares - sum * sum / n) / (n - 1.0L))));
    const auto within = static_cast<double>(ranges / (n - 1.0L)) / 1.1283791670955126;
    EXPECT_NEAR(found.mean, mean, 1e-12);
    EXPECT_NEAR(found.overall_deviation.value_or(NAN), overall, 1e-9);
    EXPECT_NEAR(found.within_deviation.value_or(NAN), within, 1e-12);
    const auto nearer = [&](double sigma) {
        const double up = (expected.upper - mean) / (3.0 * sigma);
        const double down = (mean - expected.lower) / (3.0 * sigma);
        return std::fmin(up, down);  // of two, one may be NaN: no limit
    };
    if (!std::isnan(expected.upper) && overall > 1e-9) {
        EXPECT_NEAR(found.ppk.value_or(NAN), nearer(overall), 1e-6 * std::abs(nearer(overall)));
        EXPECT_NEAR(found.cpk.value_or(NAN), nearer(within), 1e-6 * std::abs(nearer(within)));
    }
    const bool both = !std::isnan(expected.lower) && !std::isnan(expected.upper) && overall > 1e-9;
    EXPECT_EQ(found.cp.has_value(), both);
    if (!both) return;
    const double width = expected.upper - expected.lower;
    EXPECT_NEAR(found.pp.value_or(NAN), width / (6.0 * overall), 1e-6 * width / (6.0 * overall));
    EXPECT_NEAR(found.cp.value_or(NAN), width / (6.0 * within), 1e-6 * width / (6.0 * within));
}

TEST_F(QifFiles, CapabilityOfTwentyPlatesIsThatOfAnIndependentComputation) {
    const QifResults results = read("PlateResults_20_samples.QIF");
    EXPECT_EQ(results.parts.size(), 20U);
    EXPECT_EQ(results.measurements.size(), 620U);
    EXPECT_EQ(results.characteristics.size(), 17U);
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder + "PlateResults_20_samples.QIF").c_str()));
    const auto expected = expectedSeries(document);
    const auto series = capabilityOf({&results, 1});
    ASSERT_TRUE(series.has_value()) << base::toText(series.error());
    ASSERT_EQ(series->size(), expected.size());
    std::size_t beyond = 0;
    for (const CapabilitySeries& one : *series) {
        beyond += one.beyond_limits;
        const auto known = expected.find(one.name + "|" + one.feature);
        ASSERT_NE(known, expected.end()) << one.name << " of " << one.feature;
        SCOPED_TRACE(known->first);
        expectIndices(one, known->second);
    }
    // Who measured the plates judged them too.
    std::size_t failed = 0;
    for (const QifMeasurement& measured : results.measurements)
        if (measured.status == "FAIL") ++failed;
    EXPECT_EQ(failed, 51U);
    EXPECT_EQ(beyond, failed);
}

TEST_F(QifFiles, PointSetsAndUnitsAreRead) {
    const QifResults results = read("v30_data_QIF_PTS_SAMPLE.QIF");
    pugi::xml_document document;
    ASSERT_TRUE(document.load_file((folder + "v30_data_QIF_PTS_SAMPLE.QIF").c_str()));
    std::vector<double> numbers;
    std::size_t stated = 0;
    for (const auto& set : document.select_nodes("//MeasuredPointSet")) {
        stated += set.node().attribute("count").as_uint();
        std::istringstream text(set.node().child_value("Points"));
        for (double number = 0.0; text >> number;) numbers.push_back(number);
    }
    ASSERT_GT(stated, 600U);
    ASSERT_EQ(results.points.size(), stated);
    ASSERT_EQ(numbers.size(), 3 * stated);
    for (std::size_t i = 0; i < stated; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            ASSERT_EQ(results.points.positions[i][static_cast<Eigen::Index>(k)], numbers[3 * i + k]) << i;
    EXPECT_TRUE(results.points.unit_stated);
    EXPECT_EQ(results.version, "3.0.0");
}

TEST_F(QifFiles, PointProfilesHaveTheirZonesAndPointFeaturesArePoints) {
    const QifResults results = read("v30_data_QIF_Results_Sample.QIF");
    EXPECT_EQ(results.points.size(), 3U);
    const auto named = [&results](const std::string& name) {
        for (const QifCharacteristic& characteristic : results.characteristics)
            if (characteristic.name == name && characteristic.kind == "PointProfile") return characteristic;
        ADD_FAILURE() << name;
        return QifCharacteristic{};
    };
    // "A uniform profile zone ±2.0" and "An offset profile zone +1.0/-0.5", as the file's remarks say.
    EXPECT_EQ(named("5").lower, -2.0);
    EXPECT_EQ(named("5").upper, 2.0);
    EXPECT_EQ(named("4").lower, -0.5);
    EXPECT_EQ(named("4").upper, 1.0);
}

/// What the writer makes follows the schema of the standard, whatever the decision and however few the points.
TEST_F(QifFiles, WhatIsWrittenFollowsTheSchema) {
    const std::string schema = folder + "schema30_xmllint/QIFApplications/QIFDocument.xsd";
    if (!base::runProcess({"xmllint", "--version"})) GTEST_SKIP() << "xmllint is not installed (scripts/deps.sh test)";
    const auto lint = [&schema](const std::string& text) {
        const std::string file = ::testing::TempDir() + "cusp_schema.qif";
        EXPECT_TRUE(base::writeWholeFile(file, text).has_value());
        const auto outcome = base::runProcess({"xmllint", "--nonet", "--noout", "--schema", schema, file});
        std::filesystem::remove(file);
        return outcome ? outcome->errors : std::string("not run");
    };
    for (const Verdict verdict : {Verdict::NotAsked, Verdict::Accept, Verdict::Reject, Verdict::Undecided})
        for (const std::size_t points : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{500}}) {
            const std::string said = lint(test::qifText(test::qifReport(points, verdict)));
            EXPECT_TRUE(said.ends_with("cusp_schema.qif validates\n")) << said;
        }
    for (const Verdict verdict : {Verdict::NotAsked, Verdict::Accept, Verdict::Undecided}) {
        const std::string said = lint(test::qifText(test::qifReportWithSections(50, verdict)));
        EXPECT_TRUE(said.ends_with("cusp_schema.qif validates\n")) << said;
    }
    // The test can fail: a document with an element too many does not pass.
    std::string wrong = test::qifText(test::qifReport(3, Verdict::Accept));
    wrong.insert(wrong.find("  <FileUnits>"), "<Surplus/>");
    EXPECT_NE(lint(wrong).find("fails to validate"), std::string::npos);
}

}  // namespace
}  // namespace cusp::inspect
