// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Writers of measured centres; cusp inspect's readers take each of them.
#include <cusp/loop/measurement_files.hpp>

#include <cusp/base/number_text.hpp>
#include <cusp/inspect/qif_points_writer.hpp>

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
    if (format == "qif") return inspect::qifOfCentres(points, remarks);
    return tableText(points, remarks);
}

}  // namespace cusp::loop
