// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// ISO-TP: frames as the standard prints them, every length there and back, and what a lost frame does.
#include <cusp/comm/link/iso_tp.hpp>

#include <gtest/gtest.h>

namespace cusp::comm {
namespace {

/// Moves frames between two ends until neither has one; `lose` is asked of each frame.
template <class Lose>
void exchange(IsoTpEndpoint& a, IsoTpEndpoint& b, double& now_s, const Lose& lose) {
    int number = 0;
    for (int idle = 0; idle < 3;) {
        idle = std::min(idle + 1, 3);
        for (auto [from, to] : {std::pair(&a, &b), std::pair(&b, &a)}) {
            while (const auto frame = from->poll(now_s)) {
                idle = 0;
                if (!lose(number++)) to->receive(*frame, now_s);
                now_s += 1e-4;
            }
        }
    }
}

Bytes counted(std::size_t size) {
    Bytes out(size);
    for (std::size_t i = 0; i < size; ++i) out[i] = static_cast<std::uint8_t>(i * 7);
    return out;
}

TEST(IsoTp, FramesAreThoseOfTheStandard) {
    IsoTpEndpoint end({});
    ASSERT_TRUE(end.send(bytesOf("hello")));
    EXPECT_EQ(end.poll(0.0), (CanPayload{0x05, 'h', 'e', 'l', 'l', 'o'}));
    ASSERT_TRUE(end.send(counted(20)));
    EXPECT_EQ(end.poll(0.0), (CanPayload{0x10, 20, 0, 7, 14, 21, 28, 35}));
    EXPECT_EQ(end.poll(0.0), std::nullopt) << "waits for flow control";
    end.receive(CanPayload{0x30, 0, 0}, 0.0);
    EXPECT_EQ(end.poll(0.0), (CanPayload{0x21, 42, 49, 56, 63, 70, 77, 84}));
    EXPECT_EQ(end.poll(0.0), (CanPayload{0x22, 91, 98, 105, 112, 119, 126, 133}));
    EXPECT_EQ(end.poll(0.0), std::nullopt);
    IsoTpEndpoint fd({.fd = true});
    ASSERT_TRUE(fd.send(counted(9)));
    EXPECT_EQ(fd.poll(0.0), (CanPayload{0x00, 9, 0, 7, 14, 21, 28, 35, 42, 49, 56, 0xCC}))
        << "padded to a length FD has";
}

TEST(IsoTp, EveryLengthComesBack) {
    for (const bool fd : {false, true}) {
        IsoTpEndpoint a({.fd = fd});
        IsoTpEndpoint b({.fd = fd});
        double now_s = 0.0;
        for (std::size_t size = 1; size <= IsoTpEndpoint::max_message_bytes; size += size < 150 ? 1 : 61) {
            ASSERT_TRUE(a.send(counted(size)));
            exchange(a, b, now_s, [](int) { return false; });
            ASSERT_EQ(b.next(), counted(size)) << size << " bytes, fd " << fd;
        }
        EXPECT_FALSE(a.send(Bytes(IsoTpEndpoint::max_message_bytes + 1)));
        EXPECT_FALSE(a.send({}));
    }
}

TEST(IsoTp, ALostFrameLosesItsMessageOnly) {
    for (int lost = 0; lost < 6; ++lost) {
        IsoTpEndpoint a({});
        IsoTpEndpoint b({});
        double now_s = 0.0;
        ASSERT_TRUE(a.send(counted(30)));
        exchange(a, b, now_s, [&](int number) { return number == lost; });
        EXPECT_EQ(b.next(), std::nullopt) << "frame " << lost;
        now_s += 1.0;
        exchange(a, b, now_s, [](int) { return false; });
        ASSERT_TRUE(a.send(counted(40)));
        exchange(a, b, now_s, [](int) { return false; });
        EXPECT_EQ(b.next(), counted(40)) << "after frame " << lost;
    }
}

TEST(IsoTp, HonoursBlockSizeAndSeparationOfOthers) {
    IsoTpEndpoint end({});
    ASSERT_TRUE(end.send(counted(40)));
    ASSERT_TRUE(end.poll(0.0).has_value());
    end.receive(CanPayload{0x31, 0, 0}, 0.1);
    EXPECT_EQ(end.poll(0.2), std::nullopt) << "wait";
    end.receive(CanPayload{0x30, 2, 10}, 0.3);
    EXPECT_TRUE(end.poll(0.3).has_value());
    EXPECT_EQ(end.poll(0.305), std::nullopt) << "10 ms apart";
    EXPECT_TRUE(end.poll(0.3101).has_value());
    EXPECT_EQ(end.poll(0.33), std::nullopt) << "two, then flow control again";
    end.receive(CanPayload{0x32, 0, 0}, 0.34);
    EXPECT_FALSE(end.sending()) << "overflow: given up";
}

}  // namespace
}  // namespace cusp::comm
