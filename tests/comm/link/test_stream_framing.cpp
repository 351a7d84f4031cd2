// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Messages in streams: bytes written out by hand, any cut, noise between.
#include <cusp/base/random.hpp>
#include <cusp/comm/link/stream_framing.hpp>

#include <gtest/gtest.h>

namespace cusp::comm {
namespace {

std::vector<Bytes> messagesIn(ByteView stream, std::size_t piece, std::size_t most = 4096) {
    StreamDeframer deframer(most);
    std::vector<Bytes> out;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
        deframer.push(stream.subspan(at, std::min(piece, stream.size() - at)));
        while (auto message = deframer.next()) out.push_back(*std::move(message));
    }
    return out;
}

TEST(StreamFraming, EscapesTheFourBytesALineActsOn) {
    const Bytes message{'N', 0x7E, 0x7D, 0x11, 0x13, '1'};
    const Bytes framed{0x7E, 'N', 0x7D, 0x5E, 0x7D, 0x5D, 0x7D, 0x31, 0x7D, 0x33, '1', 0x7E};
    EXPECT_EQ(frameForStream(message), framed);
    EXPECT_EQ(messagesIn(framed, 1), std::vector<Bytes>{message});
}

TEST(StreamFraming, RandomMessagesComeBackHoweverTheyAreCut) {
    base::Random random(3);
    std::vector<Bytes> messages;
    Bytes stream;
    for (int i = 0; i < 200; ++i) {
        Bytes message(1 + random.below(300));
        for (auto& byte : message)
            byte = static_cast<std::uint8_t>(random.chance(0.3) ? 0x7D + random.below(2) : random.below(256));
        append(stream, frameForStream(message));
        messages.push_back(message);
    }
    for (const std::size_t piece : {1U, 2U, 7U, 100U, 100'000U}) EXPECT_EQ(messagesIn(stream, piece), messages);
}

TEST(StreamFraming, FlowControlBytesAmongAMessageAreTheLines) {
    const Bytes stream{0x7E, 'A', 0x13, 0x11, 'B', 0x7E};
    EXPECT_EQ(messagesIn(stream, 6), std::vector<Bytes>{bytesOf("AB")});
}

TEST(StreamFraming, NoiseCostsNoFollowingMessageAndNoMemory) {
    Bytes stream = bytesOf("noise \x7D");
    append(stream, frameForStream(bytesOf("good")));
    EXPECT_EQ(messagesIn(stream, 3).back(), bytesOf("good"));
    Bytes endless(100'000, 'X');
    append(endless, frameForStream(bytesOf("good")));
    EXPECT_EQ(messagesIn(endless, 1000, 64), std::vector<Bytes>{bytesOf("good")})
        << "what is too long is dropped whole";
}

}  // namespace
}  // namespace cusp::comm
