// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Children that behave, that crash, that never end, that flood and that leave children of their own.
#include <cusp/base/child_process.hpp>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <gtest/gtest.h>
#include <poll.h>
#include <string>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

using namespace cusp::base;

Result<ProcessOutcome> shell(const std::string& script, const ProcessLimits& limits = {}, std::string_view input = {}) {
    return runProcess({"/bin/sh", "-c", script}, limits, input);
}

void expectNoChildren() {
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);
    EXPECT_EQ(errno, ECHILD);
}

TEST(ChildProcess, CollectsWhatItWritesAndHowItEnds) {
    const auto run = shell("echo out; echo err >&2; exit 3");
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->output, "out\n");
    EXPECT_EQ(run->errors, "err\n");
    EXPECT_EQ(run->exit_code, 3);
    EXPECT_EQ(run->signal, 0);
    EXPECT_EQ(run->limit, LimitHit::None);
    EXPECT_FALSE(run->succeeded());
    EXPECT_EQ(outcomeText(*run), "exit code 3");
    EXPECT_GT(run->peak_memory_bytes, 0U);
    expectNoChildren();
}

TEST(ChildProcess, SearchesThePathAndPassesArgumentsUntouched) {
    const auto run = runProcess({"printf", "%s|", "a b", "$HOME", "*", "", "\"'"});
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->output, "a b|$HOME|*||\"'|");
    EXPECT_TRUE(run->succeeded());
}

TEST(ChildProcess, FeedsMoreThanAPipeHolds) {
    const std::string input(3000000, 'q');
    const auto run = runProcess({"cat"}, {}, input);
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->output, input);
    EXPECT_TRUE(run->succeeded());
}

TEST(ChildProcess, SurvivesAChildThatDoesNotListen) {
    const auto run = shell("exec 0<&-; echo deaf", {}, std::string(3000000, 'q'));
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->output, "deaf\n");
    EXPECT_EQ(run->exit_code, 0);
}

TEST(ChildProcess, TellsACrash) {
    const auto run = shell("kill -SEGV $$");
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->exit_code, -1);
    EXPECT_EQ(run->signal, SIGSEGV);
    EXPECT_EQ(outcomeText(*run), "killed by signal 11 (Segmentation fault)");
}

TEST(ChildProcess, SaysWhyItCannotRun) {
    const auto text = [](const std::vector<std::string>& argv) {
        const auto run = runProcess(argv);
        return run ? outcomeText(*run) : toText(run.error());
    };
    EXPECT_EQ(text({}), "error: no program is named [process.not-found]\n");
    EXPECT_EQ(text({"cusp-no-such-program"}),
              "error: cannot run `cusp-no-such-program`: there is no such program [process.not-found]\n");
    EXPECT_EQ(text({"/nowhere/at/all"}),
              "error: cannot run `/nowhere/at/all`: there is no such program [process.not-found]\n");
    EXPECT_EQ(text({"/etc/passwd"}),
              "error: cannot run `/etc/passwd`: it is no executable file [process.not-executable]\n");
    EXPECT_EQ(text({"/tmp"}), "error: cannot run `/tmp`: it is no executable file [process.not-executable]\n");
    std::string path = (std::filesystem::temp_directory_path() / "cusp-test-XXXXXX").string();
    const int file = ::mkstemp(path.data());
    ASSERT_GE(file, 0);
    ASSERT_EQ(::write(file, "\x01\x02\x03", 3), 3);
    ASSERT_EQ(::fchmod(file, 0755), 0);
    ::close(file);
    EXPECT_EQ(text({path}), "error: cannot run `" + path + "`: Exec format error [process.not-executable]\n");
    std::filesystem::remove(path);
    expectNoChildren();
}

TEST(ChildProcess, WallTimeEndsItWithItsChildren) {
    // The grandchild holds the pipe open; only the end of the whole group lets this finish at once.
    const auto run = shell("echo $$; sh -c 'echo $$; while :; do read line </dev/zero; done' & wait", {.wall_s = 0.3});
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->limit, LimitHit::WallTime);
    EXPECT_EQ(run->signal, SIGKILL);
    EXPECT_GE(run->wall_s, 0.3);
    EXPECT_LT(run->wall_s, 30.0);
    EXPECT_EQ(outcomeText(*run).substr(0, 15), "stopped after 0");
    expectNoChildren();
    const std::size_t line = run->output.find('\n');
    ASSERT_NE(line, std::string::npos);
    const pid_t grandchild = std::atoi(run->output.c_str() + line);
    ASSERT_GT(grandchild, 1);
    // The signal is sent; dying may take the system a moment more.
    const int watch = static_cast<int>(::syscall(SYS_pidfd_open, grandchild, 0));
    if (watch >= 0) {
        pollfd ended{watch, POLLIN, 0};
        EXPECT_EQ(::poll(&ended, 1, 10000), 1);
        ::close(watch);
    }
}

TEST(ChildProcess, CpuTimeEndsIt) {
    const auto run = shell("while :; do :; done", {.wall_s = 60.0, .cpu_s = 1.0});
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->limit, LimitHit::CpuTime);
    EXPECT_EQ(run->signal, SIGXCPU);
    // The kernel counts the limit in clock ticks and reports the usage scaled: the two differ by some tenths.
    EXPECT_GT(run->cpu_s, 0.5);
    EXPECT_LT(run->cpu_s, 3.0);
}

TEST(ChildProcess, OutputLimitEndsItAndKeepsTheBeginning) {
    const auto run = shell("yes", {.wall_s = 60.0, .output_bytes = 100001});
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->limit, LimitHit::Output);
    EXPECT_EQ(run->output.size() + run->errors.size(), 100001U);
    EXPECT_EQ(run->output.substr(0, 4), "y\ny\n");
    EXPECT_EQ(outcomeText(*run), "stopped for writing too much");
}

TEST(ChildProcess, AddressSpaceIsLimited) {
    const std::string script = "ulimit -v";
    const auto run = shell(script, {.address_space_bytes = std::uint64_t{256} << 20U});
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->output, "262144\n");
    // 300 MB in one shell variable do not fit into 256 MiB.
    const auto greedy = shell("x=$(head -c 300000000 /dev/zero | tr '\\0' x); echo done",
                              {.wall_s = 60.0, .address_space_bytes = std::uint64_t{256} << 20U});
    ASSERT_TRUE(greedy.has_value());
    EXPECT_FALSE(greedy->succeeded());
    EXPECT_EQ(greedy->limit, LimitHit::None);
}

TEST(ChildProcess, InheritsNoOpenFiles) {
    const int leak = ::open("/dev/null", O_RDONLY);  // without O_CLOEXEC, as careless libraries do
    ASSERT_GE(leak, 0);
    const auto run = shell("ls /proc/self/fd | grep -c '^[3-9]'");
    ::close(leak);
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->output, "1\n");  // ls itself holds the folder open as 3
}

TEST(ChildProcess, LeavesNoDescriptorsBehind) {
    const auto count = [] {
        const std::filesystem::directory_iterator begin("/proc/self/fd");
        return std::distance(begin, std::filesystem::directory_iterator());
    };
    const auto before = count();
    for (int i = 0; i < 20; ++i) ASSERT_TRUE(shell("exit 0", {}, "x").has_value());
    EXPECT_EQ(count(), before);
    expectNoChildren();
}

/// A child in a session of its own escapes the group, but must not keep us waiting for its end of the pipe.
TEST(ChildProcess, DoesNotWaitForDaemons) {
    std::string folder = (std::filesystem::temp_directory_path() / "cusp-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(folder.data()), nullptr);
    const std::string ready = folder + "/ready";
    const std::string go = folder + "/go";
    ASSERT_EQ(::mkfifo(ready.c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo(go.c_str(), 0600), 0);
    const int gate = ::open(go.c_str(), O_RDWR | O_CLOEXEC);  // the daemon lives until this closes
    ASSERT_GE(gate, 0);
    const auto run = shell("setsid sh -c 'exec 3<" + go + "; echo up >" + ready + "; read line <&3' & read line <" +
                               ready + "; echo gone",
                           {.wall_s = 60.0});
    ::close(gate);
    std::filesystem::remove_all(folder);
    ASSERT_TRUE(run.has_value());
    EXPECT_EQ(run->limit, LimitHit::None);
    EXPECT_EQ(run->output, "gone\n");
    EXPECT_EQ(run->exit_code, 0);
}

}  // namespace
