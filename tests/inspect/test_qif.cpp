// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// QIF written and read back, units, limits, what is refused, and the figures of capability.
#include "qif_report.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/random.hpp>
#include <cusp/inspect/capability.hpp>
#include <cusp/inspect/point_reader.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <pugixml.hpp>
#include <sstream>

namespace cusp::inspect {
namespace {

base::Result<QifResults> read(const std::string& text, base::Diagnostics& warnings) {
    std::istringstream in(text);
    return readQif(in, "", warnings);
}

QifResults readGood(const std::string& text) {
    base::Diagnostics warnings;
    const auto results = read(text, warnings);
    EXPECT_TRUE(results.has_value()) << base::toText(results.error());
    EXPECT_TRUE(warnings.empty()) << base::toText(warnings);
    return results.value_or(QifResults{});
}

TEST(QifReader, PackedFilesSayWhatToDo) {
    base::Diagnostics warnings;
    for (const auto& [bytes, name] :
         {std::pair(std::string("\x1f\x8b\x08\x00", 4), "gzip"), std::pair(std::string("PK\x03\x04"), "zip")}) {
        const auto results = read(bytes, warnings);
        ASSERT_FALSE(results.has_value());
        EXPECT_EQ(results.error().front().message,
                  std::string("the file is compressed (") + name + "); unpack it first");
    }
}

TEST(QifWriter, IsReadBackAsItWas) {
    const InspectionReport report = test::qifReport(5000, Verdict::Accept);
    const QifResults results = readGood(test::qifText(report));
    ASSERT_EQ(results.points.size(), 4999U);  // one lies beyond an edge
    for (std::size_t i = 0; i < 4999; ++i) {
        const PointDeviation& point = report.best_fit.deviations[i];
        ASSERT_LT((results.points.positions[i] - point.surfacePoint()).cwiseAbs().maxCoeff(), 0.6e-9) << i;
        ASSERT_LT((results.points.directions[i] - point.normal).norm(), 2e-9) << i;
    }
    EXPECT_EQ(results.points.kind, PointKind::Surface);
    ASSERT_EQ(results.measurements.size(), 1U);
    EXPECT_DOUBLE_EQ(results.measurements[0].value, 0.006);
    EXPECT_EQ(results.measurements[0].status, "PASS");
    EXPECT_EQ(results.measurements[0].feature, "surface <a>.toml");
    EXPECT_NEAR(results.characteristics[0].upper.value_or(0.0), 0.015, 1e-15);
}

TEST(QifWriter, SectionsAreCharacteristicsOfTheirOwn) {
    InspectionReport report = test::qifReportWithSections(100, Verdict::Reject);
    report.best_fit.decision.limits = {-0.0015, 0.0045};
    const QifResults results = readGood(test::qifText(report));
    ASSERT_EQ(results.measurements.size(), 3U);
    ASSERT_EQ(results.characteristics.size(), 3U);
    EXPECT_EQ(results.characteristics[1].name, "line profile Y=-5");
    EXPECT_EQ(results.characteristics[2].name, "line profile Y=30.5");
    EXPECT_EQ(results.characteristics[1].kind, "LineProfile");
    EXPECT_NEAR(results.characteristics[1].upper.value_or(0.0), 0.006, 1e-15);
    EXPECT_DOUBLE_EQ(results.measurements[1].value, 0.006);  // points of all deviations, −3 µm … +3 µm
    EXPECT_EQ(results.measurements[1].status, "FAIL");
    EXPECT_DOUBLE_EQ(results.measurements[2].value, 0.006);  // −3, −1, +1 µm
    EXPECT_EQ(results.measurements[2].status, "FAIL");
    report.best_fit.decision.limits = {-0.0045, 0.0015};
    EXPECT_EQ(readGood(test::qifText(report)).measurements[1].status, "FAIL");
    EXPECT_EQ(readGood(test::qifText(report)).measurements[2].status, "PASS");
    report.doubts.emplace_back("a reason");
    EXPECT_EQ(readGood(test::qifText(report)).measurements[2].status, "INDETERMINATE");
}

TEST(QifWriter, SaysTheDecision) {
    const auto status = [](Verdict verdict) {
        pugi::xml_document document;
        EXPECT_TRUE(document.load_string(test::qifText(test::qifReport(10, verdict)).c_str()));
        return std::string(document.select_node("//CharacteristicStatusEnum").node().child_value()) + " " +
               document.select_node("//InspectionStatusEnum").node().child_value();
    };
    EXPECT_EQ(status(Verdict::Accept), "PASS PASS");
    EXPECT_EQ(status(Verdict::Reject), "FAIL FAIL");
    EXPECT_EQ(status(Verdict::Undecided), "INDETERMINATE UNKNOWN");
    EXPECT_EQ(status(Verdict::NotAsked), " UNKNOWN");
}

TEST(QifWriter, SameReportSameBytesAndAnotherIdentityForAnother) {
    const std::string text = test::qifText(test::qifReport(100, Verdict::Accept));
    EXPECT_EQ(text, test::qifText(test::qifReport(100, Verdict::Accept)));
    InspectionReport other = test::qifReport(100, Verdict::Accept);
    other.best_fit.deviations[3].deviation_mm += 1e-9;
    const auto identity = [](const std::string& document) { return document.substr(document.find("<QPId>"), 50); };
    EXPECT_NE(identity(text), identity(test::qifText(other)));
}

TEST(QifWriter, ComesInPiecesAndStopsWhenItCannotWrite) {
    std::size_t calls = 0;
    std::size_t largest = 0;
    const auto done =
        writeQif(test::qifReport(50'000, Verdict::Accept), [&](std::string_view piece) -> base::Result<void> {
            largest = std::max(largest, piece.size());
            if (++calls == 3) return base::fail("io.write", "full");
            return {};
        });
    ASSERT_FALSE(done.has_value());
    EXPECT_EQ(done.error().front().code, "io.write");
    EXPECT_EQ(calls, 3U);
    EXPECT_LT(largest, 70'000U);
}

TEST(QifWriter, IsReadAsMeasuredPoints) {
    const InspectionReport report = test::qifReport(3000, Verdict::Accept);
    std::istringstream in(test::qifText(report));
    base::Diagnostics remarks;
    PointReaderOptions options;
    options.block_bytes = 1000;
    const auto points = readMeasuredPoints(in, "part.qif", options, remarks);
    ASSERT_TRUE(points.has_value()) << base::toText(points.error());
    EXPECT_EQ(points->format, "qif");
    EXPECT_EQ(points->kind, PointKind::Surface);
    EXPECT_TRUE(points->unit_stated);
    ASSERT_EQ(points->size(), 2999U);
    EXPECT_LT((points->positions[17] - report.best_fit.deviations[17].surfacePoint()).norm(), 1e-9);
    std::istringstream none("<QIFDocument versionQIF=\"3.0.0\"/>");
    const auto absent = readMeasuredPoints(none, "none.qif", {}, remarks);
    ASSERT_FALSE(absent.has_value());
    EXPECT_EQ(base::toText(absent.error()), "none.qif: error: the file holds no point [points.empty]\n");
}

/// A document with one diameter, measured on the parts as given; `unit` is the factor to metres.
std::string documentOf(const std::vector<double>& values, const std::string& unit, const std::string& tolerance) {
    std::ostringstream out;
    out.precision(17);
    out << R"(<QIFDocument xmlns="http://qifstandards.org/xsd/qif3" versionQIF="3.0.0" idMax="9"><FileUnits><PrimaryUnits>)"
        << "<LinearUnit><SIUnitName>meter</SIUnitName><UnitConversion><Factor>" << unit
        << "</Factor></UnitConversion></LinearUnit></PrimaryUnits></FileUnits><Characteristics>"
        << R"(<CharacteristicDefinitions n="1"><DiameterCharacteristicDefinition id="1">)" << tolerance
        << "</DiameterCharacteristicDefinition></CharacteristicDefinitions>"
        << R"(<CharacteristicNominals n="1"><DiameterCharacteristicNominal id="2"><CharacteristicDefinitionId>1)"
        << "</CharacteristicDefinitionId><TargetValue>10</TargetValue></DiameterCharacteristicNominal></CharacteristicNominals>"
        << R"(<CharacteristicItems n="1"><DiameterCharacteristicItem id="3"><Name>bore</Name>)"
        << "<CharacteristicNominalId>2</CharacteristicNominalId></DiameterCharacteristicItem></CharacteristicItems>"
        << "</Characteristics><Results><MeasurementResultsSet>";
    for (const double value : values)
        out << "<MeasurementResults><MeasuredCharacteristics><CharacteristicMeasurements>"
            << "<DiameterCharacteristicMeasurement><CharacteristicItemId>3</CharacteristicItemId><Value>" << value
            << "</Value></DiameterCharacteristicMeasurement></CharacteristicMeasurements></MeasuredCharacteristics>"
            << "</MeasurementResults>";
    out << "</MeasurementResultsSet></Results></QIFDocument>";
    return out.str();
}

const std::string plus_minus =
    "<Tolerance><MaxValue>0.2</MaxValue><MinValue>-0.1</MinValue><DefinedAsLimit>false</DefinedAsLimit></Tolerance>";

TEST(QifReader, ConvertsUnitsAndUnderstandsBothFormsOfLimits) {
    const QifResults inch = readGood(documentOf({10.0, 10.1}, "0.0254", plus_minus));
    EXPECT_NEAR(inch.measurements[1].value, 10.1 * 25.4, 1e-12);
    EXPECT_NEAR(inch.characteristics[0].lower.value_or(0.0), 9.9 * 25.4, 1e-12);
    EXPECT_NEAR(inch.characteristics[0].upper.value_or(0.0), 10.2 * 25.4, 1e-12);
    const QifResults limits = readGood(documentOf(
        {10.0}, "0.001",
        "<Tolerance><MaxValue>10.2</MaxValue><MinValue>9.9</MinValue><DefinedAsLimit>true</DefinedAsLimit></Tolerance>"));
    EXPECT_DOUBLE_EQ(limits.characteristics[0].lower.value_or(0.0), 9.9);
    EXPECT_DOUBLE_EQ(limits.characteristics[0].upper.value_or(0.0), 10.2);
    EXPECT_EQ(limits.parts[0].label, "part 1");
}

TEST(QifReader, WarnsOfWhatItAssumes) {
    std::string text = documentOf({10.0}, "0.001", "<ToleranceValue>-1</ToleranceValue>");
    text.erase(text.find("<FileUnits>"), text.find("</FileUnits>") + 12 - text.find("<FileUnits>"));
    base::Diagnostics warnings;
    ASSERT_TRUE(read(text, warnings).has_value());
    EXPECT_EQ(
        base::toText(warnings),
        "1: warning: DiameterCharacteristicDefinition 1: a zone of width -1 cannot be meant; the characteristic is taken "
        "as without limits [qif.tolerance]\n"
        "warning: the document states no unit of length; millimetres are assumed [qif.unit]\n");
}

/// The texts behind `expect: ` of the comment a file begins with, one problem each.
TEST(QifReader, RejectsEveryBrokenFileWithItsExactProblem) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/inspect/reject_qif")) {
        const std::string text = base::readWholeFile(entry.path(), 1 << 20).value_or("");
        const std::string mark = "<!-- expect: ";
        ASSERT_TRUE(text.starts_with(mark)) << entry.path();
        const std::string expected = text.substr(mark.size(), text.find(" -->") - mark.size()) + "\n";
        base::Diagnostics warnings;
        const auto results = read(text, warnings);
        EXPECT_EQ(results ? "accepted" : base::toText(results.error()), expected) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 10U);
}

CapabilitySeries seriesOf(const std::vector<double>& values, const std::string& tolerance = plus_minus) {
    const QifResults results = readGood(documentOf(values, "0.001", tolerance));
    const auto series = capabilityOf({&results, 1});
    EXPECT_TRUE(series.has_value());
    return series.value_or(std::vector<CapabilitySeries>(1)).at(0);
}

TEST(Capability, HasTheFiguresOfAWorkedExample) {
    // Values 9.98 10.02 10.00 10.04 10.01: mean 10.01, s² = (9 + 1 + 1 + 9 + 0)e-4/4 = 5e-4, moving ranges 4 2 4 3 e-2.
    const CapabilitySeries s = seriesOf({9.98, 10.02, 10.00, 10.04, 10.01});
    const double overall = std::sqrt(5e-4);
    const double within = 0.0325 / (2.0 / std::sqrt(std::acos(-1.0)));
    EXPECT_NEAR(s.mean, 10.01, 1e-12);
    EXPECT_NEAR(s.overall_deviation.value_or(0.0), overall, 1e-12);
    EXPECT_NEAR(s.within_deviation.value_or(0.0), within, 1e-12);
    EXPECT_NEAR(s.pp.value_or(0.0), 0.3 / (6.0 * overall), 1e-9);
    EXPECT_NEAR(s.ppk.value_or(0.0), 0.11 / (3.0 * overall), 1e-9);
    EXPECT_NEAR(s.cp.value_or(0.0), 0.3 / (6.0 * within), 1e-9);
    EXPECT_NEAR(s.cpk.value_or(0.0), 0.11 / (3.0 * within), 1e-9);
    EXPECT_NEAR(s.slope_per_part.value_or(0.0), (-2 * -0.03 + -1 * 0.01 + 1 * 0.03 + 2 * 0.0) / 10.0, 1e-12);
    EXPECT_FALSE(s.trend_probability.has_value());  // too few
    EXPECT_EQ(s.beyond_limits, 0U);
}

TEST(Capability, OneLimitOrNoSpreadGivesNoFalseFigure) {
    const CapabilitySeries one_sided = seriesOf(
        {10.0, 10.1, 10.05}, "<Tolerance><MaxValue>0.2</MaxValue><DefinedAsLimit>false</DefinedAsLimit></Tolerance>");
    EXPECT_FALSE(one_sided.cp.has_value() || one_sided.pp.has_value());
    EXPECT_NEAR(one_sided.ppk.value_or(0.0), 0.15 / (3.0 * 0.05), 1e-9);
    const CapabilitySeries alike = seriesOf({10.0, 10.0, 10.0});
    EXPECT_FALSE(alike.cp || alike.cpk || alike.pp || alike.ppk);
    const CapabilitySeries single = seriesOf({10.3});
    EXPECT_FALSE(single.cpk || single.ppk || single.overall_deviation);
    EXPECT_EQ(single.beyond_limits, 1U);
    EXPECT_FALSE(seriesOf({10.0, 10.1}, "").ppk.has_value());
}

TEST(Capability, SeesATrendAndSeldomOneThatIsNone) {
    base::Random random(7);
    int false_alarms = 0;
    constexpr int trials = 200;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<double> steady;
        std::vector<double> drifting;
        for (int i = 0; i < 20; ++i) {
            const double noise = 0.01 * random.normal();
            steady.push_back(10.0 + noise);
            drifting.push_back(10.0 + noise + 0.005 * i);
        }
        EXPECT_LT(seriesOf(drifting).trend_probability.value_or(1.0), 0.001);
        false_alarms += seriesOf(steady).trend_probability.value_or(1.0) < 0.05 ? 1 : 0;
    }
    // 5 % of 200 is 10 ± 3; five standard deviations.
    EXPECT_LE(false_alarms, 26);
    EXPECT_GE(false_alarms, 1);
}

TEST(Capability, FilesFollowEachOtherAndMustAgree) {
    const QifResults first = readGood(documentOf({10.0, 10.1}, "0.001", plus_minus));
    const QifResults second = readGood(documentOf({10.2}, "0.001", plus_minus));
    const std::vector<QifResults> both{first, second};
    const auto series = capabilityOf(both);
    ASSERT_TRUE(series.has_value());
    ASSERT_EQ(series->size(), 1U);
    EXPECT_EQ(series->at(0).parts, (std::vector<std::size_t>{0, 1, 2}));
    EXPECT_EQ(series->at(0).values, (std::vector<double>{10.0, 10.1, 10.2}));
    QifResults other = second;
    other.source = "b.qif";
    other.characteristics[0].upper = 11.0;
    const auto disagreeing = capabilityOf(std::vector<QifResults>{first, other});
    ASSERT_FALSE(disagreeing.has_value());
    EXPECT_EQ(base::toText(disagreeing.error()),
              "b.qif: error: 'bore' has other limits than in the files before [capability.limits]\n");
}

}  // namespace
}  // namespace cusp::inspect
