// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// PCD 0.7 point clouds: ascii, binary and binary_compressed.
#include "points/binary_field.hpp"
#include "points/formats.hpp"
#include "points/lzf.hpp"
#include "points/point_text.hpp"

#include <cusp/base/number_text.hpp>

#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace cusp::inspect {
namespace {

constexpr std::uint64_t most_points = 1'000'000'000;

struct Field {
    NumberType type = NumberType::Float32;
    std::size_t count = 1;
    std::size_t offset = 0;  ///< in a record
    std::size_t first = 0;   ///< number of its first value in a record
};

struct Header {
    std::vector<std::string> names;
    std::vector<std::string> sizes;
    std::vector<std::string> types;
    std::vector<std::string> counts;
    std::optional<std::int64_t> points;
    std::string data;
    std::vector<Field> fields;
    PointFields roles;
    std::size_t record_bytes = 0;
    std::size_t record_values = 0;
};

std::optional<NumberType> typeOf(const std::string& type, const std::string& size) {
    static const std::vector<std::pair<std::string, NumberType>> table{
        {"I1", NumberType::Int8},    {"U1", NumberType::UInt8},  {"I2", NumberType::Int16}, {"U2", NumberType::UInt16},
        {"I4", NumberType::Int32},   {"U4", NumberType::UInt32}, {"I8", NumberType::Int64}, {"U8", NumberType::UInt64},
        {"F4", NumberType::Float32}, {"F8", NumberType::Float64}};
    for (const auto& [name, value] : table)
        if (name == type + size) return value;
    return std::nullopt;
}

std::vector<std::string> wordsBehind(std::string_view line) {
    std::vector<std::string_view> fields;
    splitFields(line, ' ', fields);
    return {fields.begin() + 1, fields.end()};
}

/// The fields from the four lines that describe them; false with an error when they disagree.
bool layOut(Header& header, PointCollector& out) {
    if (header.counts.empty()) header.counts.assign(header.names.size(), "1");
    if (header.names.empty() || header.sizes.size() != header.names.size() ||
        header.types.size() != header.names.size() || header.counts.size() != header.names.size()) {
        out.error("points.header", "FIELDS, SIZE, TYPE and COUNT of the PCD header do not go together");
        return false;
    }
    for (std::size_t i = 0; i < header.names.size(); ++i) {
        const auto type = typeOf(header.types[i], header.sizes[i]);
        const auto count = base::parseInteger(header.counts[i]);
        if (!type || !count || *count < 1 || *count > 100000) {
            out.error("points.header", fmt::format("field {} has a type, size or count that PCD does not know",
                                                   inQuotes(header.names[i])));
            return false;
        }
        header.roles.take(lowered(header.names[i]), static_cast<int>(i));
        header.fields.push_back({*type, static_cast<std::size_t>(*count), header.record_bytes, header.record_values});
        header.record_bytes += header.fields.back().count * sizeOf(*type);
        header.record_values += header.fields.back().count;
    }
    if (!header.roles.hasPosition()) out.error("points.header", "the cloud has no fields x, y and z");
    if (!header.points || *header.points < 0 || static_cast<std::uint64_t>(*header.points) > most_points)
        out.error("points.header", "POINTS is missing or no count");
    return !out.hasErrors();
}

std::optional<Header> readHeader(ByteSource& source, PointCollector& out) {
    Header header;
    for (std::string_view line; source.nextLine(line);) {
        line = trimmed(line);
        if (line.empty() || line.starts_with('#')) continue;
        const auto words = wordsBehind(line);
        if (startsWithWord(line, "FIELDS") || startsWithWord(line, "COLUMNS")) header.names = words;
        if (startsWithWord(line, "SIZE")) header.sizes = words;
        if (startsWithWord(line, "TYPE")) header.types = words;
        if (startsWithWord(line, "COUNT")) header.counts = words;
        if (startsWithWord(line, "POINTS") && !words.empty()) header.points = base::parseInteger(words[0]);
        if (startsWithWord(line, "DATA")) {
            header.data = words.empty() ? "" : lowered(words[0]);
            if (!layOut(header, out)) return std::nullopt;
            return header;
        }
    }
    out.error("points.truncated", "the PCD header has no DATA line", source.lineNumber());
    return std::nullopt;
}

/// A point from its six values; `line` is a line of the file or, of binary data, the number of the point.
void addPoint(const std::array<double, 6>& v, const PointFields& roles, std::uint64_t line, PointCollector& out) {
    const Vector3 position(v[0], v[1], v[2]);
    if (!position.allFinite()) return out.missing(line);
    out.add(line, position);
    if (roles.hasDirection()) out.direction({v[3], v[4], v[5]});
}

void readAscii(ByteSource& source, const Header& header, PointCollector& out) {
    std::vector<std::string_view> fields;
    std::int64_t points = 0;
    for (std::string_view line; points < *header.points && source.nextLine(line);) {
        splitFields(line, ' ', fields);
        if (fields.empty()) continue;
        ++points;
        if (fields.size() != header.record_values) {
            out.error("points.columns",
                      fmt::format("{} values where the header has {}", fields.size(), header.record_values),
                      source.lineNumber());
            continue;
        }
        std::array<double, 6> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (header.roles.index.at(i) < 0) continue;
            const std::string_view text =
                fields[header.fields[static_cast<std::size_t>(header.roles.index.at(i))].first];
            const auto value = base::parseDouble(text);
            if (!value && !isNotANumber(text))
                out.error("points.number", fmt::format("{} is no number", inQuotes(text)), source.lineNumber());
            values.at(i) = value.value_or(std::nan(""));
        }
        addPoint(values, header.roles, source.lineNumber(), out);
    }
    if (points < *header.points)
        out.error("points.truncated", fmt::format("the file ends after {} of {} points", points, *header.points),
                  source.lineNumber());
}

/// `stride(field)`: bytes from one point's value to the next one's; `begin(field)`: where the first lies.
template <class Begin, class Stride>
void readRecords(std::string_view data, const Header& header, std::size_t first_point, std::size_t points, Begin begin,
                 Stride stride, PointCollector& out) {
    for (std::size_t p = 0; p < points; ++p) {
        std::array<double, 6> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (header.roles.index.at(i) < 0) continue;
            const Field& field = header.fields[static_cast<std::size_t>(header.roles.index.at(i))];
            values.at(i) = loadNumber(data.data() + begin(field) + p * stride(field), field.type, false);
        }
        addPoint(values, header.roles, first_point + p + 1, out);
    }
}

void readBinary(ByteSource& source, const Header& header, PointCollector& out) {
    const auto points = static_cast<std::size_t>(*header.points);
    constexpr std::size_t block = 4096;
    for (std::size_t done = 0; done < points; done += block) {
        const std::size_t now = std::min(block, points - done);
        std::string_view data;
        if (!source.take(now * header.record_bytes, data))
            return out.error("points.truncated",
                             fmt::format("the file ends before the {} points its header promises", points));
        readRecords(
            data, header, done, now, [](const Field& f) { return f.offset; },
            [&header](const Field&) { return header.record_bytes; }, out);
    }
}

/// Two sizes, then the packed values, field by field.
void readCompressed(ByteSource& source, const Header& header, PointCollector& out) {
    std::string_view sizes;
    if (!source.take(8, sizes)) return out.error("points.truncated", "the file ends before its packed data");
    const auto packed_size = static_cast<std::size_t>(loadNumber(sizes.data(), NumberType::UInt32, false));
    const auto size = static_cast<std::size_t>(loadNumber(sizes.data() + 4, NumberType::UInt32, false));
    const auto points = static_cast<std::size_t>(*header.points);
    std::string_view packed;
    if (!source.take(packed_size, packed)) return out.error("points.truncated", "the file ends in its packed data");
    const auto data = size == points * header.record_bytes ? unpackLzf(packed, size) : std::nullopt;
    if (!data) return out.error("points.format", "the packed data of the cloud are damaged");
    readRecords(
        *data, header, 0, points, [points](const Field& f) { return f.offset * points; },
        [](const Field& f) { return f.count * sizeOf(f.type); }, out);
}

}  // namespace

void readPcd(ByteSource& source, PointCollector& out) {
    out.format("pcd");
    const auto header = readHeader(source, out);
    if (!header) return;
    if (header->data == "ascii") return readAscii(source, *header, out);
    if (header->data == "binary") return readBinary(source, *header, out);
    if (header->data == "binary_compressed") return readCompressed(source, *header, out);
    out.error("points.format",
              fmt::format("DATA {} is not known; ascii, binary and binary_compressed are", inQuotes(header->data)),
              source.lineNumber());
}

}  // namespace cusp::inspect
