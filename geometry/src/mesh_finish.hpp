// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the readers of meshes share: limits, errors with their place, the last checks.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/triangle_mesh.hpp>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace cusp::geometry::detail {

/// Squares and areas of what is larger would leave the range of a double, and no part is.
inline constexpr double largest_coordinate_mm = 1e9;

/// Welds, judges the edges, refuses what is empty or not finite.
[[nodiscard]] base::Result<TriangleMesh> finishMesh(const TriangleMesh& mesh, const std::string& file_name,
                                                    base::Diagnostics& report);

[[nodiscard]] inline tl::unexpected<base::Diagnostics> meshError(std::string_view code, std::string message,
                                                                 const std::string& file_name, std::size_t line = 0) {
    base::Location where;
    where.file = file_name;
    where.line = line;
    return base::fail(code, std::move(message), std::move(where));
}

/// A number of a binary file, at `bytes`, which must hold enough of them.
template <class T>
[[nodiscard]] T fromBytes(const char* bytes, bool big_endian = false) {
    char copy[sizeof(T)];
    for (std::size_t i = 0; i < sizeof(T); ++i) {
        const bool swap = big_endian == (std::endian::native == std::endian::little);
        copy[i] = bytes[swap ? sizeof(T) - 1 - i : i];
    }
    T value;
    std::memcpy(&value, copy, sizeof(T));
    return value;
}

}  // namespace cusp::geometry::detail
