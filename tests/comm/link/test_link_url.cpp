// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// URLs: what is read out of them, and what is refused in which words.
#include <cusp/comm/link/link_url.hpp>

#include <gtest/gtest.h>

namespace cusp::comm {
namespace {

TEST(LinkUrl, IsTakenApart) {
    const auto tcp = parseLinkUrl("tcp://[::1]:5000");
    ASSERT_TRUE(tcp.has_value());
    EXPECT_EQ(tcp->host, "::1");
    EXPECT_EQ(tcp->port, 5000);
    const auto serial = parseLinkUrl("serial:///dev/ttyS0?baud=9600&flow=xonxoff");
    ASSERT_TRUE(serial.has_value());
    EXPECT_EQ(serial->path, "/dev/ttyS0");
    EXPECT_EQ(serial->number("baud", 115200), 9600);
    EXPECT_EQ(serial->parameter("flow", "none"), "xonxoff");
    EXPECT_EQ(serial->parameter("parity", "N"), "N");
    const auto can = parseLinkUrl("can://can0?send_id=0x7a0&fd=1");
    ASSERT_TRUE(can.has_value());
    EXPECT_EQ(can->host, "can0");
    EXPECT_EQ(can->number("send_id", 0), 0x7A0);
}

TEST(LinkUrl, RefusesWithWhatWouldBeRight) {
    const std::pair<const char*, const char*> wrong[] = {
        {"", "error: begins with none of tcp://, serial://, modbus-tcp://, modbus-rtu://, can://, file:// [link.url]"},
        {"tcp:/x:1",
         "error: tcp:/x:1: begins with none of tcp://, serial://, modbus-tcp://, modbus-rtu://, can://, file:// [link.url]"},
        {"tcp://host", "error: tcp://host: names no port: tcp://192.168.0.10:5000 [link.url]"},
        {"tcp://:5", "error: tcp://:5: names no host: tcp://192.168.0.10:5000 [link.url]"},
        {"tcp://h:70000", "error: tcp://h:70000: names no port: tcp://192.168.0.10:5000 [link.url]"},
        {"tcp://h:1?baud=9600", "error: tcp://h:1?baud=9600: tcp:// takes no parameters, and 'baud' is one [link.url]"},
        {"serial://dev/tty", "error: serial://dev/tty: names no path: serial:///absolute/path [link.url]"},
        {"serial:///d?baud=fast",
         "error: serial:///d?baud=fast: 'fast' is no baud: a number from 300 to 4000000 [link.url]"},
        {"serial:///d?flow=dtr", "error: serial:///d?flow=dtr: 'dtr' is no flow: none, xonxoff, rtscts [link.url]"},
        {"serial:///d?baud=9600&baud=9600", "error: serial:///d?baud=9600&baud=9600: 'baud' is given twice [link.url]"},
        {"modbus-tcp://h:502?unit", "error: modbus-tcp://h:502?unit: 'unit' is no parameter: key=value [link.url]"},
        {"modbus-rtu:///d?connections=2",
         "error: modbus-rtu:///d?connections=2: modbus-rtu:// has no parameter 'connections': it takes baud, parity, unit, timeout_ms [link.url]"},
        {"can://", "error: can://: names no CAN interface: can://can0 [link.url]"},
        {"can://c?send_id=0x800",
         "error: can://c?send_id=0x800: '0x800' is no send_id: a number from 0 to 2047 [link.url]"},
        {"file://x", "error: file://x: names no path: file:///absolute/path [link.url]"},
    };
    for (const auto& [url, message] : wrong) {
        const auto read = parseLinkUrl(url);
        ASSERT_FALSE(read.has_value()) << url;
        EXPECT_EQ(base::toText(read.error().front()), message);
    }
}

}  // namespace
}  // namespace cusp::comm
