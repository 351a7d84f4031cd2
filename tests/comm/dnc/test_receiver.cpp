// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The receiver message by message: what it takes, what it refuses and with which reason, and what never happens twice.
#include "memory_host.hpp"

#include <gtest/gtest.h>

namespace cusp::comm {
namespace {

class ReceiverTest : public ::testing::Test {
protected:
    void make(ReceiverOptions options = {}) { receiver.emplace(std::move(options), host, 1); }

    Acknowledgement ask(RequestType type, std::uint32_t argument, ByteView payload = {},
                        std::optional<std::uint32_t> session = {}) {
        const Bytes reply = receiver->handle(
            encode({type, true, ++tag, session.value_or(receiver->session()), argument, payload}), now_s);
        const auto read = decodeAcknowledgement(reply);
        EXPECT_TRUE(read.has_value());
        EXPECT_EQ(read->tag, tag);
        return *read;
    }
    ProgramHeader header(TransferMode mode = TransferMode::Store) const {
        ProgramHeader out;
        out.client = 42;
        out.length = static_cast<std::uint32_t>(program.size());
        out.digest = sha256(bytesOf(program));
        out.mode = mode;
        out.name = "P.MPF";
        return out;
    }
    Acknowledgement open(const ProgramHeader& what) { return ask(RequestType::Open, ++nonce, encode(what)); }
    Acknowledgement chunk(std::size_t offset, std::size_t size) {
        return ask(RequestType::Chunk, static_cast<std::uint32_t>(offset), bytesOf(program.substr(offset, size)));
    }
    Acknowledgement command(RequestType type, ByteView payload = {}) { return ask(type, ++nonce, payload); }

    test::MemoryHost host;
    std::optional<Receiver> receiver;
    std::string program = "N10 G1 X1\nN20 X2\nN30 X3\nN40 M30\n";
    double now_s = 0.0;
    std::uint16_t tag = 0;
    std::uint32_t nonce = 100;
};

TEST_F(ReceiverTest, AProgramGoesThroughTheWholeGate) {
    make();
    EXPECT_EQ(open(header()).command_result, Reason::None);
    EXPECT_EQ(chunk(0, 20).expected, 20U);
    EXPECT_EQ(command(RequestType::Commit).command_result, Reason::Incomplete);
    EXPECT_EQ(command(RequestType::Arm).command_result, Reason::WrongState);
    EXPECT_EQ(chunk(20, 100).expected, program.size());
    EXPECT_EQ(command(RequestType::Commit).state, ReceiverState::Verified);
    EXPECT_EQ(host.programs["P.MPF"], program);
    EXPECT_EQ(receiver->startLocally(now_s), Reason::WrongState);
    EXPECT_EQ(command(RequestType::Arm).state, ReceiverState::Armed);
    EXPECT_EQ(command(RequestType::Start).command_result, Reason::NotEnabled);
    EXPECT_EQ(host.starts, 0);
    EXPECT_EQ(receiver->startLocally(now_s), Reason::None);
    EXPECT_EQ(receiver->state(), ReceiverState::Running);
    receiver->programFinished();
    EXPECT_EQ(receiver->state(), ReceiverState::Finished);
    EXPECT_EQ(host.starts, 1);
}

TEST_F(ReceiverTest, AcceptsEachByteOnceAndInOrder) {
    make();
    static_cast<void>(open(header()));
    EXPECT_EQ(chunk(10, 7).reason, Reason::Gap);
    EXPECT_EQ(chunk(0, 5).expected, 5U);
    EXPECT_EQ(chunk(0, 5).reason, Reason::AlreadyHad);
    // A chunk cut differently the second time: its new bytes count, and the held one follows.
    EXPECT_EQ(chunk(3, 7).expected, 17U);
    EXPECT_EQ(chunk(10, 7).reason, Reason::AlreadyHad);
    EXPECT_EQ(host.partial, program.substr(0, 17));
    EXPECT_EQ(chunk(17, 17).reason, Reason::None);
    EXPECT_EQ(host.partial, program);
    EXPECT_FALSE(host.overfilled);
}

TEST_F(ReceiverTest, WhatIsHeldIsBounded) {
    make({.reassembly_bytes = 8, .reassembly_chunks = 2});
    static_cast<void>(open(header()));
    EXPECT_EQ(chunk(30, 4).reason, Reason::Gap);
    EXPECT_EQ(chunk(20, 4).reason, Reason::Gap);
    EXPECT_EQ(chunk(10, 4).reason, Reason::Gap) << "not held: two are";
    EXPECT_EQ(chunk(0, 20).expected, 24U);
    EXPECT_EQ(chunk(24, 6).expected, program.size());
}

TEST_F(ReceiverTest, FullChangesNothing) {
    host.store_bytes = 12;
    make();
    static_cast<void>(open(header()));
    EXPECT_EQ(chunk(0, 10).free_bytes, 2U);
    const auto full = chunk(10, 5);
    EXPECT_EQ(full.reason, Reason::Full);
    EXPECT_EQ(full.expected, 10U);
    host.store_bytes = 100;
    EXPECT_EQ(chunk(10, 5).expected, 15U);
}

TEST_F(ReceiverTest, CommandsActOncePerNonce) {
    make();
    static_cast<void>(open(header()));
    static_cast<void>(chunk(0, program.size()));
    static_cast<void>(command(RequestType::Commit));
    EXPECT_EQ(ask(RequestType::Commit, nonce).command_result, Reason::None);
    EXPECT_EQ(host.commits, 1);
    static_cast<void>(command(RequestType::Arm));
    receiver->enableStart(now_s, 10.0);
    static_cast<void>(command(RequestType::Start));
    for (int again = 0; again < 3; ++again) EXPECT_EQ(ask(RequestType::Start, nonce).command_result, Reason::None);
    EXPECT_EQ(ask(RequestType::Arm, nonce - 1).reason, Reason::OldCommand);
    EXPECT_EQ(host.starts, 1);
}

TEST_F(ReceiverTest, TheSameOpenTwiceIsOne) {
    make();
    const std::uint32_t before = receiver->session();
    const auto first = open(header());
    static_cast<void>(chunk(0, 10));
    const auto again = ask(RequestType::Open, nonce, encode(header()), before);
    EXPECT_EQ(again.session, first.session);
    EXPECT_EQ(again.expected, 10U);
    EXPECT_EQ(host.opens, 1);
}

TEST_F(ReceiverTest, AResetEndsEverythingSentBefore) {
    make();
    static_cast<void>(open(header()));
    const std::uint32_t old_session = receiver->session();
    static_cast<void>(chunk(0, 20));
    receiver->reset(true);
    EXPECT_NE(receiver->session(), old_session);
    EXPECT_EQ(ask(RequestType::Chunk, 20, bytesOf("X"), old_session).reason, Reason::StaleSession);
    EXPECT_EQ(ask(RequestType::Open, ++nonce, encode(header()), old_session).reason, Reason::StaleSession);
    EXPECT_EQ(open(header()).expected, 20U) << "what was kept is resumed";
    static_cast<void>(chunk(20, 100));
    EXPECT_EQ(command(RequestType::Commit).state, ReceiverState::Verified);
    EXPECT_EQ(host.programs["P.MPF"], program);
}

TEST_F(ReceiverTest, AnotherProgramThanAnnouncedIsNeverStored) {
    make();
    ProgramHeader wrong = header();
    wrong.digest[0] ^= 1U;
    static_cast<void>(open(wrong));
    static_cast<void>(chunk(0, program.size()));
    const auto answer = command(RequestType::Commit);
    EXPECT_EQ(answer.command_result, Reason::DigestDiffers);
    EXPECT_EQ(answer.state, ReceiverState::Failed);
    EXPECT_EQ(answer.failure, Reason::DigestDiffers);
    EXPECT_TRUE(host.programs.empty());
    EXPECT_TRUE(host.partial.empty()) << "it is not offered for a resume";
}

TEST_F(ReceiverTest, OneWriterUntilItsLeaseRunsOut) {
    make({.lease_s = 30.0});
    static_cast<void>(open(header()));
    ProgramHeader other = header();
    other.client = 43;
    now_s = 29.0;
    EXPECT_EQ(open(other).command_result, Reason::Busy);
    EXPECT_EQ(ask(RequestType::Status, 42).reason, Reason::None) << "the holder lives";
    now_s = 58.0;
    EXPECT_EQ(open(other).command_result, Reason::Busy);
    now_s = 60.0;
    receiver->tick(now_s);
    EXPECT_EQ(open(other).reason, Reason::None);
    EXPECT_EQ(receiver->program().client, 43U);
}

TEST_F(ReceiverTest, AStartNeedsArmAndALocalEnableThatExpires) {
    make({.armed_s = 100.0, .max_enable_s = 60.0});
    receiver->enableStart(now_s, 1e9);
    EXPECT_EQ(command(RequestType::Start).command_result, Reason::WrongState);
    static_cast<void>(open(header()));
    static_cast<void>(chunk(0, program.size()));
    static_cast<void>(command(RequestType::Commit));
    static_cast<void>(command(RequestType::Arm));
    now_s = 61.0;
    EXPECT_EQ(command(RequestType::Start).command_result, Reason::NotEnabled) << "an enable is capped";
    now_s = 101.0;
    EXPECT_EQ(receiver->startLocally(now_s), Reason::WrongState) << "ARM has run out";
    EXPECT_EQ(receiver->state(), ReceiverState::Verified);
    EXPECT_EQ(host.starts, 0);
}

TEST_F(ReceiverTest, AKeyIsDemandedOfCommit) {
    make({.commit_key = "secret"});
    EXPECT_EQ(open(header(TransferMode::Drip)).command_result, Reason::NotAuthentic);
    EXPECT_TRUE(open(header()).key_demanded);
    static_cast<void>(chunk(0, program.size()));
    EXPECT_EQ(command(RequestType::Commit).command_result, Reason::NotAuthentic);
    EXPECT_EQ(command(RequestType::Commit, commitTag("guess", receiver->session(), header())).command_result,
              Reason::NotAuthentic);
    EXPECT_EQ(command(RequestType::Commit, commitTag("secret", receiver->session() + 1, header())).command_result,
              Reason::NotAuthentic)
        << "a tag of another session is a replay";
    EXPECT_EQ(command(RequestType::Commit, commitTag("secret", receiver->session(), header())).state,
              ReceiverState::Verified);
}

TEST_F(ReceiverTest, DripRunsWholeLinesAfterThePrefill) {
    make({.prefill_bytes = 15});
    ProgramHeader jumping = header(TransferMode::Drip);
    jumping.jumps_backward = true;
    EXPECT_EQ(open(jumping).command_result, Reason::JumpsBackward);
    static_cast<void>(open(header(TransferMode::Drip)));
    static_cast<void>(chunk(0, 12));
    EXPECT_EQ(host.fifo, "N10 G1 X1\n");
    EXPECT_EQ(command(RequestType::Arm).command_result, Reason::WrongState);
    EXPECT_TRUE(chunk(12, 6).prefilled);
    EXPECT_EQ(command(RequestType::Arm).state, ReceiverState::Armed);
    EXPECT_EQ(receiver->startLocally(now_s), Reason::None);
    while (host.runLine()) {
    }
    EXPECT_EQ(chunk(18, 100).state, ReceiverState::Running);
    EXPECT_TRUE(command(RequestType::Commit).committed);
    while (host.runLine()) {
    }
    EXPECT_EQ(host.executed, program);
    EXPECT_FALSE(host.broken_line);
}

TEST_F(ReceiverTest, ALineWithoutEndIsNoProgram) {
    program = std::string(100, 'X');
    make({.max_line_bytes = 50});
    static_cast<void>(open(header(TransferMode::Drip)));
    EXPECT_EQ(chunk(0, 50).reason, Reason::None);
    EXPECT_EQ(chunk(50, 10).failure, Reason::LineTooLong);
    EXPECT_EQ(receiver->state(), ReceiverState::Failed);
    EXPECT_TRUE(host.fifo.empty());
}

TEST_F(ReceiverTest, DamagedAndForeignMessagesDoNothing) {
    make();
    static_cast<void>(open(header()));
    Bytes broken = encode({RequestType::Chunk, false, 1, receiver->session(), 0, bytesOf("N10")});
    broken.back() ^= 1U;
    const auto answer = decodeAcknowledgement(receiver->handle(broken, now_s));
    ASSERT_TRUE(answer.has_value());
    EXPECT_EQ(answer->reason, Reason::BadChecksum);
    EXPECT_EQ(answer->expected, 0U);
    EXPECT_EQ(ask(RequestType::Chunk, 30, bytesOf(std::string(10, 'X'))).reason, Reason::Malformed) << "past the end";
    EXPECT_EQ(ask(RequestType::Chunk, 0).reason, Reason::Malformed) << "nothing in it";
}

TEST_F(ReceiverTest, WhatComesFasterThanTheCapHasNoEffect) {
    make({.max_bytes_per_s = 150.0});
    now_s = 1.0;
    static_cast<void>(open(header()));
    EXPECT_EQ(chunk(0, 20).reason, Reason::None);
    EXPECT_EQ(chunk(20, 14).reason, Reason::None);
    EXPECT_EQ(command(RequestType::Commit).reason, Reason::TooFast);
    now_s = 1.5;
    EXPECT_EQ(command(RequestType::Commit).state, ReceiverState::Verified);
}

TEST_F(ReceiverTest, ProgramsAreReadBack) {
    make();
    host.programs["OLD.SPF"] = "old text";
    EXPECT_EQ(ask(RequestType::Read, 0, bytesOf(std::string("\0\x05../x", 6))).reason, Reason::NotFound);
    EXPECT_EQ(ask(RequestType::Read, 0, bytesOf(std::string("\0\x05NONE", 6))).reason, Reason::NotFound);
    const Bytes wanted = bytesOf(std::string("\0\x05OLD.SPF", 9));
    const Bytes reply = receiver->handle(encode({RequestType::Read, true, 1, receiver->session(), 4, wanted}), now_s);
    const auto piece = decodeUploadPiece(reply);
    ASSERT_TRUE(piece.has_value());
    EXPECT_EQ(textOf(piece->bytes), "text");
    EXPECT_EQ(piece->offset, 4U);
    EXPECT_EQ(piece->total, 8U);
}

}  // namespace
}  // namespace cusp::comm
