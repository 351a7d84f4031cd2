// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The texts, in the order the schema of QIF 3.0 wants their elements.
#include "qif/qif_parts.hpp"

#include <cusp/base/number_text.hpp>
#include <cusp/base/version.hpp>

#include <fmt/format.h>
#include <utility>

namespace cusp::inspect {

namespace {

constexpr int decimals = 9;

std::string identityOf(std::string hex) {
    hex[12] = '8';
    hex[16] = "89ab"[static_cast<unsigned char>(hex[16]) % 4];
    return fmt::format("{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4), hex.substr(16, 4),
                       hex.substr(20, 12));
}

}  // namespace

std::string qifEscaped(std::string_view text) {
    std::string out;
    for (const char character : text) {
        const auto byte = static_cast<unsigned char>(character);
        if (character == '&')
            out += "&amp;";
        else if (character == '<')
            out += "&lt;";
        else if (character == '>')
            out += "&gt;";
        else
            out += byte < 0x20 ? ' ' : character;  // XML 1.0 cannot say control characters
    }
    return out;
}

std::string qifDecimal(double value) { return base::formatFixed(value, decimals, base::TrailingZeros::Strip); }

std::string qifHead(std::string digest, int last_id, std::string_view comments) {
    return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
{}<QIFDocument xmlns="http://qifstandards.org/xsd/qif3" versionQIF="3.0.0" idMax="{}">
  <QPId>{}</QPId>
  <Header>
    <Application>
      <Name>cusp {}</Name>
    </Application>
  </Header>
)",
                       comments, last_id, identityOf(std::move(digest)), base::version());
}

std::string qifUnits() {
    return R"(  <FileUnits>
    <PrimaryUnits>
      <AngularUnit>
        <SIUnitName>radian</SIUnitName>
        <UnitName>radian</UnitName>
      </AngularUnit>
      <LinearUnit>
        <SIUnitName>meter</SIUnitName>
        <UnitName>mm</UnitName>
        <UnitConversion>
          <Factor>0.001</Factor>
        </UnitConversion>
      </LinearUnit>
    </PrimaryUnits>
  </FileUnits>
)";
}

std::string qifFeature(const QifFeatureIds& ids, std::string_view name) {
    return fmt::format(R"(  <Features>
    <FeatureDefinitions n="1">
      <OtherSurfaceFeatureDefinition id="{0}"/>
    </FeatureDefinitions>
    <FeatureNominals n="1">
      <OtherSurfaceFeatureNominal id="{1}">
        <FeatureDefinitionId>{0}</FeatureDefinitionId>
      </OtherSurfaceFeatureNominal>
    </FeatureNominals>
    <FeatureItems n="1">
      <OtherSurfaceFeatureItem id="{2}">
        <FeatureNominalId>{1}</FeatureNominalId>
        <FeatureName>{3}</FeatureName>
        <DeterminationMode>
          <Checked>
            <CheckDetails>
              <Measured/>
            </CheckDetails>
          </Checked>
        </DeterminationMode>
      </OtherSurfaceFeatureItem>
    </FeatureItems>
  </Features>
)",
                       ids.definition, ids.nominal, ids.item, qifEscaped(name));
}

}  // namespace cusp::inspect
