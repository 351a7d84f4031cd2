// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Numbers in binary records of PCD and PLY files.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace cusp::inspect {

enum class NumberType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Int64, UInt64, Float32, Float64 };

[[nodiscard]] constexpr std::size_t sizeOf(NumberType type) {
    constexpr std::array<std::size_t, 10> sizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
    return sizes.at(static_cast<std::size_t>(type));
}

template <class T>
[[nodiscard]] double loadAs(const char* bytes, bool swapped) {
    std::array<char, sizeof(T)> copy{};
    std::memcpy(copy.data(), bytes, sizeof(T));
    if (swapped) std::reverse(copy.begin(), copy.end());
    return static_cast<double>(std::bit_cast<T>(copy));
}

/// The number at `bytes`; `big_endian` is the order of the file.
[[nodiscard]] inline double loadNumber(const char* bytes, NumberType type, bool big_endian) {
    const bool swapped = big_endian != (std::endian::native == std::endian::big);
    switch (type) {
        case NumberType::Int8: return loadAs<std::int8_t>(bytes, swapped);
        case NumberType::UInt8: return loadAs<std::uint8_t>(bytes, swapped);
        case NumberType::Int16: return loadAs<std::int16_t>(bytes, swapped);
        case NumberType::UInt16: return loadAs<std::uint16_t>(bytes, swapped);
        case NumberType::Int32: return loadAs<std::int32_t>(bytes, swapped);
        case NumberType::UInt32: return loadAs<std::uint32_t>(bytes, swapped);
        case NumberType::Int64: return loadAs<std::int64_t>(bytes, swapped);
        case NumberType::UInt64: return loadAs<std::uint64_t>(bytes, swapped);
        case NumberType::Float32: return loadAs<float>(bytes, swapped);
        case NumberType::Float64: return loadAs<double>(bytes, swapped);
    }
    return 0.0;
}

/// Where x, y, z and, all or none, a normal lie in the fields of a record; −1 for absent.
struct PointFields {
    std::array<int, 6> index{-1, -1, -1, -1, -1, -1};

    [[nodiscard]] bool hasPosition() const { return index[0] >= 0 && index[1] >= 0 && index[2] >= 0; }
    [[nodiscard]] bool hasDirection() const { return index[3] >= 0 && index[4] >= 0 && index[5] >= 0; }
    /// `name` is the field's in lower case.
    void take(std::string_view name, int field) {
        constexpr std::array<std::array<std::string_view, 2>, 6> names{
            {{"x", "x"}, {"y", "y"}, {"z", "z"}, {"nx", "normal_x"}, {"ny", "normal_y"}, {"nz", "normal_z"}}};
        for (std::size_t i = 0; i < names.size(); ++i)
            if (name == names.at(i)[0] || name == names.at(i)[1]) index.at(i) = field;
    }
};

}  // namespace cusp::inspect
