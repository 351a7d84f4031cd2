// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The header of a PLY file: which elements follow, and how their values are written.
#pragma once

#include "mesh_words.hpp"

#include <cusp/base/result.hpp>
#include <cusp/geometry/frames.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::geometry::detail {

enum class PlyFormat : std::uint8_t { Text, LittleEndian, BigEndian };
enum class PlyType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float, Double };

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float;
    std::optional<PlyType> count_type;  ///< of a list

    [[nodiscard]] bool isCorners() const {
        return count_type.has_value() && (name == "vertex_indices" || name == "vertex_index");
    }
    void putCoordinate(double value, Vector3& point) const {
        if (name == "x") point.x() = value;
        if (name == "y") point.y() = value;
        if (name == "z") point.z() = value;
    }
};

struct PlyElement {
    std::string name;
    std::size_t count = 0;
    std::vector<PlyProperty> properties;
};

struct PlyHeader {
    PlyFormat format = PlyFormat::Text;
    std::vector<PlyElement> elements;
    std::size_t bytes = 0;
    std::size_t lines = 0;
};

/// Errors: `mesh.format` with the line. Elements without properties are refused, and counts that the bytes cannot hold.
[[nodiscard]] base::Result<PlyHeader> readPlyHeader(std::string_view bytes, const std::string& file_name);

[[nodiscard]] std::size_t sizeOf(PlyType type);
[[nodiscard]] double valueOf(const char* bytes, PlyType type, bool big_endian);

}  // namespace cusp::geometry::detail
