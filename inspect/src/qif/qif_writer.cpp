// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The elements in the order the schema of QIF 3.0 wants them; ids are constants, those of sections follow them.
#include "qif/qif_parts.hpp"
#include "qif/qif_sections.hpp"

#include <cusp/base/hash.hpp>
#include <cusp/inspect/qif_writer.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <fmt/format.h>
#include <string>

namespace cusp::inspect {

namespace {

constexpr std::size_t piece_bytes = 64 * 1024;

void hashNumber(base::Sha256& hash, double value) {
    const auto bits = std::bit_cast<std::uint64_t>(value);
    std::array<std::uint8_t, 8> bytes{};
    for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = static_cast<std::uint8_t>(bits >> (8 * i));
    hash.update(std::span<const std::uint8_t>(bytes));
}

class Writer {
public:
    Writer(const InspectionReport& report, const std::function<base::Result<void>(std::string_view)>& sink)
        : report_(report), judged_(report.judged()), sink_(sink) {
        for (std::size_t i = 0; i < judged_.deviations.size(); ++i)
            if (counts(i)) ++points_;
        has_limits_ = judged_.decision.verdict != Verdict::NotAsked;
        sections_ = qifSections(
            report, {feature_nominal_id, feature_item_id, measured_feature_id, measured_characteristic_id + 1});
    }

    base::Result<void> write() {
        out_ += qifHead(digest(), sections_.last_id, {});
        if (has_limits_) standards();
        out_ += qifUnits();
        out_ += qifFeature({feature_definition_id, feature_nominal_id, feature_item_id}, report_.nominal_file);
        if (has_limits_) characteristics();
        results();
        out_ += "</QIFDocument>\n";
        flush();
        if (failure_.hasErrors()) return base::fail(failure_);
        return {};
    }

private:
    static constexpr int standard_id = 1;
    static constexpr int feature_definition_id = 2;
    static constexpr int feature_nominal_id = 3;
    static constexpr int feature_item_id = 4;
    static constexpr int characteristic_definition_id = 5;
    static constexpr int characteristic_nominal_id = 6;
    static constexpr int characteristic_item_id = 7;
    static constexpr int results_id = 8;
    static constexpr int measured_feature_id = 9;
    static constexpr int point_set_id = 10;
    static constexpr int measured_characteristic_id = 11;

    bool counts(std::size_t point) const {
        return judged_.deviations[point].beyond_edge_mm <= report_.edge_tolerance_mm;
    }

    void flush() {
        if (!failure_.hasErrors())
            if (const auto done = sink_(out_); !done) failure_ = done.error();
        out_.clear();
    }
    void flushWhenFull() {
        if (out_.size() >= piece_bytes) flush();
    }

    std::string digest() const {
        base::Sha256 hash;
        hash.update(report_.points_file);
        hash.update(report_.nominal_file);
        for (const PointDeviation& point : judged_.deviations) {
            for (const double coordinate : point.nominal) hashNumber(hash, coordinate);
            hashNumber(hash, point.deviation_mm);
        }
        return hash.hex();
    }

    void standards() {
        out_ += fmt::format(R"(  <StandardsDefinitions n="1">
    <Standard id="{}">
      <Organization>
        <StandardsOrganizationEnum>ISO</StandardsOrganizationEnum>
      </Organization>
      <Designator>1101</Designator>
      <Year>2017</Year>
    </Standard>
  </StandardsDefinitions>
)",
                            standard_id);
    }

    void characteristics() {
        const ToleranceLimits& limits = judged_.decision.limits;
        out_ += fmt::format(R"(  <Characteristics>
    <FormalStandardId>{0}</FormalStandardId>
    <CharacteristicDefinitions n="{8}">
      <SurfaceProfileCharacteristicDefinition id="{1}">
        <ToleranceValue>{2}</ToleranceValue>
        <OuterDisposition>{3}</OuterDisposition>
      </SurfaceProfileCharacteristicDefinition>
{10}    </CharacteristicDefinitions>
    <CharacteristicNominals n="{9}">
      <SurfaceProfileCharacteristicNominal id="{4}">
        <CharacteristicDefinitionId>{1}</CharacteristicDefinitionId>
        <FeatureNominalIds n="1">
          <Id>{5}</Id>
        </FeatureNominalIds>
      </SurfaceProfileCharacteristicNominal>
{11}    </CharacteristicNominals>
    <CharacteristicItems n="{9}">
      <SurfaceProfileCharacteristicItem id="{6}">
        <Name>surface profile</Name>
        <FeatureItemIds n="1">
          <Id>{7}</Id>
        </FeatureItemIds>
        <CharacteristicNominalId>{4}</CharacteristicNominalId>
      </SurfaceProfileCharacteristicItem>
{12}    </CharacteristicItems>
  </Characteristics>
)",
                            standard_id, characteristic_definition_id, qifDecimal(limits.upper_mm - limits.lower_mm),
                            qifDecimal(limits.upper_mm), characteristic_nominal_id, feature_nominal_id,
                            characteristic_item_id, feature_item_id, sections_.count > 0 ? 2 : 1, 1 + sections_.count,
                            sections_.definition, sections_.nominals, sections_.items);
    }

    void results() {
        out_ += fmt::format(R"(  <Results>
    <MeasurementResultsSet n="1">
      <MeasurementResults id="{}">
        <MeasuredFeatures n="1">
          <OtherSurfaceFeatureMeasurement id="{}">
            <FeatureItemId>{}</FeatureItemId>
)",
                            results_id, measured_feature_id, feature_item_id);
        if (points_ > 0)
            out_ += fmt::format(R"(            <PointList n="1">
              <WholePointSetId>{}</WholePointSetId>
            </PointList>
)",
                                point_set_id);
        out_ += R"(          </OtherSurfaceFeatureMeasurement>
        </MeasuredFeatures>
)";
        if (points_ > 0) pointSet();
        if (has_limits_) measuredCharacteristic();
        out_ += fmt::format(R"(        <InspectionStatus>
          <InspectionStatusEnum>{}</InspectionStatusEnum>
        </InspectionStatus>
      </MeasurementResults>
    </MeasurementResultsSet>
  </Results>
)",
                            inspectionStatus());
    }

    void pointSet() {
        out_ +=
            fmt::format("        <MeasuredPointSets n=\"1\">\n          <MeasuredPointSet count=\"{}\" id=\"{}\">\n",
                        points_, point_set_id);
        list("Points", [](const PointDeviation& point) {
            const Vector3 at = point.surfacePoint();
            return fmt::format("{} {} {}", qifDecimal(at.x()), qifDecimal(at.y()), qifDecimal(at.z()));
        });
        list("Normals", [](const PointDeviation& point) {
            return fmt::format("{} {} {}", qifDecimal(point.normal.x()), qifDecimal(point.normal.y()),
                               qifDecimal(point.normal.z()));
        });
        out_ += "            <Compensated>true</Compensated>\n";
        list("Deviations", [](const PointDeviation& point) { return qifDecimal(point.deviation_mm); });
        out_ += "          </MeasuredPointSet>\n        </MeasuredPointSets>\n";
    }

    void list(std::string_view name, std::string (*text)(const PointDeviation&)) {
        out_ += fmt::format("            <{}>", name);
        bool first = true;
        for (std::size_t i = 0; i < judged_.deviations.size(); ++i) {
            if (!counts(i)) continue;
            if (!first) out_ += '\n';
            first = false;
            out_ += text(judged_.deviations[i]);
            flushWhenFull();
        }
        out_ += fmt::format("</{}>\n", name);
    }

    void measuredCharacteristic() {
        const DeviationStatistics& s = judged_.statistics;
        out_ += fmt::format(R"(        <MeasuredCharacteristics>
          <CharacteristicMeasurements n="{}">
            <SurfaceProfileCharacteristicMeasurement id="{}">
              <Status>
                <CharacteristicStatusEnum>{}</CharacteristicStatusEnum>
              </Status>
              <CharacteristicItemId>{}</CharacteristicItemId>
              <FeatureMeasurementIds n="1">
                <Id>{}</Id>
              </FeatureMeasurementIds>
              <Value>{}</Value>
              <WorstPositiveDeviation>{}</WorstPositiveDeviation>
              <WorstNegativeDeviation>{}</WorstNegativeDeviation>
            </SurfaceProfileCharacteristicMeasurement>
{}          </CharacteristicMeasurements>
        </MeasuredCharacteristics>
)",
                            1 + sections_.count, measured_characteristic_id, characteristicStatus(),
                            characteristic_item_id, measured_feature_id, qifDecimal(s.profile_mm), qifDecimal(s.max_mm),
                            qifDecimal(s.min_mm), sections_.measurements);
    }

    std::string_view characteristicStatus() const {
        switch (judged_.decision.verdict) {
            case Verdict::Accept: return "PASS";
            case Verdict::Reject: return "FAIL";
            default: return "INDETERMINATE";
        }
    }
    std::string_view inspectionStatus() const {
        switch (judged_.decision.verdict) {
            case Verdict::Accept: return "PASS";
            case Verdict::Reject: return "FAIL";
            default: return "UNKNOWN";
        }
    }

    const InspectionReport& report_;
    const Evaluation& judged_;
    const std::function<base::Result<void>(std::string_view)>& sink_;
    std::string out_;
    std::size_t points_ = 0;
    bool has_limits_ = false;
    QifSections sections_;
    base::Diagnostics failure_;
};

}  // namespace

base::Result<void> writeQif(const InspectionReport& report,
                            const std::function<base::Result<void>(std::string_view)>& sink) {
    return Writer(report, sink).write();
}

}  // namespace cusp::inspect
