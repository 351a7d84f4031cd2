// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Writers of measured centres; cusp inspect's readers take each of them.
#include <cusp/loop/measurement_files.hpp>

#include <cusp/base/hash.hpp>
#include <cusp/base/number_text.hpp>
#include <cusp/base/version.hpp>

#include <fmt/format.h>

#include <cctype>
#include <string>

namespace cusp::loop {
namespace {

using geometry::Vector3;

constexpr int decimals = 7;

std::string triple(const Vector3& v, std::string_view separator) {
    return base::formatFixed(v.x(), decimals) + std::string(separator) + base::formatFixed(v.y(), decimals) +
           std::string(separator) + base::formatFixed(v.z(), decimals);
}

std::string tableText(const inspect::MeasuredPoints& points, const FileRemarks& remarks) {
    std::string out;
    for (const std::string& remark : remarks) out += "# " + remark + "\n";
    out += fmt::format("# probe centre, mm; probe radius = {}\n",
                       base::formatShortest(points.probe_radius_mm.value_or(0.0)));
    const bool has_sections = !points.sections.empty();
    out += has_sections ? "section,x_mm,y_mm,z_mm,i,j,k\n" : "x_mm,y_mm,z_mm,i,j,k\n";
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (has_sections)
            out += (points.sections[i] < 0 ? std::string()
                                           : points.section_labels[static_cast<std::size_t>(points.sections[i])]) +
                   ",";
        out += triple(points.positions[i], ",") + "," + triple(points.directions[i], ",") + "\n";
    }
    return out;
}

std::string dmisText(const inspect::MeasuredPoints& points, const FileRemarks& remarks) {
    std::string out = "DMISMN/'cusp measure',05.0\n";
    for (const std::string& remark : remarks) out += "$$ " + remark + "\n";
    out += fmt::format("$$ BALL CENTRES; PROBE RADIUS {} MM\n",
                       base::formatShortest(points.probe_radius_mm.value_or(0.0)));
    out += "UNITS/MM,ANGDEC\nPRCOMP/OFF\n";
    for (std::size_t i = 0; i < points.size(); ++i)
        out += fmt::format("FA(P{})=FEAT/POINT,CART,{},$\n{}\n", i + 1, triple(points.positions[i], ","),
                           triple(points.directions[i], ","));
    return out + "ENDFIL\n";
}

/// RFC 9562, version 8: an identity made from the content.
std::string identityOf(const std::string& content) {
    std::string hex = base::sha256Hex(content);
    hex[12] = '8';
    hex[16] = "89ab"[static_cast<unsigned char>(hex[16]) % 4];
    return fmt::format("{}-{}-{}-{}-{}", hex.substr(0, 8), hex.substr(8, 4), hex.substr(12, 4), hex.substr(16, 4),
                       hex.substr(20, 12));
}

std::string listText(const std::vector<Vector3>& values) {
    std::string out;
    for (const Vector3& value : values) out += (out.empty() ? "" : "\n") + triple(value, " ");
    return out;
}

/// XML knows no "--" within a comment.
std::string withoutDashes(std::string text) {
    for (std::size_t at = 0; (at = text.find("--", at)) != std::string::npos;) text.replace(at, 2, "- ");
    return text;
}

std::string qifText(const inspect::MeasuredPoints& points, const FileRemarks& remarks) {
    std::string notes;
    for (const std::string& remark : remarks) notes += "<!-- " + withoutDashes(remark) + " -->\n";
    const std::string positions = listText(points.positions);
    return fmt::format(R"(<?xml version="1.0" encoding="UTF-8"?>
{0}<QIFDocument xmlns="http://qifstandards.org/xsd/qif3" versionQIF="3.0.0" idMax="5">
  <QPId>{1}</QPId>
  <Header>
    <Application>
      <Name>cusp {2}</Name>
    </Application>
  </Header>
  <FileUnits>
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
  <Features>
    <FeatureDefinitions n="1">
      <OtherSurfaceFeatureDefinition id="1"/>
    </FeatureDefinitions>
    <FeatureNominals n="1">
      <OtherSurfaceFeatureNominal id="2">
        <FeatureDefinitionId>1</FeatureDefinitionId>
      </OtherSurfaceFeatureNominal>
    </FeatureNominals>
    <FeatureItems n="1">
      <OtherSurfaceFeatureItem id="3">
        <FeatureNominalId>2</FeatureNominalId>
        <FeatureName>measured surface</FeatureName>
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
  <Results>
    <MeasurementResultsSet n="1">
      <MeasurementResults id="4">
        <MeasuredPointSets n="1">
          <MeasuredPointSet count="{3}" id="5">
            <Points>{4}</Points>
            <Normals>{5}</Normals>
            <Compensated>false</Compensated>
            <ProbeRadius>{6}</ProbeRadius>
          </MeasuredPointSet>
        </MeasuredPointSets>
        <InspectionStatus>
          <InspectionStatusEnum>UNKNOWN</InspectionStatusEnum>
        </InspectionStatus>
      </MeasurementResults>
    </MeasurementResultsSet>
  </Results>
</QIFDocument>
)",
                       notes, identityOf(positions), base::version(), points.size(), positions,
                       listText(points.directions),
                       base::formatFixed(points.probe_radius_mm.value_or(0.0), decimals, base::TrailingZeros::Strip));
}

}  // namespace

base::Result<std::string> measurementFormat(std::string_view path) {
    const std::size_t dot = path.rfind('.');
    std::string ending(dot == std::string_view::npos ? std::string_view() : path.substr(dot + 1));
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (ending == "csv" || ending == "txt" || path == "-") return std::string("csv");
    if (ending == "dmo" || ending == "dms") return std::string("dmis");
    if (ending == "qif") return std::string("qif");
    return base::fail("measure.format",
                      fmt::format("{}: the ending says the format: .csv, .dmo (DMIS output) or .qif", path));
}

std::string measurementText(const inspect::MeasuredPoints& points, const std::string& format,
                            const FileRemarks& remarks) {
    if (format == "dmis") return dmisText(points, remarks);
    if (format == "qif") return qifText(points, remarks);
    return tableText(points, remarks);
}

}  // namespace cusp::loop
