// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// SHDR: the lines by their form, and the adapter as an agent sees it on a socket.
#include "control_bench.hpp"

#include <cusp/comm/controller/shdr_adapter.hpp>
#include <cusp/comm/dnc/run_transfer.hpp>
#include <cusp/comm/link/byte_stream.hpp>

#include <gtest/gtest.h>
#include <map>
#include <regex>
#include <sstream>

namespace cusp::comm::test {
namespace {

using Clock = ShdrLines::Clock;

Clock::time_point at(int ms) { return Clock::time_point(std::chrono::milliseconds(1'777'777'777'000LL + ms)); }

TEST(ShdrLines, FirstEverythingThenWhatChanges) {
    Bench bench("fooke-endura-ca");
    ShdrLines lines(bench.machine);
    ControlStatus status = bench.control.status();
    const std::string first = lines.changes(status, at(5));
    EXPECT_EQ(first.substr(0, 25), "2026-05-03T03:09:37.005Z|");
    EXPECT_NE(first.find("|avail|AVAILABLE|mode|AUTOMATIC|execution|READY|program|UNAVAILABLE|line|0|Xact|"),
              std::string::npos)
        << first;
    EXPECT_EQ(lines.changes(status, at(10)), "");
    status.executing_line = 17;
    status.axes[3] = 0.5;
    status.state = ChannelState::Active;
    EXPECT_EQ(lines.changes(status, at(1234)),
              "2026-05-03T03:09:38.234Z|execution|ACTIVE|line|17|" + bench.machine.rotaryNames()[0] + "act|28.6479\n");
    EXPECT_EQ(lines.changes(status, at(1300)), "");
}

TEST(ShdrLines, AlarmsAreConditionsOnLinesOfTheirOwn) {
    Bench bench("three-axis");
    ShdrLines lines(bench.machine);
    ControlStatus status = bench.control.status();
    EXPECT_NE(lines.all(status, at(0)).find("Z|channel|NORMAL||||\n"), std::string::npos);
    static_cast<void>(lines.changes(status, at(0)));
    status.alarms.push_back({10720, 2, "axis X | beyond\nits limit"});
    EXPECT_EQ(lines.changes(status, at(1)),
              "2026-05-03T03:09:37.001Z|channel|FAULT|10720|||line 2: axis X   beyond its limit\n");
    status.alarms.push_back({12080, 0, "other"});
    EXPECT_EQ(lines.changes(status, at(2)), "2026-05-03T03:09:37.002Z|channel|FAULT|12080|||other\n");
    status.alarms.erase(status.alarms.begin());
    EXPECT_EQ(lines.changes(status, at(3)), "2026-05-03T03:09:37.003Z|channel|NORMAL|10720|||\n");
    status.alarms.clear();
    EXPECT_EQ(lines.changes(status, at(4)), "2026-05-03T03:09:37.004Z|channel|NORMAL||||\n");
}

TEST(ShdrLines, ExecutionIsInTheWordsOfTheStandard) {
    Bench bench("three-axis");
    const auto executionOf = [&](ControlStatus status) {
        const std::string all = ShdrLines(bench.machine).all(status, at(0));
        std::smatch found;
        EXPECT_TRUE(std::regex_search(all, found, std::regex("execution\\|([A-Z_]+)")));
        return found[1].str();
    };
    ControlStatus status;
    EXPECT_EQ(executionOf(status), "READY");
    status.finished = true;
    EXPECT_EQ(executionOf(status), "PROGRAM_COMPLETED");
    status.state = ChannelState::Active;
    EXPECT_EQ(executionOf(status), "ACTIVE");
    status.override_share = 0.0;
    EXPECT_EQ(executionOf(status), "FEED_HOLD");
    status.state = ChannelState::Interrupted;
    EXPECT_EQ(executionOf(status), "INTERRUPTED");
    for (const auto& [why, word] : {std::pair{"M0", "PROGRAM_STOPPED"}, std::pair{"M1", "OPTIONAL_STOP"},
                                    std::pair{"NC stop", "FEED_HOLD"}, std::pair{"single block", "INTERRUPTED"}}) {
        status.waiting_for = why;
        EXPECT_EQ(executionOf(status), word);
    }
}

/// An agent: reads lines, keeps the last value of every data item.
class Agent {
public:
    explicit Agent(const std::string& place) : stream_(ByteStream::open(parseLinkUrl("tcp://" + place).value())) {
        EXPECT_TRUE(stream_.has_value());
    }
    void say(const std::string& text) {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());  // NOLINT: text as bytes
        static_cast<void>(stream_->write({bytes, text.size()}));
    }
    /// False when the adapter has closed.
    bool listen() {
        const auto bytes = stream_->read(0.001);
        if (!bytes) return false;
        text_.append(bytes->begin(), bytes->end());
        for (std::size_t end = text_.find('\n'); end != std::string::npos; end = text_.find('\n')) {
            take(text_.substr(0, end));
            text_.erase(0, end + 1);
        }
        return true;
    }

    std::map<std::string, std::string> values;
    std::vector<std::string> faults;
    std::vector<std::string> pongs;

private:
    void take(const std::string& line) {
        if (line.starts_with("* ")) return pongs.push_back(line);
        std::vector<std::string> fields;
        std::istringstream in(line);
        for (std::string field; std::getline(in, field, '|');) fields.push_back(field);
        ASSERT_TRUE(std::regex_match(fields.at(0), std::regex(R"(\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d\.\d{3}Z)"))) << line;
        if (fields.at(1) == "channel") {
            if (fields.at(2) == "FAULT") faults.push_back(fields.at(3));
            return;
        }
        for (std::size_t i = 1; i + 1 < fields.size(); i += 2) values[fields[i]] = fields[i + 1];
    }
    base::Result<ByteStream> stream_;
    std::string text_;
};

TEST(ShdrAdapter, AnAgentFollowsAProgramAndIsAnswered) {
    Bench bench("three-axis");
    auto adapter = ShdrAdapter::listen("127.0.0.1:0", bench.machine, {});
    ASSERT_TRUE(adapter.has_value());
    Agent agent(adapter->name());
    agent.say("* PING\r\n");
    ASSERT_TRUE(bench.control.select("P.MPF", "G54 G90\nSUPA G1 F6000 X50\nSUPA X99999\nM30\n"));
    ASSERT_TRUE(bench.control.start());
    const double until_s = transferClockSeconds() + 20.0;
    while (agent.faults.empty() && transferClockSeconds() < until_s) {
        bench.control.advance(0.002);
        adapter->step(bench.control.status());
        ASSERT_TRUE(agent.listen());
    }
    EXPECT_EQ(agent.pongs, std::vector<std::string>{"* PONG 10000"});
    EXPECT_EQ(agent.faults, std::vector<std::string>{"10720"});
    EXPECT_EQ(agent.values["Xact"], "50.0000");
    EXPECT_EQ(agent.values["execution"], "INTERRUPTED");
    EXPECT_EQ(agent.values["program"], "P.MPF");
    EXPECT_EQ(agent.values["path_position"].substr(0, 8), "-250.000") << "the bench's offset lies at X300";
}

TEST(ShdrAdapter, NobodyIsHeldUpBySlowOrChattyClients) {
    Bench bench("three-axis");
    auto adapter = ShdrAdapter::listen("127.0.0.1:0", bench.machine, {.max_clients = 3});
    ASSERT_TRUE(adapter.has_value());
    Agent chatty(adapter->name());
    chatty.say(std::string(1000, 'x'));  // no line end
    Agent silent(adapter->name());       // asks again and again and reads nothing
    Agent good(adapter->name());
    const double until_s = transferClockSeconds() + 20.0;
    while (good.values.empty() && transferClockSeconds() < until_s) {
        adapter->step(bench.control.status());
        ASSERT_TRUE(good.listen());
    }
    EXPECT_EQ(good.values["avail"], "AVAILABLE");
    EXPECT_EQ(adapter->clients(), 2u) << "who sends no line end is dropped";
    // A client that fetches nothing is dropped once what waits for it is too much.
    std::string pings;
    for (int i = 0; i < 2000; ++i) pings += "* PING\n";
    while (adapter->clients() > 1 && transferClockSeconds() < until_s) {
        silent.say(pings);
        adapter->step(bench.control.status());
        ASSERT_TRUE(good.listen());
    }
    EXPECT_EQ(adapter->clients(), 1u);
}

}  // namespace
}  // namespace cusp::comm::test
