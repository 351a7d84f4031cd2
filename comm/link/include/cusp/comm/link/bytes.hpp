// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Bytes, and the big-endian numbers in them: one order for every link.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::comm {

using Bytes = std::vector<std::uint8_t>;
using ByteView = std::span<const std::uint8_t>;

inline void put16(Bytes& out, std::uint32_t value) {
    out.push_back(static_cast<std::uint8_t>(value >> 8U));
    out.push_back(static_cast<std::uint8_t>(value));
}

inline void put32(Bytes& out, std::uint32_t value) {
    put16(out, value >> 16U);
    put16(out, value & 0xFFFFU);
}

/// The number at `at`; the caller has checked that it lies inside.
[[nodiscard]] inline std::uint16_t get16(ByteView bytes, std::size_t at) {
    return static_cast<std::uint16_t>((bytes[at] << 8U) | bytes[at + 1]);
}

[[nodiscard]] inline std::uint32_t get32(ByteView bytes, std::size_t at) {
    return (std::uint32_t{get16(bytes, at)} << 16U) | get16(bytes, at + 2);
}

inline void append(Bytes& out, ByteView more) { out.insert(out.end(), more.begin(), more.end()); }

[[nodiscard]] inline Bytes bytesOf(std::string_view text) { return {text.begin(), text.end()}; }

[[nodiscard]] inline std::string textOf(ByteView bytes) { return {bytes.begin(), bytes.end()}; }

}  // namespace cusp::comm
