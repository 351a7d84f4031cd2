// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One definition for all sections; a nominal, an item and a measurement for each.
#include "qif/qif_sections.hpp"

#include <cusp/base/number_text.hpp>

#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace cusp::inspect {
namespace {

/// A picometre: xs:decimal knows no exponent.
std::string decimal(double value) {
    constexpr int decimals = 9;
    return base::formatFixed(value, decimals, base::TrailingZeros::Strip);
}

std::string_view statusOf(const InspectionReport& report, const SectionResult& section) {
    if (!report.doubts.empty()) return "INDETERMINATE";
    const Evaluation& judged = report.judged();
    std::vector<double> deviations_mm;
    deviations_mm.reserve(section.points.size());
    for (const std::uint32_t point : section.points) deviations_mm.push_back(judged.deviations[point].deviation_mm);
    const Decision& whole = judged.decision;
    switch (decide(deviations_mm, whole.limits, whole.uncertainty, whole.rule).verdict) {
        case Verdict::Accept: return "PASS";
        case Verdict::Reject: return "FAIL";
        default: return "INDETERMINATE";
    }
}

std::string nominalText(const QifSectionIds& ids, int definition_id, int id, int axis) {
    return fmt::format(R"(      <LineProfileCharacteristicNominal id="{}">
        <CharacteristicDefinitionId>{}</CharacteristicDefinitionId>
        <FeatureNominalIds n="1">
          <Id>{}</Id>
        </FeatureNominalIds>
        <Vector>{} {} {}</Vector>
      </LineProfileCharacteristicNominal>
)",
                       id, definition_id, ids.feature_nominal, axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0);
}

std::string itemText(const QifSectionIds& ids, int nominal_id, int id, const std::string& label) {
    return fmt::format(R"(      <LineProfileCharacteristicItem id="{}">
        <Name>line profile {}</Name>
        <FeatureItemIds n="1">
          <Id>{}</Id>
        </FeatureItemIds>
        <CharacteristicNominalId>{}</CharacteristicNominalId>
      </LineProfileCharacteristicItem>
)",
                       id, label, ids.feature_item, nominal_id);
}

std::string measurementText(const QifSectionIds& ids, int item_id, int id, const DeviationStatistics& s,
                            std::string_view status) {
    return fmt::format(R"(            <LineProfileCharacteristicMeasurement id="{}">
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
            </LineProfileCharacteristicMeasurement>
)",
                       id, status, item_id, ids.measured_feature, decimal(s.profile_mm), decimal(s.max_mm),
                       decimal(s.min_mm));
}

}  // namespace

QifSections qifSections(const InspectionReport& report, const QifSectionIds& ids) {
    QifSections out;
    const Decision& decision = report.judged().decision;
    const int definition_id = ids.first_free;
    out.last_id = definition_id - 1;
    if (decision.verdict == Verdict::NotAsked) return out;
    int next = definition_id + 1;
    for (const SectionResult& section : report.sections) {
        if (!section.axis || section.points.empty()) continue;
        const int nominal_id = next++;
        const int item_id = next++;
        const int measurement_id = next++;
        out.nominals += nominalText(ids, definition_id, nominal_id, *section.axis);
        out.items += itemText(ids, nominal_id, item_id, sectionLabel(*section.axis, section.position_mm));
        out.measurements +=
            measurementText(ids, item_id, measurement_id, section.statistics, statusOf(report, section));
        out.last_id = measurement_id;
        ++out.count;
    }
    if (out.count == 0) return out;
    out.definition = fmt::format(R"(      <LineProfileCharacteristicDefinition id="{}">
        <ToleranceValue>{}</ToleranceValue>
        <OuterDisposition>{}</OuterDisposition>
      </LineProfileCharacteristicDefinition>
)",
                                 definition_id, decimal(decision.limits.upper_mm - decision.limits.lower_mm),
                                 decimal(decision.limits.upper_mm));
    return out;
}

}  // namespace cusp::inspect
