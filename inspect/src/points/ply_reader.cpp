// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// PLY: the vertices of a cloud or mesh, ascii or binary of either byte order.
#include "points/binary_field.hpp"
#include "points/formats.hpp"
#include "points/point_text.hpp"

#include <cusp/base/number_text.hpp>

#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace cusp::inspect {
namespace {

struct Property {
    NumberType type = NumberType::Float32;
    std::size_t offset = 0;
};

struct Header {
    std::string encoding;
    std::size_t vertices = 0;
    bool has_vertices = false;
    std::vector<Property> properties;
    PointFields roles;
    std::size_t record_bytes = 0;
};

std::optional<NumberType> typeOf(std::string_view name) {
    static const std::vector<std::pair<std::string_view, NumberType>> table{
        {"char", NumberType::Int8},      {"int8", NumberType::Int8},       {"uchar", NumberType::UInt8},
        {"uint8", NumberType::UInt8},    {"short", NumberType::Int16},     {"int16", NumberType::Int16},
        {"ushort", NumberType::UInt16},  {"uint16", NumberType::UInt16},   {"int", NumberType::Int32},
        {"int32", NumberType::Int32},    {"uint", NumberType::UInt32},     {"uint32", NumberType::UInt32},
        {"float", NumberType::Float32},  {"float32", NumberType::Float32}, {"double", NumberType::Float64},
        {"float64", NumberType::Float64}};
    for (const auto& [word, type] : table)
        if (word == name) return type;
    return std::nullopt;
}

class HeaderReader {
public:
    HeaderReader(ByteSource& source, PointCollector& out) : source_(source), out_(out) {}

    std::optional<Header> read() {
        for (std::string_view line; source_.nextLine(line);) {
            splitFields(line, ' ', words_);
            if (words_.empty() || words_[0] == "ply" || words_[0] == "comment" || words_[0] == "obj_info") continue;
            if (words_[0] == "end_header") return checked();
            if (words_[0] == "format" && words_.size() > 1)
                header_.encoding = words_[1];
            else if (words_[0] == "element" && words_.size() > 2)
                element();
            else if (words_[0] == "property" && words_.size() > 2)
                property();
            else
                out_.error("points.header", fmt::format("{} is no line of a PLY header", inQuotes(line)),
                           source_.lineNumber());
            if (out_.hasErrors()) return std::nullopt;
        }
        out_.error("points.truncated", "the PLY header has no end_header", source_.lineNumber());
        return std::nullopt;
    }

private:
    void element() {
        const auto count = base::parseInteger(words_[2]);
        if (!count || *count < 0)
            return out_.error("points.header", fmt::format("{} is no count", inQuotes(words_[2])),
                              source_.lineNumber());
        in_vertices_ = words_[1] == "vertex";
        if (!in_vertices_ && !header_.has_vertices && *count > 0)
            return out_.error("points.format",
                              fmt::format("element {} stands before the vertices", inQuotes(words_[1])),
                              source_.lineNumber());
        if (!in_vertices_) return;
        header_.has_vertices = true;
        header_.vertices = static_cast<std::size_t>(*count);
    }

    void property() {
        if (!in_vertices_) return;
        const auto type = typeOf(words_[1]);
        if (!type)
            return out_.error("points.format",
                              fmt::format("a vertex property of type {} is not read", inQuotes(words_[1])),
                              source_.lineNumber());
        header_.roles.take(lowered(words_[2]), static_cast<int>(header_.properties.size()));
        header_.properties.push_back({*type, header_.record_bytes});
        header_.record_bytes += sizeOf(*type);
    }

    std::optional<Header> checked() {
        if (!header_.has_vertices || !header_.roles.hasPosition()) {
            out_.error("points.header", "the PLY file has no vertices with x, y and z", source_.lineNumber());
            return std::nullopt;
        }
        return header_;
    }

    ByteSource& source_;
    PointCollector& out_;
    std::vector<std::string_view> words_;
    Header header_;
    bool in_vertices_ = false;
};

void addPoint(const std::array<double, 6>& v, const PointFields& roles, std::uint64_t line, PointCollector& out) {
    const Vector3 position(v[0], v[1], v[2]);
    if (!position.allFinite()) return out.missing(line);
    out.add(line, position);
    if (roles.hasDirection()) out.direction({v[3], v[4], v[5]});
}

void readAscii(ByteSource& source, const Header& header, PointCollector& out) {
    std::vector<std::string_view> fields;
    for (std::size_t vertex = 0; vertex < header.vertices; ++vertex) {
        std::string_view line;
        if (!source.nextLine(line))
            return out.error("points.truncated",
                             fmt::format("the file ends after {} of {} vertices", vertex, header.vertices),
                             source.lineNumber());
        splitFields(line, ' ', fields);
        if (fields.size() < header.properties.size()) {
            out.error("points.columns",
                      fmt::format("{} values where the header has {}", fields.size(), header.properties.size()),
                      source.lineNumber());
            continue;
        }
        std::array<double, 6> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (header.roles.index.at(i) < 0) continue;
            const std::string_view text = fields[static_cast<std::size_t>(header.roles.index.at(i))];
            const auto value = base::parseDouble(text);
            if (!value && !isNotANumber(text))
                out.error("points.number", fmt::format("{} is no number", inQuotes(text)), source.lineNumber());
            values.at(i) = value.value_or(std::nan(""));
        }
        addPoint(values, header.roles, source.lineNumber(), out);
    }
}

void readBinary(ByteSource& source, const Header& header, bool big_endian, PointCollector& out) {
    for (std::size_t vertex = 0; vertex < header.vertices; ++vertex) {
        std::string_view record;
        if (!source.take(header.record_bytes, record))
            return out.error("points.truncated",
                             fmt::format("the file ends after {} of {} vertices", vertex, header.vertices));
        std::array<double, 6> values{};
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (header.roles.index.at(i) < 0) continue;
            const Property& property = header.properties[static_cast<std::size_t>(header.roles.index.at(i))];
            values.at(i) = loadNumber(record.data() + property.offset, property.type, big_endian);
        }
        addPoint(values, header.roles, vertex + 1, out);
    }
}

}  // namespace

void readPly(ByteSource& source, PointCollector& out) {
    out.format("ply");
    const auto header = HeaderReader(source, out).read();
    if (!header) return;
    if (header->encoding == "ascii") return readAscii(source, *header, out);
    if (header->encoding == "binary_little_endian") return readBinary(source, *header, false, out);
    if (header->encoding == "binary_big_endian") return readBinary(source, *header, true, out);
    out.error("points.header", fmt::format("the PLY encoding {} is not known", inQuotes(header->encoding)));
}

}  // namespace cusp::inspect
