// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The byte layouts of the protocol, against bytes written out by hand and digests from the standards.
#include <cusp/comm/dnc/message.hpp>

#include <cusp/base/hash.hpp>

#include <gtest/gtest.h>

namespace cusp::comm {
namespace {

Digest fromHex(std::string_view hex) {
    Digest out{};
    for (std::size_t i = 0; i < out.size(); ++i)
        out[i] = static_cast<std::uint8_t>(std::stoi(std::string(hex.substr(2 * i, 2)), nullptr, 16));
    return out;
}

TEST(Message, ARequestIsEighteenBytesAndItsPayload) {
    const Bytes payload = bytesOf("N10 G1 X1\n");
    const Bytes bytes = encode({RequestType::Chunk, true, 0x1234, 0xA1B2C3D4, 0x00010002, payload});
    ASSERT_EQ(bytes.size(), 18U + payload.size());
    const Bytes header{0x03, 0x01, 0x12, 0x34, 0xA1, 0xB2, 0xC3, 0xD4, 0x00, 0x01, 0x00, 0x02, 0x00, 0x0A};
    EXPECT_EQ(Bytes(bytes.begin(), bytes.begin() + 14), header);
    Bytes covered = header;
    append(covered, payload);
    EXPECT_EQ(get32(bytes, 14), base::crc32(ByteView(covered)));
    EXPECT_EQ(Bytes(bytes.begin() + 18, bytes.end()), payload);
}

TEST(Message, EverySingleBitErrorInARequestIsSeen) {
    const Bytes payload = bytesOf("X1 Y2\n");
    const Bytes whole = encode({RequestType::Chunk, true, 7, 9, 100, payload});
    for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
        Bytes broken = whole;
        broken[bit / 8] = static_cast<std::uint8_t>(broken[bit / 8] ^ (1U << (bit % 8)));
        EXPECT_NE(decodeRequest(broken).reason, Reason::None) << "bit " << bit;
    }
}

TEST(Message, PaddingBehindThePayloadIsIgnoredAndShortMessagesAreNot) {
    const Bytes payload = bytesOf("X1\n");
    Bytes bytes = encode({RequestType::Chunk, false, 7, 9, 100, payload});
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_EQ(decodeRequest(ByteView(bytes).first(size)).reason, Reason::Malformed);
    bytes.push_back(0);
    const DecodedRequest read = decodeRequest(bytes);
    EXPECT_EQ(read.reason, Reason::None);
    EXPECT_EQ(textOf(read.message.payload), "X1\n");
    EXPECT_FALSE(read.message.reply_wanted);
}

TEST(Message, RepliesComeBackAsTheyWere) {
    Acknowledgement sent;
    sent.state = ReceiverState::Failed;
    sent.reason = Reason::Gap;
    sent.session = 0xDEADBEEF;
    sent.expected = 1'000'000;
    sent.free_bytes = 30'000;
    sent.running_crc = 0x12345678;
    sent.tag = 65535;
    sent.prefilled = true;
    sent.committed = true;
    sent.nonce = 17;
    sent.command_result = Reason::Busy;
    sent.failure = Reason::DigestDiffers;
    Bytes reply = encode(sent);
    ASSERT_EQ(reply.size(), acknowledgement_bytes);
    MachineStatus machine;
    machine.alarm = 10910;
    machine.axes = {-1, 2, -3, 4, 2'000'000'000};
    machine.resume_block = 120;
    append(reply, encode(machine));
    ASSERT_EQ(reply.size(), status_bytes);
    const auto read = decodeAcknowledgement(reply);
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(encode(*read), encode(sent));
    const auto status = decodeMachineStatus(reply);
    ASSERT_TRUE(status.has_value());
    EXPECT_EQ(encode(*status), encode(machine));
    reply[40] ^= 1U;
    EXPECT_FALSE(decodeMachineStatus(reply).has_value());
    reply[5] ^= 1U;
    EXPECT_FALSE(decodeAcknowledgement(reply).has_value());
}

TEST(Message, ProgramNamesCannotLeaveTheirFolder) {
    for (const char* name : {"P.MPF", "part-7_B.SPF", "a"}) EXPECT_TRUE(isProgramName(name)) << name;
    for (const char* name :
         {"", ".", "..", ".MPF", "../P.MPF", "a/b", "a\\b", "P MPF", "P\n", "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAA"})
        EXPECT_FALSE(isProgramName(name)) << name;
}

TEST(Message, OpenComesBackAndEveryTruncationIsRefused) {
    ProgramHeader sent;
    sent.client = 5;
    sent.length = 123;
    sent.digest = sha256(bytesOf("x"));
    sent.blocks = 9;
    sent.start_block = 4;
    sent.mode = TransferMode::Drip;
    sent.jumps_backward = true;
    sent.name = "P.MPF";
    const Bytes bytes = encode(sent);
    const auto read = decodeProgramHeader(bytes);
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(encode(*read), bytes);
    for (std::size_t size = 0; size < bytes.size(); ++size)
        EXPECT_FALSE(decodeProgramHeader(ByteView(bytes).first(size)).has_value());
}

TEST(Message, DigestsAreThoseOfTheStandards) {
    // FIPS 180-4's example "abc".
    EXPECT_EQ(toHex(sha256(bytesOf("abc"))), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    // HMAC by its definition (RFC 2104), from SHA-256 alone.
    ProgramHeader header;
    header.length = 3;
    header.digest = fromHex("ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    header.name = "P.MPF";
    Bytes text = bytesOf("cusp-dnc commit");
    put32(text, 77);
    put32(text, 3);
    append(text, header.digest);
    append(text, bytesOf("P.MPF"));
    Bytes inner(64, 0x36);
    Bytes outer(64, 0x5C);
    const std::string key = "secret";
    for (std::size_t i = 0; i < key.size(); ++i) {
        inner[i] = static_cast<std::uint8_t>(inner[i] ^ key[i]);
        outer[i] = static_cast<std::uint8_t>(outer[i] ^ key[i]);
    }
    append(inner, text);
    append(outer, sha256(inner));
    EXPECT_EQ(commitTag(key, 77, header), sha256(outer));
}

}  // namespace
}  // namespace cusp::comm
