// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Programs into the control through the receiver's host.
#include "control_bench.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/comm/controller/control_host.hpp>

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

namespace cusp::comm::test {
namespace {

ByteView view(const std::string& text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};  // NOLINT: text as bytes
}

ProgramHeader headerOf(const std::string& name, const std::string& text, TransferMode mode) {
    ProgramHeader header;
    header.client = 7;
    header.length = static_cast<std::uint32_t>(text.size());
    header.digest = sha256(view(text));
    header.mode = mode;
    header.name = name;
    return header;
}

/// A receiver in front of the control, spoken to in messages.
struct Panel {
    explicit Panel(Bench& test_bench, ControlHostOptions options = {})
        : bench(test_bench), host(bench.control, std::move(options)), receiver(ReceiverOptions{}, host, 99) {}

    Acknowledgement say(RequestType type, ByteView payload = {}, std::uint32_t argument = 0) {
        RequestMessage message;
        message.type = type;
        message.tag = ++tag;
        message.session = receiver.session();
        const bool command = type != RequestType::Chunk && type != RequestType::Status;
        message.argument = command ? ++nonce : argument;
        message.payload = payload;
        return *decodeAcknowledgement(receiver.handle(encode(message), now_s += 0.001));
    }
    Acknowledgement send(const std::string& name, const std::string& text, TransferMode mode = TransferMode::Store) {
        const Bytes header = encode(headerOf(name, text, mode));
        say(RequestType::Open, header);
        for (std::size_t at = 0; at < text.size(); at += 200)
            say(RequestType::Chunk, view(text).subspan(at, std::min<std::size_t>(200, text.size() - at)),
                static_cast<std::uint32_t>(at));
        return say(RequestType::Commit);
    }

    Bench& bench;
    ControlHost host;
    Receiver receiver;
    std::uint16_t tag = 0;
    std::uint32_t nonce = 0;
    double now_s = 1.0;
};

const std::string program = "G54 G90\nSUPA G1 F3000 X12.5\nM30\n";

TEST(ControlHost, StoresStartsAndFinishes) {
    const std::string folder = ::testing::TempDir() + "cusp_store_" + std::to_string(::getpid());
    std::filesystem::create_directories(folder);
    Bench bench("three-axis");
    Panel panel(bench, {.store_folder = folder});
    const std::string odd = "; \xC3\xA4\r\n" + program;
    EXPECT_EQ(panel.send("PART", odd).state, ReceiverState::Verified);
    EXPECT_EQ(base::readWholeFile(folder + "/PART.MPF", 1U << 20U).value_or(""), odd);
    EXPECT_EQ(panel.say(RequestType::Arm).state, ReceiverState::Armed);
    const Acknowledgement refused = panel.say(RequestType::Start);
    EXPECT_EQ(refused.command_result, Reason::NotEnabled);
    panel.bench.control.advance(1.0);
    EXPECT_EQ(bench.control.status().state, ChannelState::Reset) << "nobody at the control has enabled the start";
    panel.receiver.enableStart(panel.now_s, 10.0);
    panel.now_s += 20.0;
    EXPECT_EQ(panel.say(RequestType::Start).command_result, Reason::NotEnabled) << "it has run out";
    EXPECT_EQ(panel.receiver.startLocally(panel.now_s), Reason::None);
    bench.control.runToRest(60.0);
    panel.host.follow(panel.receiver);
    EXPECT_EQ(panel.receiver.state(), ReceiverState::Finished);
    EXPECT_EQ(panel.host.status().axes[0], 125000);
    std::filesystem::remove_all(folder);
}

TEST(ControlHost, AnAlarmInterruptsTheTransfersProgram) {
    Bench bench("three-axis");
    Panel panel(bench);
    panel.send("PART", "G54 G90\nSUPA G1 F3000 X99999\nM30\n");
    panel.say(RequestType::Arm);
    EXPECT_EQ(panel.receiver.startLocally(panel.now_s), Reason::None);
    bench.control.runToRest(60.0);
    panel.host.follow(panel.receiver);
    EXPECT_EQ(panel.receiver.state(), ReceiverState::Interrupted);
    EXPECT_EQ(panel.host.status().alarm, 10720u);
}

TEST(ControlHost, AFolderThatIsGoneFailsTheCommit) {
    Bench bench("three-axis");
    Panel panel(bench, {.store_folder = "/nowhere/at/all"});
    EXPECT_EQ(panel.send("PART", program).failure, Reason::Storage);
    EXPECT_FALSE(panel.host.storeProblem().empty());
}

TEST(ControlHost, NamesOfStoredPrograms) {
    EXPECT_EQ(storedName("P"), "P.MPF");
    EXPECT_EQ(storedName("P.MPF"), "P.MPF");
    EXPECT_EQ(storedName("p.mpf"), "p.MPF");
    EXPECT_EQ(storedName("P.TXT"), "P.TXT.MPF");
}

}  // namespace
}  // namespace cusp::comm::test
