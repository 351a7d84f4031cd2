// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The monitor's server from the outside: what it answers, to whom, and that no viewer keeps out another.
#include "monitor_server.hpp"

#include <cusp/comm/dnc/run_transfer.hpp>
#include <cusp/comm/link/byte_stream.hpp>

#include <atomic>
#include <gtest/gtest.h>
#include <thread>

namespace cusp::cli {
namespace {

using Answer = std::pair<int, std::string>;  ///< status and body

comm::ByteStream dial(const MonitorServer& server) {
    const std::string url = server.url().substr(7);
    auto stream = comm::ByteStream::open(comm::parseLinkUrl("tcp://" + url.substr(0, url.find('/'))).value());
    EXPECT_TRUE(stream.has_value());
    return *std::move(stream);
}

void put(comm::ByteStream& stream, const std::string& text) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());  // NOLINT: text as bytes
    static_cast<void>(stream.write({bytes, text.size()}));
}

/// Everything until the server closes.
std::string rest(comm::ByteStream& stream, double most_s = 20.0) {
    std::string out;
    const double until_s = comm::transferClockSeconds() + most_s;
    while (comm::transferClockSeconds() < until_s) {
        const auto bytes = stream.read(0.1);
        if (!bytes) return out;
        out.append(bytes->begin(), bytes->end());
    }
    ADD_FAILURE() << "the connection was not closed";
    return out;
}

Answer askRaw(const MonitorServer& server, const std::string& request) {
    comm::ByteStream stream = dial(server);
    put(stream, request);
    const std::string answer = rest(stream);
    const std::size_t body = answer.find("\r\n\r\n");
    if (answer.size() < 12 || body == std::string::npos) return {0, answer};
    return {std::stoi(answer.substr(9, 3)), answer.substr(body + 4)};
}

Answer get(const MonitorServer& server, const std::string& path, const std::string& host = "127.0.0.1") {
    return askRaw(server, "GET " + path + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n");
}

Answer post(const MonitorServer& server, const std::string& body, const std::string& token) {
    return askRaw(server, "POST /command HTTP/1.1\r\nHost: 127.0.0.1\r\nX-Cusp-Token: " + token +
                              "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
}

std::unique_ptr<MonitorServer> serve(MonitorFeed& feed, MonitorOptions options = {}) {
    auto server = MonitorServer::open("127.0.0.1:0", "<html>page</html>", feed, std::move(options));
    EXPECT_TRUE(server.has_value());
    return *std::move(server);
}

TEST(MonitorFeed, ViewersGetWhatTheyLackAndNoMore) {
    MonitorFeed feed;
    feed.tell({{"line", 7}});
    for (int i = 0; i < 1000; ++i) feed.add({.time_s = 0.2 * i, .feed_mm_per_min = 100.0 + i});
    auto first = base::Json::parse(feed.state({}));
    EXPECT_EQ(first["now"]["line"], 7);
    EXPECT_EQ(first["curves"]["time_s"].size(), MonitorFeed::most_samples);
    EXPECT_EQ(first["curves"]["from"], 1000 - MonitorFeed::most_samples);
    EXPECT_TRUE(first["curves"]["fifo_percent"][0].is_null());
    feed.add({.time_s = 200.0});
    const auto next = base::Json::parse(feed.state({.sample = 1000}));
    EXPECT_EQ(next["curves"]["time_s"].size(), 1u);
    EXPECT_EQ(next["curves"]["from"], 1000);
    EXPECT_EQ(base::Json::parse(feed.state({.sample = 99999999}))["curves"]["time_s"].size(), 0u);
}

/// A viewer that follows piece by piece ends with every point, through thinning and a new run.
TEST(MonitorFeed, TheTrackComesInPiecesAndIsThinnedWhenItGrows) {
    MonitorFeed feed;
    MonitorCursor seen;
    std::vector<double> tips;
    const auto follow = [&] {
        while (true) {
            const auto track = base::Json::parse(feed.state(seen))["track"];
            if (track["run"] != seen.run) tips.clear();
            EXPECT_LE(track["cutting"].size(), MonitorFeed::points_at_once);
            for (const auto& value : track["tip_mm"]) tips.push_back(value);
            seen = {0, track["run"], tips.size() / 3};
            if (tips.size() / 3 == track["count"]) return;
        }
    };
    for (int i = 0; i < 3000; ++i) feed.track({0.06 * i, 0.0, 0.0}, true);
    feed.track({0.06 * 2999 + 0.01, 0.0, 0.0}, true);  // closer than the picture shows
    follow();
    EXPECT_EQ(tips.size(), 9000u);
    for (int i = 3000; i < 50000; ++i) feed.track({0.06 * i, 0.0, 0.0}, true);
    follow();
    EXPECT_LE(tips.size() / 3, MonitorFeed::most_points);
    EXPECT_GT(tips.size() / 3, MonitorFeed::most_points / 4);
    EXPECT_NEAR(tips[tips.size() - 3], 0.06 * 49999, 1.0);
    for (std::size_t i = 3; i < tips.size(); i += 3) ASSERT_GT(tips[i], tips[i - 3]);
    feed.beginTrack();
    follow();
    EXPECT_TRUE(tips.empty());
}

TEST(MonitorFeed, ThePathIsMadeOnceByWhoeverAsksFirst) {
    MonitorFeed feed;
    EXPECT_EQ(base::Json::parse(feed.path())["version"], 0);
    std::atomic<int> made{0};
    feed.offerPath([&] { return ++made, base::Json{{"points", 3}}; });
    std::vector<std::thread> viewers;
    for (int i = 0; i < 8; ++i) viewers.emplace_back([&] { EXPECT_EQ(base::Json::parse(feed.path())["points"], 3); });
    for (std::thread& viewer : viewers) viewer.join();
    EXPECT_EQ(made, 1);
    EXPECT_EQ(base::Json::parse(feed.state({}))["path"], 1);
}

TEST(MonitorServer, AnswersItsFourAddresses) {
    MonitorFeed feed;
    feed.tell({{"line", 3}});
    const auto server = serve(feed);
    EXPECT_EQ(get(*server, "/"), (Answer{200, "<html>page</html>"}));
    const auto [status, body] = get(*server, "/state?sample=0&run=nonsense&point=-4");
    EXPECT_EQ(status, 200);
    EXPECT_EQ(base::Json::parse(body)["now"]["line"], 3);
    EXPECT_EQ(get(*server, "/path").second, R"({"version":0})");
    EXPECT_EQ(get(*server, "/etc/passwd").first, 404);
    EXPECT_EQ(post(*server, R"({"do":"stop"})", "").first, 403) << "no commands unless enabled";
    EXPECT_FALSE(feed.takeCommand().has_value());
}

TEST(MonitorServer, CommandsNeedTheirTokenAndSense) {
    MonitorFeed feed;
    const auto server = serve(feed, {.token = "0123456789abcdef"});
    EXPECT_NE(server->url().find("/#0123456789abcdef"), std::string::npos);
    EXPECT_EQ(post(*server, R"({"do":"stop"})", "0123456789abcdee").first, 403);
    for (const char* nonsense :
         {"", "stop", "[]", R"({"do":1})", R"({"do":"start"})", R"({"do":"override","value":"x"})"})
        EXPECT_EQ(post(*server, nonsense, "0123456789abcdef").first, 400) << nonsense;
    EXPECT_EQ(post(*server, std::string(5000, ' '), "0123456789abcdef").first, 413);
    EXPECT_FALSE(feed.takeCommand().has_value());
    EXPECT_EQ(post(*server, R"({"do":"override","value":50})", "0123456789abcdef").first, 202);
    const auto command = feed.takeCommand();
    ASSERT_TRUE(command.has_value());
    EXPECT_EQ(command->name, "override");
    EXPECT_EQ(command->value, 50.0);
    for (int i = 0; i < 16; ++i) post(*server, R"({"do":"stop"})", "0123456789abcdef");
    EXPECT_EQ(post(*server, R"({"do":"stop"})", "0123456789abcdef").first, 503) << "too many wait";
}

TEST(MonitorServer, PagesOfOtherSitesGetNothing) {
    MonitorFeed feed;
    const auto server = serve(feed);
    EXPECT_EQ(get(*server, "/state", "evil.example:80").first, 403);
    EXPECT_EQ(get(*server, "/state", "localhost:1").first, 200);
    EXPECT_EQ(get(*server, "/state", "127.0.0.1:8080").first, 200);
    const auto outside = MonitorServer::open("0.0.0.0:0", "", feed, {});
    ASSERT_FALSE(outside.has_value());
    EXPECT_EQ(outside.error().front().code, "link.not-loopback");
    const std::string url = server->url().substr(7);
    const auto taken = MonitorServer::open(url.substr(0, url.find('/')), "", feed, {});
    ASSERT_FALSE(taken.has_value());
    EXPECT_EQ(taken.error().front().code, "io.link-open");
}

/// Half the connections are held by clients that say nothing, or a byte now and then; others are served all the same.
TEST(MonitorServer, SlowViewersKeepOutNobody) {
    MonitorFeed feed;
    const auto server = serve(feed, {.most_connections = 32, .connection_s = 0.5});
    std::vector<comm::ByteStream> silent;
    for (int i = 0; i < 16; ++i) silent.push_back(dial(*server));
    for (comm::ByteStream& stream : silent) put(stream, "GET /st");
    const double begin_s = comm::transferClockSeconds();
    for (int i = 0; i < 50; ++i) {
        EXPECT_EQ(get(*server, "/state").first, 200);
        put(silent[static_cast<std::size_t>(i) % silent.size()], "a");
    }
    std::printf("50 answers beside 16 silent clients: %.3f s\n", comm::transferClockSeconds() - begin_s);
    for (comm::ByteStream& stream : silent) EXPECT_EQ(rest(stream, 10.0), "") << "their time is over";
}

/// More than there is room for: those beyond are closed at once, and when the others are over there is room again.
TEST(MonitorServer, RoomIsCappedAndComesBack) {
    MonitorFeed feed;
    const auto server = serve(feed, {.most_connections = 4, .connection_s = 0.5});
    std::vector<comm::ByteStream> held;
    for (int i = 0; i < 12; ++i) held.push_back(dial(*server));
    const double until_s = comm::transferClockSeconds() + 20.0;
    int status = 0;
    while (status != 200 && comm::transferClockSeconds() < until_s) status = get(*server, "/").first;
    EXPECT_EQ(status, 200);
}

TEST(MonitorServer, AThousandConnectionsOpenedAndDroppedLeaveItWell) {
    MonitorFeed feed;
    const auto server = serve(feed);
    for (int i = 0; i < 1000; ++i) {
        comm::ByteStream stream = dial(*server);
        if (i % 3 == 0) put(stream, "GET / HTTP/1.1\r\nHost: 127");
        if (i % 3 == 1) put(stream, "GET / HTTP/1.1\r\nHost: 127.0.0.1\r\n\r\n");
    }
    const double until_s = comm::transferClockSeconds() + 20.0;
    int status = 0;
    while (status != 200 && comm::transferClockSeconds() < until_s) status = get(*server, "/").first;
    EXPECT_EQ(status, 200);
}

/// The writer and eight viewers at once: every answer is whole JSON. Under the thread sanitizer this is the point.
TEST(MonitorServer, ViewersAndTheControlRunBesideEachOther) {
    MonitorFeed feed;
    const auto server = serve(feed, {.token = "t"});
    std::atomic<bool> over{false};
    std::thread control([&] {
        for (int i = 0; !over; ++i) {
            feed.tell({{"line", i}});
            feed.add({.time_s = 0.1 * i});
            feed.track({0.1 * i, 0.0, 0.0}, i % 2 == 0);
            if (i % 100 == 0) feed.beginTrack();
            if (i % 50 == 0) feed.offerPath([i] { return base::Json{{"points", i}}; });
            static_cast<void>(feed.takeCommand());
        }
    });
    std::vector<std::thread> viewers;
    std::atomic<int> answers{0};
    for (int viewer = 0; viewer < 8; ++viewer)
        viewers.emplace_back([&] {
            for (int i = 0; i < 20; ++i) {
                const Answer answer = i % 5 == 4 ? get(*server, "/path") : get(*server, "/state");
                EXPECT_EQ(answer.first, 200);
                EXPECT_FALSE(base::Json::parse(answer.second, nullptr, false).is_discarded());
                post(*server, R"({"do":"stop"})", "t");
                ++answers;
            }
        });
    for (std::thread& viewer : viewers) viewer.join();
    over = true;
    control.join();
    EXPECT_EQ(answers, 160);
}

}  // namespace
}  // namespace cusp::cli
