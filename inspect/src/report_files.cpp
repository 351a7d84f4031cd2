// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rows are made in blocks by several threads and written in order.
#include <cusp/inspect/report_files.hpp>

#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

namespace cusp::inspect {
namespace {

constexpr std::size_t block_rows = 4096;
constexpr std::size_t blocks_at_once = 32;

/// `row(i, text)` appends row i.
template <class Row>
base::Result<void> writeRows(std::size_t rows, const ByteSink& sink, const Row& row) {
    std::vector<std::string> texts(blocks_at_once);
    for (std::size_t first = 0; first < rows; first += block_rows * blocks_at_once) {
        oneapi::tbb::parallel_for(std::size_t{0}, blocks_at_once, [&](std::size_t block) {
            texts[block].clear();
            const std::size_t begin = first + block * block_rows;
            for (std::size_t i = begin; i < std::min(rows, begin + block_rows); ++i) row(i, texts[block]);
        });
        for (const std::string& text : texts)
            if (auto done = sink(text); !done) return done;
    }
    return {};
}

void append(std::string& text, double value, int decimals) {
    base::appendFixed(text, value, decimals, base::TrailingZeros::Strip);
    text += ',';
}

void append(std::string& text, const Vector3& v, int decimals) {
    for (const double value : v) append(text, value, decimals);
}

constexpr int position_decimals = 9;
constexpr int deviation_decimals = 12;

/// A field with a comma, a quote or a line feed goes into quotes.
std::string csvField(const std::string& text) {
    if (text.find_first_of(",\"\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + '"';
}

template <class T>
void appendBytes(std::string& out, T value) {
    std::array<char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), &value, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::reverse(bytes.begin(), bytes.end());
    out.append(bytes.data(), bytes.size());
}

/// Blue, green, red over −1 … 1.
std::array<unsigned char, 3> colourOf(double share) {
    const double s = std::clamp(share, -1.0, 1.0);
    const auto byte = [](double v) { return static_cast<unsigned char>(std::lround(255.0 * v)); };
    return {byte(std::max(0.0, s)), byte(1.0 - std::abs(s)), byte(std::max(0.0, -s))};
}

}  // namespace

base::Result<void> writePointsCsv(const InspectionReport& report, const ByteSink& sink) {
    if (auto done = sink("point,line,x_mm,y_mm,z_mm,nominal_x_mm,nominal_y_mm,nominal_z_mm,i,j,k,deviation_mm,"
                         "datum_deviation_mm,best_fit_deviation_mm,beyond_edge_mm,outlier,section\n");
        !done)
        return done;
    const Evaluation& judged = report.judged();
    std::vector<char> is_outlier(report.points.size(), '0');
    for (const std::uint32_t i : judged.outliers) is_outlier[i] = '1';
    return writeRows(report.points.size(), sink, [&](std::size_t i, std::string& text) {
        const PointDeviation& d = judged.deviations[i];
        text += fmt::format_int(i).c_str();
        text += ',';
        text += fmt::format_int(report.points.lines[i]).c_str();
        text += ',';
        append(text, report.points.positions[i], position_decimals);
        append(text, d.nominal, position_decimals);
        append(text, d.normal, position_decimals);
        append(text, d.deviation_mm, deviation_decimals);
        append(text, report.datum.deviations[i].deviation_mm, deviation_decimals);
        append(text, report.best_fit.deviations[i].deviation_mm, deviation_decimals);
        append(text, d.beyond_edge_mm, position_decimals);
        text += is_outlier[i];
        text += ',';
        const std::int32_t section = report.points.sections.empty() ? -1 : report.points.sections[i];
        if (section >= 0) text += csvField(report.points.section_labels[static_cast<std::size_t>(section)]);
        text += '\n';
    });
}

base::Result<void> writeSectionsCsv(const InspectionReport& report, const ByteSink& sink) {
    if (auto done = sink("section,number,arc_length_mm,deviation_mm,point,nominal_x_mm,nominal_y_mm,nominal_z_mm\n");
        !done)
        return done;
    for (const SectionResult& section : report.sections) {
        const std::string label = csvField(section.label);
        auto done = writeRows(section.points.size(), sink, [&](std::size_t k, std::string& text) {
            const std::uint32_t point = section.points[k];
            const PointDeviation& d = report.judged().deviations[point];
            text += label;
            text += ',';
            text += fmt::format_int(k + 1).c_str();
            text += ',';
            append(text, section.arc_length_mm[k], position_decimals);
            append(text, d.deviation_mm, deviation_decimals);
            text += fmt::format_int(point).c_str();
            text += ',';
            append(text, d.nominal, position_decimals);
            text.back() = '\n';
        });
        if (!done) return done;
    }
    return {};
}

base::Result<void> writeDeviationPly(const InspectionReport& report, const ByteSink& sink) {
    if (auto done = sink(fmt::format(
            "ply\nformat binary_little_endian 1.0\ncomment deviations along the outward normal, in mm\nelement vertex {}\n"
            "property double x\nproperty double y\nproperty double z\nproperty float nx\nproperty float ny\nproperty float nz\n"
            "property double deviation_mm\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
            report.points.size()));
        !done)
        return done;
    const Evaluation& judged = report.judged();
    const bool has_limits = judged.decision.limits.upper_mm > judged.decision.limits.lower_mm;
    const double largest = std::max(0.5 * judged.statistics.profile_mm, 1e-12);
    const double upper = has_limits ? std::max(judged.decision.limits.upper_mm, 1e-12) : largest;
    const double lower = has_limits ? std::max(-judged.decision.limits.lower_mm, 1e-12) : largest;
    return writeRows(report.points.size(), sink, [&](std::size_t i, std::string& bytes) {
        const PointDeviation& d = judged.deviations[i];
        for (const double value : d.surfacePoint()) appendBytes(bytes, value);
        for (const double value : d.normal) appendBytes(bytes, static_cast<float>(value));
        appendBytes(bytes, d.deviation_mm);
        for (const unsigned char c : colourOf(d.deviation_mm > 0.0 ? d.deviation_mm / upper : d.deviation_mm / lower))
            bytes += static_cast<char>(c);
    });
}

}  // namespace cusp::inspect
