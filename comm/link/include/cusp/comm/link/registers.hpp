// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Messages in Modbus holding registers: where they lie, and how many fit into one transaction.
#pragma once

#include <cusp/comm/link/bytes.hpp>

#include <cstdint>
#include <vector>

namespace cusp::comm {

using Registers = std::vector<std::uint16_t>;

/// Zero-based addresses of holding registers (docs/dnc-protocol.md, "Register map").
inline constexpr std::uint16_t status_register = 0x0000;
inline constexpr std::uint16_t mailbox_register = 0x0200;
inline constexpr std::uint16_t upload_register = 0x0300;

/// Limits of the Modbus application protocol V1.1b3, sections 6.3, 6.12 and 6.17.
inline constexpr std::size_t most_written_registers = 123;  ///< function 16
inline constexpr std::size_t most_exchanged_written = 121;  ///< function 23
inline constexpr std::size_t most_read_registers = 125;     ///< functions 3 and 23

/// Two bytes a register, the first one in its high half; an odd last byte is followed by a zero.
[[nodiscard]] inline Registers toRegisters(ByteView bytes) {
    Registers out((bytes.size() + 1) / 2);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        out[i / 2] = static_cast<std::uint16_t>(out[i / 2] | (i % 2 == 0 ? bytes[i] << 8U : bytes[i]));
    return out;
}

[[nodiscard]] inline Bytes toBytes(const Registers& registers) {
    Bytes out;
    out.reserve(registers.size() * 2);
    for (const std::uint16_t value : registers) put16(out, value);
    return out;
}

}  // namespace cusp::comm
