// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The ledger that keeps what it was told, the plain drip feed, the resume, folders.
#include "../link/fault_bridge.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/comm/dnc/ledger.hpp>
#include <cusp/comm/dnc/plain_streamer.hpp>
#include <cusp/comm/dnc/resume.hpp>
#include <cusp/comm/link/file_delivery.hpp>

#include <filesystem>
#include <gtest/gtest.h>
#include <sqlite3.h>
#include <thread>
#include <unistd.h>

namespace cusp::comm {
namespace {

class InFolder : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        folder = std::filesystem::path(::testing::TempDir()) /
                 (std::string("cusp_") + info->name() + "_" + std::to_string(::getpid()));
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }
    std::string path(const std::string& name) const { return (folder / name).string(); }
    std::filesystem::path folder;
};

LedgerEntry entryOf(const std::string& event) {
    LedgerEntry out;
    out.time_utc = "2026-05-01T12:00:00Z";
    out.transfer = "t1";
    out.event = event;
    out.program = "P.MPF";
    out.bytes = 42;
    return out;
}

using LedgerTest = InFolder;

TEST_F(LedgerTest, KeepsEntriesInOrderAcrossOpenings) {
    {
        auto ledger = Ledger::open(path("l"));
        ASSERT_TRUE(ledger.has_value());
        EXPECT_EQ(ledger->append(entryOf("begun")).value(), 1);
        EXPECT_EQ(ledger->append(entryOf("delivered")).value(), 2);
    }
    auto ledger = Ledger::open(path("l"));
    EXPECT_EQ(ledger->append(entryOf("begun")).value(), 3);
    const auto entries = ledger->last(2).value();
    ASSERT_EQ(entries.size(), 2U);
    EXPECT_EQ(entries[0].event, "delivered");
    EXPECT_EQ(entries[1].number, 3);
    EXPECT_EQ(entries[1].bytes, 42U);
    EXPECT_EQ(ledger->firstBroken().value(), 0);
}

TEST_F(LedgerTest, RefusesChangesAndShowsThoseMadeBehindItsBack) {
    auto ledger = Ledger::open(path("l"));
    for (const char* event : {"begun", "aborted", "begun", "delivered"})
        ASSERT_TRUE(ledger->append(entryOf(event)).has_value());
    sqlite3* database = nullptr;
    ASSERT_EQ(::sqlite3_open(path("l").c_str(), &database), SQLITE_OK);
    const auto run = [&](const char* sql) { return ::sqlite3_exec(database, sql, nullptr, nullptr, nullptr); };
    EXPECT_NE(run("UPDATE audit SET event = 'delivered' WHERE number = 2"), SQLITE_OK);
    EXPECT_NE(run("DELETE FROM audit WHERE number = 2"), SQLITE_OK);
    EXPECT_EQ(ledger->firstBroken().value(), 0);
    EXPECT_EQ(run("DROP TRIGGER audit_keeps; UPDATE audit SET event = 'delivered' WHERE number = 2"), SQLITE_OK);
    EXPECT_EQ(ledger->firstBroken().value(), 2);
    EXPECT_EQ(run("UPDATE audit SET event = 'aborted' WHERE number = 2"), SQLITE_OK);
    EXPECT_EQ(ledger->firstBroken().value(), 0);
    EXPECT_EQ(run("DROP TRIGGER audit_stays; DELETE FROM audit WHERE number = 2"), SQLITE_OK);
    EXPECT_EQ(ledger->firstBroken().value(), 3);
    ::sqlite3_close(database);
}

TEST_F(LedgerTest, SeveralWritersKeepOneChain) {
    std::vector<std::thread> writers;
    for (int i = 0; i < 4; ++i) {
        writers.emplace_back([this] {
            auto ledger = Ledger::open(path("l"));
            for (int k = 0; k < 10; ++k) EXPECT_TRUE(ledger->append(entryOf("begun")).has_value());
        });
    }
    for (auto& writer : writers) writer.join();
    auto ledger = Ledger::open(path("l"));
    EXPECT_EQ(ledger->last(1000).value().size(), 40U);
    EXPECT_EQ(ledger->firstBroken().value(), 0);
}

TEST(Plain, XoffHoldsAndXonLetsGo) {
    PlainOptions options;
    options.line_end = LineEnd::CrLf;
    options.wait_for_xon = true;
    options.leader = "%\n";
    PlainStreamer streamer("N1 X1\r\nN2 X2\n", options);
    EXPECT_TRUE(streamer.next(100).empty()) << "not asked for yet";
    streamer.receive(Bytes{0x11});
    EXPECT_EQ(textOf(streamer.next(8)), "%\r\nN1 X1");
    streamer.sent(8);
    streamer.receive(Bytes{'?', 0x13});
    EXPECT_TRUE(streamer.next(8).empty());
    EXPECT_EQ(streamer.otherBytes(), 1U);
    streamer.receive(Bytes{0x11});
    EXPECT_EQ(textOf(streamer.next(100)), "\r\nN2 X2\r\n");
    streamer.sent(9);
    EXPECT_TRUE(streamer.allSent());
}

TEST(Plain, AControlThatHoldsTheLineLosesNothing) {
    // The control reads what comes, holds the line after every 200 bytes, and lets go when it has "worked" a while.
    test::PtyBridge bridge({}, 1);
    std::string program;
    for (int i = 0; i < 400; ++i) program += "N" + std::to_string(i) + " X" + std::to_string(i * 37 % 1000) + "\n";
    auto control = ByteStream::open(parseLinkUrl("serial://" + bridge.right()).value());
    auto line = ByteStream::open(parseLinkUrl("serial://" + bridge.left()).value());
    ASSERT_TRUE(control.has_value() && line.has_value());
    std::string received;
    std::thread worker([&] {
        std::size_t next_hold = 200;
        while (received.size() < program.size()) {
            const auto bytes = control->read(0.05);
            if (!bytes) return;
            received += textOf(*bytes);
            if (received.size() < next_hold) continue;
            next_hold = received.size() + 200;
            static_cast<void>(control->write(Bytes{0x13}));
            // What was on its way when the line was held arrives still; then nothing does.
            while (true) {
                const auto late = control->read(0.03);
                if (!late || late->empty()) break;
                received += textOf(*late);
            }
            static_cast<void>(control->write(Bytes{0x11}));
        }
    });
    PlainStreamer streamer(program, {});
    const auto ran = runPlain(streamer, *line, {}, base::noProgress());
    worker.join();
    EXPECT_TRUE(ran.has_value()) << base::toText(ran.error());
    EXPECT_TRUE(received == program);
}

TEST(Plain, AControlThatNeverLetsGoEndsInAnExplanation) {
    test::PtyBridge bridge({}, 1);
    auto line = ByteStream::open(parseLinkUrl("serial://" + bridge.left()).value());
    PlainOptions options;
    options.wait_for_xon = true;
    options.held_s = 0.2;
    PlainStreamer streamer("X1\n", options);
    const auto ran = runPlain(streamer, *line, options, base::noProgress());
    ASSERT_FALSE(ran.has_value());
    EXPECT_EQ(base::toText(ran.error().front()),
              "error: the control has held the line for 0 s after byte 0 of 3 [dnc.held]");
}

TEST(Resume, IsAProgramOfItsOwn) {
    const Program program{.name = "P.MPF", .text = "N10 X1\nN20 X2\nN30 X3\n", .blocks = 3};
    const auto resumed = resumedProgram(program, {"TRAORI\nG54\n", 14, 30});
    ASSERT_TRUE(resumed.has_value());
    EXPECT_EQ(resumed->text, "TRAORI\nG54\nN30 X3\n");
    EXPECT_EQ(resumed->blocks, 3U);
    EXPECT_EQ(resumed->start_block, 30U);
    const std::pair<ResumePreamble, const char*> wrong[] = {
        {{"", 14, 30}, "error: a program is not resumed without a preamble that rebuilds its modal state [dnc.resume]"},
        {{"G54", 14, 30}, "error: the preamble's last line has no end [dnc.resume]"},
        {{"G54\n", 15, 30}, "error: byte 15 of P.MPF is not the beginning of a line [dnc.resume]"},
        {{"G54\n", 21, 30}, "error: nothing is left of P.MPF after byte 21 [dnc.resume]"}};
    for (const auto& [preamble, message] : wrong) {
        const auto refused = resumedProgram(program, preamble);
        ASSERT_FALSE(refused.has_value());
        EXPECT_EQ(base::toText(refused.error().front()), message);
    }
}

using FolderTest = InFolder;

TEST_F(FolderTest, NamesCannotLeaveIt) {
    for (const char* name : {"", ".", "..", "../P.MPF", "a/b"}) {
        const auto refused = deliverFile(folder.string(), name, "x");
        ASSERT_FALSE(refused.has_value()) << name;
        EXPECT_EQ(refused.error().front().code, "file.name");
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

}  // namespace
}  // namespace cusp::comm
