// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CSV, XYZ and ASC: one point a line, whatever separates the numbers.
#include "points/formats.hpp"
#include "points/point_text.hpp"
#include "points/table_layout.hpp"

#include <cusp/base/number_text.hpp>

#include <cctype>
#include <cmath>
#include <fmt/format.h>

namespace cusp::inspect {
namespace {

constexpr std::size_t head_bytes = std::size_t{1} << 16U;
constexpr std::size_t lines_looked_at = 200;

struct Head {
    std::string text;
    std::vector<std::string_view> lines;
    std::vector<std::uint64_t> numbers;
};

/// The first lines that are no remarks; the last of a head cut off in the middle is left out.
Head headOf(ByteSource& source) {
    Head head;
    head.text = std::string(source.peek(head_bytes));
    const std::string_view text = head.text;
    const bool cut = text.size() == head_bytes;
    std::uint64_t number = 0;
    for (std::size_t at = 0; at < text.size() && head.lines.size() < lines_looked_at;) {
        const std::size_t end = text.find_first_of("\r\n", at);
        if (end == std::string_view::npos && cut && !head.lines.empty()) break;
        const std::string_view line = text.substr(at, end == std::string_view::npos ? end : end - at);
        ++number;
        if (!trimmed(line).empty() && !isRemark(line)) {
            head.lines.push_back(line);
            head.numbers.push_back(number);
        }
        if (end == std::string_view::npos) break;
        at = end + (text.substr(end, 2) == "\r\n" ? 2 : 1);
    }
    return head;
}

/// The number right behind a word and what separates them: "probe radius = 1.5 mm".
std::optional<double> numberBehind(std::string_view text, std::size_t at) {
    const std::size_t begin = text.find_first_not_of(" \t:=,", at);
    if (begin == std::string_view::npos) return std::nullopt;
    const std::size_t end = text.find_first_not_of("0123456789.", begin);
    return base::parseDouble(text.substr(begin, end == std::string_view::npos ? end : end - begin));
}

/// What remarks before the points say of them.
void takeRemark(std::string_view line, PointCollector& out) {
    const std::string text = lowered(line);
    for (const std::string_view words :
         {"probe-centre", "probe centre", "probe-center", "probe center", "ball centre", "ball center", "stylus centre",
          "stylus center", "not compensated", "uncompensated"})
        if (text.find(words) != std::string::npos) return out.kind(PointKind::Centre);
    for (const std::string_view words : {"surface point", "contact point", "compensated point"})
        if (text.find(words) != std::string::npos) return out.kind(PointKind::Surface);
}

void takeRadius(std::string_view line, PointCollector& out) {
    const std::string text = lowered(line);
    for (const std::string_view words : {"probe radius", "probe_radius", "stylus radius", "ball radius"}) {
        std::size_t at = text.find(words);
        if (at == std::string::npos) continue;
        at += words.size();
        if (text.compare(at, 3, "_mm") == 0) at += 3;
        if (const auto radius = numberBehind(text, at); radius && *radius > 0.0) out.probeRadius(*radius);
    }
}

class RowReader {
public:
    RowReader(const TableLayout& layout, PointCollector& out) : layout_(layout), out_(out) {}

    void read(std::string_view line, std::uint64_t number) {
        splitFields(line, layout_.separator, fields_);
        if (fields_.size() != layout_.columns)
            return out_.error("points.columns",
                              fmt::format("{} columns where the table has {}", fields_.size(), layout_.columns),
                              number);
        Vector3 position;
        if (!triple(layout_.position, number, position)) return;
        Vector3 direction;
        if (layout_.direction && !triple(*layout_.direction, number, direction)) return;
        const std::optional<double> weight = layout_.weight ? weightAt(*layout_.weight, number) : std::nullopt;
        if (layout_.weight && !weight) return;
        out_.add(number, position);
        if (weight) out_.weight(*weight);
        if (layout_.direction) out_.direction(direction);
        if (layout_.section) out_.section(sectionLabel(fields_[*layout_.section]));
    }

private:
    bool triple(const std::array<std::size_t, 3>& columns, std::uint64_t number, Vector3& value) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::string_view field = fields_[columns[i]];
            const auto parsed = parseNumber(field, layout_.decimal);
            if (!parsed) {
                out_.error("points.number",
                           isNotANumber(field)
                               ? fmt::format("column {} has no value ({})", columns[i] + 1, field)
                               : fmt::format("column {}: {} is no number", columns[i] + 1, inQuotes(field)),
                           number);
                return false;
            }
            value[static_cast<Eigen::Index>(i)] = *parsed;
        }
        return true;
    }

    std::optional<double> weightAt(std::size_t column, std::uint64_t number) {
        const auto parsed = parseNumber(fields_[column], layout_.decimal);
        if (parsed && *parsed >= 0.0 && std::isfinite(*parsed)) return parsed;
        out_.error("points.number",
                   fmt::format("column {}: {} is no weight; a weight is a number, 0 or more", column + 1,
                               inQuotes(fields_[column])),
                   number);
        return std::nullopt;
    }

    /// "X=-5" for "-5.0" in a column "section_X".
    std::string_view sectionLabel(std::string_view field) {
        if (field == last_field_) return label_;
        last_field_ = field;
        const auto value = layout_.section_axis < 0 ? std::nullopt : parseNumber(field, layout_.decimal);
        label_ = value ? std::string(1, "XYZ"[layout_.section_axis]) + "=" + base::formatShortest(*value)
                       : std::string(field);
        return label_;
    }

    const TableLayout& layout_;
    PointCollector& out_;
    std::vector<std::string_view> fields_;
    std::string last_field_;
    std::string label_;
};

}  // namespace

void readTable(ByteSource& source, const PointReaderOptions& options, PointCollector& out) {
    out.format("table");
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    std::string_view mark;
    if (source.peek(3) == byte_order_mark && !source.take(3, mark)) return;
    const Head head = headOf(source);
    if (head.lines.empty()) return;
    const auto layout = findLayout(head.lines, head.numbers, options, out);
    if (!layout) return;
    if (layout->mm_per_unit) out.unit(*layout->mm_per_unit);
    RowReader rows(*layout, out);
    bool header_is_next = layout->has_header;
    for (std::string_view line; source.nextLine(line);) {
        if (trimmed(line).empty()) continue;
        if (isRemark(line)) {
            if (out.size() == 0) {
                takeRemark(line, out);
                takeRadius(line, out);
            }
            continue;
        }
        if (!header_is_next) rows.read(line, source.lineNumber());
        header_is_next = false;
    }
}

}  // namespace cusp::inspect
