// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A document of one feature and one point set; ids are constants.
#include <cusp/inspect/qif_points_writer.hpp>

#include "qif/qif_parts.hpp"

#include <cusp/base/hash.hpp>

#include <fmt/format.h>

namespace cusp::inspect {

namespace {

constexpr int last_id = 5;

std::string listText(const std::vector<Vector3>& values) {
    std::string out;
    for (const Vector3& v : values)
        out += (out.empty() ? "" : "\n") + qifDecimal(v.x()) + " " + qifDecimal(v.y()) + " " + qifDecimal(v.z());
    return out;
}

/// XML knows no "--" within a comment.
std::string withoutDashes(std::string text) {
    for (std::size_t at = 0; (at = text.find("--", at)) != std::string::npos;) text.replace(at, 2, "- ");
    return text;
}

}  // namespace

std::string qifOfCentres(const MeasuredPoints& points, const std::vector<std::string>& remarks) {
    std::string comments;
    for (const std::string& remark : remarks) comments += "<!-- " + withoutDashes(remark) + " -->\n";
    const std::string positions = listText(points.positions);
    return qifHead(base::sha256Hex(positions), last_id, comments) + qifUnits() +
           qifFeature({1, 2, 3}, "measured surface") +
           fmt::format(R"(  <Results>
    <MeasurementResultsSet n="1">
      <MeasurementResults id="4">
        <MeasuredPointSets n="1">
          <MeasuredPointSet count="{0}" id="5">
            <Points>{1}</Points>
            <Normals>{2}</Normals>
            <Compensated>false</Compensated>
            <ProbeRadius>{3}</ProbeRadius>
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
                       points.size(), positions, listText(points.directions),
                       qifDecimal(points.probe_radius_mm.value_or(0.0)));
}

}  // namespace cusp::inspect
