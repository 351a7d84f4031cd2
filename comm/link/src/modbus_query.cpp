// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Function codes 3, 16 and 23 of the Modbus application protocol V1.1b3, sections 6.3, 6.12 and 6.17.
#include <cusp/comm/link/modbus_query.hpp>

namespace cusp::comm {

namespace {

constexpr std::uint8_t read_holding = 0x03;
constexpr std::uint8_t write_multiple = 0x10;
constexpr std::uint8_t read_write_multiple = 0x17;
constexpr std::size_t area_registers = 0x0100;
constexpr std::size_t most_frame_bytes = 260;

bool inArea(std::uint16_t address, std::size_t count, std::uint16_t area) {
    return address >= area && address + count <= std::size_t{area} + area_registers;
}

bool readable(std::uint16_t address, std::uint16_t count) {
    return inArea(address, count, status_register) || inArea(address, count, upload_register);
}

/// Reads address, count, bytes and values at `at`, to the end of the PDU.
ModbusFault readWritten(ByteView pdu, std::size_t at, std::size_t most, ModbusQuery& query) {
    if (pdu.size() < at + 5) return ModbusFault::IllegalValue;
    query.write_address = get16(pdu, at);
    const std::size_t count = get16(pdu, at + 2);
    if (count == 0 || count > most || pdu[at + 4] != 2 * count || pdu.size() != at + 5 + (2 * count))
        return ModbusFault::IllegalValue;
    if (query.write_address != mailbox_register) return ModbusFault::IllegalAddress;
    query.written = toRegisters(pdu.subspan(at + 5));
    return ModbusFault::None;
}

ModbusFault readRange(ByteView pdu, ModbusQuery& query) {
    query.read_address = get16(pdu, 1);
    query.read_count = get16(pdu, 3);
    if (query.read_count == 0 || query.read_count > most_read_registers) return ModbusFault::IllegalValue;
    return readable(query.read_address, query.read_count) ? ModbusFault::None : ModbusFault::IllegalAddress;
}

}  // namespace

ModbusQueryResult parseModbusQuery(ByteView pdu) {
    ModbusQueryResult out;
    const std::uint8_t function = pdu.empty() ? std::uint8_t{0} : pdu[0];
    if (function == read_holding) {
        out.fault = pdu.size() == 5 ? readRange(pdu, out.query) : ModbusFault::IllegalValue;
    } else if (function == write_multiple) {
        out.fault = readWritten(pdu, 1, most_written_registers, out.query);
    } else if (function == read_write_multiple) {
        out.fault = pdu.size() > 9 ? readRange(pdu, out.query) : ModbusFault::IllegalValue;
        if (out.fault == ModbusFault::None) out.fault = readWritten(pdu, 5, most_exchanged_written, out.query);
    } else {
        out.fault = ModbusFault::IllegalFunction;
    }
    return out;
}

std::optional<std::size_t> modbusTcpFrameBytes(ByteView bytes) {
    if (bytes.size() < 6) return std::nullopt;
    const std::size_t size = 6 + std::size_t{get16(bytes, 4)};
    // Protocol identifier 0; at least unit and function, at most what the standard's 253 bytes of PDU make.
    if (get16(bytes, 2) != 0 || size < 8 || size > most_frame_bytes) return 0;
    return bytes.size() < size ? std::nullopt : std::optional(size);
}

}  // namespace cusp::comm
