// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Servers among ill-behaved clients: silent, slow, hostile, many; and who may listen and connect at all.
#include <cusp/comm/link/stream_framing.hpp>
#include <cusp/comm/link/transports.hpp>

#include <atomic>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace cusp::comm {
namespace {

/// Answers every message with itself.
class Echo : public RequestHandler {
public:
    Bytes handle(ByteView request) override {
        last = Bytes(request.begin(), request.end());
        return last;
    }
    Bytes area(ReplyArea) override { return last; }
    Bytes last;
};

class Served {
public:
    explicit Served(const std::string& url, ListenOptions options = {}) {
        server_ = openServer(parseLinkUrl(url).value(), echo_, options).value();
        name = server_->name();
        thread_ = std::thread([this] {
            while (!stop_ && server_->step(0.02).has_value()) clients = server_->clients();
        });
    }
    ~Served() {
        stop_ = true;
        thread_.join();
    }
    Served(const Served&) = delete;
    Served& operator=(const Served&) = delete;
    std::string name;
    std::atomic<std::size_t> clients{0};

private:
    Echo echo_;
    std::unique_ptr<LinkServer> server_;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

int connectRaw(const std::string& url) {
    const int descriptor = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(parseLinkUrl(url)->port);
    EXPECT_EQ(::connect(descriptor, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    return descriptor;
}

void expectAnswer(const std::string& url) {
    auto link = openLink(parseLinkUrl(url).value());
    ASSERT_TRUE(link.has_value()) << base::toText(link.error());
    Request request;
    request.bytes = bytesOf("are you there?");
    request.reply_bytes = request.bytes.size();
    // Connections that met a full house are made anew; what was asked on them is lost and asked again.
    for (int tries = 0; tries < 20; ++tries) {
        ASSERT_TRUE((*link)->send(request).has_value());
        const auto reply = (*link)->receive(2.0);
        ASSERT_TRUE(reply.has_value());
        if (!*reply) continue;
        EXPECT_EQ(textOf(**reply), "are you there?");
        return;
    }
    ADD_FAILURE() << "no answer";
}

class Servers : public ::testing::TestWithParam<const char*> {};

TEST_P(Servers, SilentAndHalfSaidClientsHoldNobodyUp) {
    Served served(std::string(GetParam()) + "://127.0.0.1:0");
    std::vector<int> others;
    for (int i = 0; i < 6; ++i) {
        others.push_back(connectRaw(served.name));
        const Bytes half = i % 2 == 0 ? Bytes{0, 1, 0, 0} : Bytes{0x7E, 'N'};
        EXPECT_GT(::send(others.back(), half.data(), half.size(), MSG_NOSIGNAL), 0);
    }
    expectAnswer(served.name);
    for (const int other : others) ::close(other);
}

TEST_P(Servers, AThousandConnectionsComeAndGo) {
    Served served(std::string(GetParam()) + "://127.0.0.1:0");
    for (int i = 0; i < 1000; ++i) {
        const int descriptor = connectRaw(served.name);
        const Bytes noise(static_cast<std::size_t>(i % 40), static_cast<std::uint8_t>(i));
        static_cast<void>(::send(descriptor, noise.data(), noise.size(), MSG_NOSIGNAL));
        ::close(descriptor);
    }
    expectAnswer(served.name);
}

TEST_P(Servers, MoreClientsThanAllowedAreTurnedAway) {
    ListenOptions options;
    options.max_clients = 2;
    Served served(std::string(GetParam()) + "://127.0.0.1:0", options);
    const int first = connectRaw(served.name);
    const int second = connectRaw(served.name);
    const int third = connectRaw(served.name);
    char byte = 0;
    EXPECT_EQ(::recv(third, &byte, 1, 0), 0) << "closed by the server";
    for (const int descriptor : {first, second, third}) ::close(descriptor);
}

TEST_P(Servers, AClientThatNeverReadsIsDropped) {
    Served served(std::string(GetParam()) + "://127.0.0.1:0");
    const int greedy = connectRaw(served.name);
    const bool modbus = served.name.starts_with("modbus");
    // Read 125 registers, again and again; or a long message to be echoed.
    const Bytes request = modbus ? Bytes{0, 1, 0, 0, 0, 6, 1, 3, 0, 0, 0, 125} : frameForStream(Bytes(4000, 'X'));
    bool dropped = false;
    timeval patience{2, 0};
    ::setsockopt(greedy, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    for (int i = 0; i < 2'000'000 && !dropped; ++i)
        dropped = ::send(greedy, request.data(), request.size(), MSG_NOSIGNAL) < 0 && errno != EAGAIN;
    EXPECT_TRUE(dropped);
    expectAnswer(served.name);
    ::close(greedy);
}

INSTANTIATE_TEST_SUITE_P(Links, Servers, ::testing::Values("tcp", "modbus-tcp"));

TEST(Listening, BeyondLoopbackOnlyWhenAskedFor) {
    Echo echo;
    const auto refused = openServer(parseLinkUrl("tcp://0.0.0.0:0").value(), echo);
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(
        base::toText(refused.error().front()),
        "tcp://0.0.0.0:0: error: is no loopback address; listening beyond this machine has to be asked for, with a "
        "list of who may connect [link.not-loopback]");
    ListenOptions options;
    options.beyond_loopback = true;
    options.allowed = {"192.168.0.0/33"};
    const auto wrong = openServer(parseLinkUrl("tcp://0.0.0.0:0").value(), echo, options);
    ASSERT_FALSE(wrong.has_value());
    EXPECT_EQ(base::toText(wrong.error().front()),
              "error: '192.168.0.0/33' is no address: 192.168.0.17 or 192.168.0.0/24 [link.allow]");
    options.allowed = {"192.168.0.0/24", "10.0.0.1", "fe80::/10"};
    EXPECT_TRUE(openServer(parseLinkUrl("tcp://0.0.0.0:0").value(), echo, options).has_value());
}

TEST(Listening, AFolderIsNoLink) {
    Echo echo;
    const auto url = parseLinkUrl("file:///tmp").value();
    EXPECT_EQ(base::toText(openLink(url).error().front()),
              "file:///tmp: error: is a folder to deliver to, no link [link.url]");
    EXPECT_FALSE(openServer(url, echo).has_value());
}

}  // namespace
}  // namespace cusp::comm
