// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a Modbus client asks for, read from untrusted bytes before anything acts on them.
#pragma once

#include <cusp/comm/link/registers.hpp>

#include <optional>

namespace cusp::comm {

/// A request for holding registers: functions 3, 16 and 23.
struct ModbusQuery {
    Registers written;  ///< empty: nothing is written
    std::uint16_t write_address = 0;
    std::uint16_t read_address = 0;
    std::uint16_t read_count = 0;  ///< 0: nothing is read
};

enum class ModbusFault : std::uint8_t {
    None = 0,
    IllegalFunction = 1,  ///< exception codes of the standard (V1.1b3, section 7)
    IllegalAddress = 2,
    IllegalValue = 3,
};

struct ModbusQueryResult {
    ModbusFault fault = ModbusFault::None;
    ModbusQuery query;
};

/// `pdu`: function code and data. Writes have to begin at the mailbox and fit into it; reads have to lie in the status or
/// the upload area.
[[nodiscard]] ModbusQueryResult parseModbusQuery(ByteView pdu);

/// Length of the first Modbus TCP frame in `bytes` (7 bytes of header, the unit among them, and the PDU).
/// Nothing: more is needed. 0: this is no Modbus.
[[nodiscard]] std::optional<std::size_t> modbusTcpFrameBytes(ByteView bytes);

}  // namespace cusp::comm
