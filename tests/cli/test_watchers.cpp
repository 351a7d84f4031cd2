// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Who watches a program on its way and on the control: browsers (`--monitor`) and MTConnect agents (`--shdr`).
#include "command_line.hpp"
#include "running_command.hpp"
#include "winding_program.hpp"

#include <cusp/comm/dnc/run_transfer.hpp>
#include <cusp/comm/link/byte_stream.hpp>

namespace cusp::cli {
namespace {

using nlohmann::json;

constexpr double most_s = 30.0;

comm::ByteStream dial(const std::string& place) {
    auto stream = comm::ByteStream::open(comm::parseLinkUrl("tcp://" + place).value());
    if (!stream) throw std::runtime_error(base::toText(stream.error()));
    return *std::move(stream);
}

void put(comm::ByteStream& stream, const std::string& text) {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text.data());  // NOLINT: text as bytes
    EXPECT_TRUE(stream.write({bytes, text.size()}).has_value());
}

/// The page "http://HOST:PORT/#TOKEN" that a command has said.
class Browser {
public:
    explicit Browser(const std::string& url) {
        EXPECT_EQ(url.substr(0, 7), "http://");
        const std::size_t slash = url.find('/', 7);
        place_ = url.substr(7, slash - 7);
        const std::size_t hash = url.find('#');
        token_ = hash == std::string::npos ? "" : url.substr(hash + 1);
    }
    std::string get(const std::string& path) const {
        return ask("GET " + path + " HTTP/1.1\r\nHost: " + place_ + "\r\n\r\n").second;
    }
    json state() const { return json::parse(get("/state")); }
    /// The status of the answer.
    int command(const std::string& body) const {
        return ask("POST /command HTTP/1.1\r\nHost: " + place_ + "\r\nX-Cusp-Token: " + token_ +
                   "\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body)
            .first;
    }
    /// Asks for the state until `done` of it; what it was then.
    template <class Done>
    json until(const Done& done) const {
        const double until_s = comm::transferClockSeconds() + most_s;
        json now;
        while (comm::transferClockSeconds() < until_s) {
            now = state()["now"];
            if (done(now)) return now;
        }
        ADD_FAILURE() << "last seen: " << now.dump();
        return now;
    }

private:
    std::pair<int, std::string> ask(const std::string& request) const {
        comm::ByteStream stream = dial(place_);
        put(stream, request);
        std::string answer;
        const double until_s = comm::transferClockSeconds() + most_s;
        while (comm::transferClockSeconds() < until_s) {
            const auto bytes = stream.read(0.1);
            if (!bytes) break;
            answer.append(bytes->begin(), bytes->end());
        }
        const std::size_t body = answer.find("\r\n\r\n");
        if (answer.size() < 12 || body == std::string::npos) return {0, answer};
        return {std::stoi(answer.substr(9, 3)), answer.substr(body + 4)};
    }
    std::string place_;
    std::string token_;
};

/// What an agent hears until `words` are among it.
std::string hear(comm::ByteStream& agent, const std::string& words) {
    std::string heard;
    const double until_s = comm::transferClockSeconds() + most_s;
    while (comm::transferClockSeconds() < until_s && heard.find(words) == std::string::npos) {
        const auto bytes = agent.read(0.1);
        if (!bytes) break;
        heard.append(bytes->begin(), bytes->end());
    }
    EXPECT_NE(heard.find(words), std::string::npos) << heard;
    return heard;
}

class Watchers : public CommandLine {};

TEST_F(Watchers, SeeAProgramComeAndRun) {
    RunningCommand control(controller({"--listen", "tcp://127.0.0.1:0", "--shdr", "127.0.0.1:0", "--monitor",
                                       "127.0.0.1:0", "--ledger", path("ledger.sqlite")}));
    const std::string url = control.behind("listening on ");
    comm::ByteStream agent = dial(control.behind("MTConnect adapter on "));
    const std::string greeting = hear(agent, "|execution|READY");
    EXPECT_NE(greeting.find("|avail|AVAILABLE"), std::string::npos) << greeting;
    put(agent, "* PING\n");
    hear(agent, "* PONG 10000");
    const Browser browser(control.behind("monitor page at "));
    EXPECT_NE(browser.get("/").find("<html"), std::string::npos);
    EXPECT_EQ(browser.state()["now"]["state"], "reset");
    EXPECT_EQ(browser.command(R"({"do":"stop"})"), 403) << "read-only unless enabled";

    const std::string program = write("P.MPF", windingProgram(60));
    ASSERT_EQ(run({"send", program, "--to", url, "--arm", "--no-ledger"}).exit_code, 0);
    browser.until([](const json& now) { return now["transfer"]["state"] == "armed"; });
    control.type("start");
    control.behind("program finished");
    const json now = browser.until([](const json& seen) { return seen["finished"] == true; });
    EXPECT_EQ(now["program"], "P.MPF");
    EXPECT_EQ(now["completed_line"], 16 + 60 + 4);
    std::vector<std::string> events;  // newest first
    for (const json& entry : now["ledger"]) events.push_back(entry["event"]);
    EXPECT_EQ(events, (std::vector<std::string>{"finished", "running", "armed", "verified", "begun"}));
    EXPECT_EQ(json::parse(browser.get("/path"))["version"], 1);
    const std::string heard = hear(agent, "|execution|PROGRAM_COMPLETED");
    EXPECT_NE(heard.find("|program|P.MPF"), std::string::npos) << heard;
    EXPECT_NE(heard.find("|Xact|"), std::string::npos) << heard;
    EXPECT_EQ(control.end(), 0);
}

TEST_F(Watchers, MayCommandOnlyWhereEnabledAndNeverStart) {
    RunningCommand control(
        controller({"--listen", "tcp://127.0.0.1:0", "--monitor", "127.0.0.1:0", "--monitor-commands"}));
    const Browser browser(control.behind("monitor page at "));
    EXPECT_EQ(browser.command(R"({"do":"override","value":50})"), 202);
    browser.until([](const json& now) { return now["override_percent"] == 50.0; });
    control.type("status");
    control.behind("override 50 %");
    EXPECT_EQ(browser.command(R"({"do":"start"})"), 400);
    EXPECT_EQ(control.end(), 0);
}

/// A drip feed larger than the FIFO cannot end before the start, so there is time to watch it.
TEST_F(Watchers, SeeATransferToItsEnd) {
    RunningCommand control(controller({"--listen", "tcp://127.0.0.1:0", "--fifo-kb", "16"}));
    const std::string program = write("P.MPF", windingProgram(700));
    RunningCommand sender({"send", program, "--to", control.behind("listening on "), "--drip", "--arm", "-m",
                           "fooke-endura-ca", "--allow-slow-link", "--monitor", "127.0.0.1:0", "--no-ledger"});
    const Browser browser(sender.behind("monitor page at "));
    EXPECT_NE(browser.get("/").find("<html"), std::string::npos);
    json now = browser.until([](const json& seen) { return seen["transfer"]["bytes"].get<std::size_t>() > 8'000; });
    EXPECT_EQ(now["over"], false);
    EXPECT_EQ(now["transfer"]["drip"], true);
    EXPECT_EQ(now["transfer"]["total_bytes"], windingProgram(700).size());
    control.behind("transfer armed");
    control.type("start");
    now = browser.until([](const json& seen) { return seen["over"] == true; });
    EXPECT_EQ(now["transfer"]["state"], "delivered");
    EXPECT_EQ(now["transfer"]["bytes"], windingProgram(700).size());
    EXPECT_EQ(sender.exitCode(), 0);
    control.behind("program finished");
    EXPECT_EQ(control.end(), 0);
}

TEST_F(Watchers, PlacesThatCannotBeServedAreErrors) {
    const std::vector<std::pair<std::string, std::string>> wrong{{"--monitor", "0.0.0.0:0"}, {"--shdr", "0.0.0.0:0"}};
    for (const auto& [flag, place] : wrong) {
        const auto outcome = run(controller({"--listen", "tcp://127.0.0.1:0", flag, place}), "quit\n");
        EXPECT_EQ(outcome.exit_code, 3) << flag;
        EXPECT_NE(outcome.errors.find("[link.not-loopback]"), std::string::npos) << outcome.errors;
    }
    for (const char* flag : {"--monitor", "--shdr"}) {
        const auto outcome = run(controller({"--listen", "tcp://127.0.0.1:0", flag, "nonsense"}), "quit\n");
        EXPECT_EQ(outcome.exit_code, 3) << flag;
        EXPECT_NE(outcome.errors.find("[link.url]"), std::string::npos) << outcome.errors;
    }
}

}  // namespace
}  // namespace cusp::cli
