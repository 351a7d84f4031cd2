// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Modbus requests from bytes: the allowed ones, and the exception each other one earns.
#include <cusp/comm/link/modbus_query.hpp>

#include <gtest/gtest.h>

namespace cusp::comm {
namespace {

TEST(ModbusQuery, TheThreeFunctionsAreRead) {
    const auto read = parseModbusQuery(Bytes{0x03, 0x00, 0x00, 0x00, 0x12});
    EXPECT_EQ(read.fault, ModbusFault::None);
    EXPECT_EQ(read.query.read_count, 18);
    EXPECT_TRUE(read.query.written.empty());
    const auto write = parseModbusQuery(Bytes{0x10, 0x02, 0x00, 0x00, 0x02, 4, 1, 2, 3, 4});
    EXPECT_EQ(write.fault, ModbusFault::None);
    EXPECT_EQ(toBytes(write.query.written), (Bytes{1, 2, 3, 4}));
    const auto both = parseModbusQuery(Bytes{0x17, 0x03, 0x00, 0x00, 0x20, 0x02, 0x00, 0x00, 0x01, 2, 5, 6});
    EXPECT_EQ(both.fault, ModbusFault::None);
    EXPECT_EQ(both.query.read_address, upload_register);
    EXPECT_EQ(toBytes(both.query.written), (Bytes{5, 6}));
}

TEST(ModbusQuery, EverythingElseIsAnException) {
    const std::pair<Bytes, ModbusFault> wrong[] = {
        {{}, ModbusFault::IllegalFunction},
        {{0x06, 0x02, 0x00, 0, 1}, ModbusFault::IllegalFunction},
        {{0x03, 0x00, 0x00, 0x00}, ModbusFault::IllegalValue},
        {{0x03, 0x00, 0x00, 0x00, 0x00}, ModbusFault::IllegalValue},
        {{0x03, 0x00, 0x00, 0x00, 126}, ModbusFault::IllegalValue},
        {{0x03, 0x00, 0xF0, 0x00, 0x20}, ModbusFault::IllegalAddress},
        {{0x03, 0x02, 0x00, 0x00, 0x01}, ModbusFault::IllegalAddress},
        {{0x10, 0x00, 0x00, 0x00, 0x01, 2, 0, 0}, ModbusFault::IllegalAddress},
        {{0x10, 0x02, 0x00, 0x00, 0x02, 4, 1, 2, 3}, ModbusFault::IllegalValue},
        {{0x10, 0x02, 0x00, 0x00, 0x02, 2, 1, 2}, ModbusFault::IllegalValue},
        {{0x10, 0x02, 0x00, 0x00, 0x00, 0}, ModbusFault::IllegalValue},
        {{0x17, 0x03, 0x00, 0x00, 0x20, 0x02, 0x00, 0x00}, ModbusFault::IllegalValue},
    };
    for (const auto& [pdu, fault] : wrong)
        EXPECT_EQ(parseModbusQuery(pdu).fault, fault) << ::testing::PrintToString(pdu);
}

TEST(ModbusQuery, TcpFramesAreMeasuredBeforeTheyAreWhole) {
    const Bytes frame{0, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, 1};
    for (std::size_t size = 0; size < frame.size(); ++size) {
        const auto bytes = modbusTcpFrameBytes(ByteView(frame).first(size));
        EXPECT_FALSE(bytes.has_value()) << size;
    }
    EXPECT_EQ(modbusTcpFrameBytes(frame), frame.size());
    EXPECT_EQ(modbusTcpFrameBytes(Bytes{0, 1, 9, 9, 0, 6}), 0U) << "another protocol";
    EXPECT_EQ(modbusTcpFrameBytes(Bytes{0, 1, 0, 0, 1, 0}), 0U) << "longer than any";
    EXPECT_EQ(modbusTcpFrameBytes(Bytes{0, 1, 0, 0, 0, 1}), 0U) << "nothing in it";
}

}  // namespace
}  // namespace cusp::comm
