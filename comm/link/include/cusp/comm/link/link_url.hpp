// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where a program goes, as the user writes it: tcp://host:port, serial:///dev/ttyS0?baud=115200, can://can0 …
#pragma once

#include <cusp/base/result.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace cusp::comm {

enum class LinkKind : std::uint8_t { Tcp, Serial, ModbusTcp, ModbusRtu, Can, File };

/// scheme://host:port/path?key=value&key=value, checked: the keys are those of the scheme, numbers are numbers.
struct LinkUrl {
    LinkKind kind = LinkKind::Tcp;
    std::string text;  ///< as given
    std::string host;  ///< tcp, modbus-tcp: name or address; can: the interface
    std::uint16_t port = 0;
    std::string path;  ///< serial, modbus-rtu: the device; file: the folder
    std::map<std::string, std::string> parameters;

    [[nodiscard]] std::string parameter(const std::string& key, const std::string& otherwise) const;
    /// Of a parameter the check has found to be a number.
    [[nodiscard]] std::int64_t number(const std::string& key, std::int64_t otherwise) const;
};

/// Keys: serial — baud, parity (N, E, O), flow (none, xonxoff, rtscts); modbus-tcp — unit, connections, timeout_ms;
/// modbus-rtu — baud, parity, unit, timeout_ms; can — send_id, receive_id, fd (0, 1), transport (auto, kernel, own).
/// Errors: `link.url`, with what is wrong and what would be right.
[[nodiscard]] base::Result<LinkUrl> parseLinkUrl(std::string_view text);

}  // namespace cusp::comm
