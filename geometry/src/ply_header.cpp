// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The header's few statements, one a line.
#include "ply_header.hpp"

#include "mesh_finish.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cusp::geometry::detail {
namespace {

std::optional<PlyType> typeOf(std::string_view word) {
    static const std::pair<std::string_view, PlyType> names[] = {
        {"char", PlyType::Int8},     {"int8", PlyType::Int8},     {"uchar", PlyType::UInt8},
        {"uint8", PlyType::UInt8},   {"short", PlyType::Int16},   {"int16", PlyType::Int16},
        {"ushort", PlyType::UInt16}, {"uint16", PlyType::UInt16}, {"int", PlyType::Int32},
        {"int32", PlyType::Int32},   {"uint", PlyType::UInt32},   {"uint32", PlyType::UInt32},
        {"float", PlyType::Float},   {"float32", PlyType::Float}, {"double", PlyType::Double},
        {"float64", PlyType::Double}};
    const auto* const found =
        std::find_if(std::begin(names), std::end(names), [&](const auto& entry) { return entry.first == word; });
    return found == std::end(names) ? std::nullopt : std::optional(found->second);
}

/// Reads one statement into the header; false when it is not understood.
bool readStatement(std::string_view line, PlyHeader& header) {
    MeshWords words(line);
    const std::string_view keyword = words.next();
    if (keyword == "comment" || keyword == "obj_info") return true;
    if (keyword == "format") {
        const std::string_view format = words.next();
        if (format == "ascii")
            header.format = PlyFormat::Text;
        else if (format == "binary_little_endian")
            header.format = PlyFormat::LittleEndian;
        else if (format == "binary_big_endian")
            header.format = PlyFormat::BigEndian;
        else
            return false;
        return words.next() == "1.0" && words.next().empty();
    }
    if (keyword == "element") {
        PlyElement element;
        element.name = std::string(words.next());
        const auto count = base::parseInteger(words.next());
        if (element.name.empty() || !count || *count < 0) return false;
        element.count = static_cast<std::size_t>(*count);
        header.elements.push_back(std::move(element));
        return words.next().empty();
    }
    if (keyword != "property" || header.elements.empty()) return false;
    PlyProperty property;
    std::string_view type = words.next();
    if (type == "list") {
        property.count_type = typeOf(words.next());
        if (!property.count_type) return false;
        type = words.next();
    }
    const auto value_type = typeOf(type);
    property.name = std::string(words.next());
    if (!value_type || property.name.empty()) return false;
    property.type = *value_type;
    header.elements.back().properties.push_back(std::move(property));
    return words.next().empty();
}

base::Result<void> checkElements(const PlyHeader& header, std::size_t body_bytes, const std::string& file_name) {
    const auto has = [](const PlyElement& e, std::string_view name) {
        return std::any_of(e.properties.begin(), e.properties.end(),
                           [&](const PlyProperty& p) { return p.name == name && !p.count_type; });
    };
    bool vertices = false;
    bool faces = false;
    for (const PlyElement& e : header.elements) {
        // A value takes a byte at least, in text as in binary.
        if (e.properties.empty() || e.count > body_bytes) {
            return meshError(
                "mesh.truncated",
                fmt::format("element '{}' announces {} entries that the file cannot hold", e.name, e.count), file_name);
        }
        vertices = vertices || (e.name == "vertex" && has(e, "x") && has(e, "y") && has(e, "z"));
        faces = faces || (e.name == "face" && std::any_of(e.properties.begin(), e.properties.end(),
                                                          [](const PlyProperty& p) { return p.isCorners(); }));
    }
    if (!vertices) return meshError("mesh.format", "there is no element 'vertex' with x, y and z", file_name);
    if (!faces) {
        return meshError("mesh.format", "there is no element 'face' with a list vertex_indices: this is no mesh",
                         file_name);
    }
    return {};
}

}  // namespace

base::Result<PlyHeader> readPlyHeader(std::string_view bytes, const std::string& file_name) {
    MeshWords lines(bytes);
    if (lines.restOfLine() != "ply") return meshError("mesh.format", "a PLY file starts with 'ply'", file_name, 1);
    PlyHeader header;
    bool has_format = false;
    while (true) {
        const std::size_t number = lines.line();
        const std::size_t before = lines.position();
        const std::string_view line = lines.restOfLine();
        if (line == "end_header") break;
        if (line.empty() && lines.position() == before) {
            return meshError("mesh.truncated", "the header has no end_header", file_name, number);
        }
        if (line.empty()) continue;
        if (!readStatement(line, header)) {
            return meshError("mesh.format", fmt::format("'{}' is not understood", line.substr(0, 60)), file_name,
                             number);
        }
        has_format = has_format || line.starts_with("format");
    }
    if (!has_format) return meshError("mesh.format", "the header has no format", file_name);
    header.bytes = lines.position();
    header.lines = lines.line() - 1;
    if (auto ok = checkElements(header, bytes.size() - header.bytes, file_name); !ok) return base::fail(ok.error());
    return header;
}

std::size_t sizeOf(PlyType type) {
    switch (type) {
        case PlyType::Int8:
        case PlyType::UInt8: return 1;
        case PlyType::Int16:
        case PlyType::UInt16: return 2;
        case PlyType::Int32:
        case PlyType::UInt32:
        case PlyType::Float: return 4;
        case PlyType::Double: break;
    }
    return 8;
}

double valueOf(const char* bytes, PlyType type, bool big_endian) {
    switch (type) {
        case PlyType::Int8: return fromBytes<std::int8_t>(bytes, big_endian);
        case PlyType::UInt8: return fromBytes<std::uint8_t>(bytes, big_endian);
        case PlyType::Int16: return fromBytes<std::int16_t>(bytes, big_endian);
        case PlyType::UInt16: return fromBytes<std::uint16_t>(bytes, big_endian);
        case PlyType::Int32: return fromBytes<std::int32_t>(bytes, big_endian);
        case PlyType::UInt32: return fromBytes<std::uint32_t>(bytes, big_endian);
        case PlyType::Float: return static_cast<double>(fromBytes<float>(bytes, big_endian));
        case PlyType::Double: break;
    }
    return fromBytes<double>(bytes, big_endian);
}

}  // namespace cusp::geometry::detail
