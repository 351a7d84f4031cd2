// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// LZF: literal runs and back references, told apart by the control byte's upper three bits.
#include "points/lzf.hpp"

namespace cusp::inspect {

std::optional<std::string> unpackLzf(std::string_view packed, std::size_t size) {
    // No stream of n bytes unpacks to more than 264 bytes for every three of its own.
    if (size / 88 > packed.size() + 1) return std::nullopt;
    std::string out;
    out.reserve(size);
    const auto byte_at = [packed](std::size_t i) {
        return static_cast<std::size_t>(static_cast<unsigned char>(packed[i]));
    };
    for (std::size_t at = 0; at < packed.size();) {
        const std::size_t control = byte_at(at++);
        if (control < 32) {
            const std::size_t length = control + 1;
            if (at + length > packed.size() || out.size() + length > size) return std::nullopt;
            out += packed.substr(at, length);
            at += length;
            continue;
        }
        std::size_t length = control >> 5U;
        if (length == 7) {
            if (at >= packed.size()) return std::nullopt;
            length += byte_at(at++);
        }
        length += 2;
        if (at >= packed.size()) return std::nullopt;
        const std::size_t back = ((control & 31U) << 8U) + byte_at(at++) + 1;
        if (back > out.size() || out.size() + length > size) return std::nullopt;
        // The reference may reach into what it writes.
        for (std::size_t i = 0; i < length; ++i) out += out[out.size() - back];
    }
    if (out.size() != size) return std::nullopt;
    return out;
}

}  // namespace cusp::inspect
