// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Files appear whole or not at all, and every failure says the path and the reason and leaves nothing behind.
#include <cusp/base/atomic_file.hpp>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sstream>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace {

using namespace cusp::base;
namespace fs = std::filesystem;

class AtomicFileTest : public ::testing::Test {
protected:
    void SetUp() override {
        std::string pattern = (fs::temp_directory_path() / "cusp-test-XXXXXX").string();
        ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
        folder_ = pattern;
    }
    void TearDown() override {
        std::error_code ignored;
        fs::remove_all(folder_, ignored);
    }
    [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
    [[nodiscard]] std::ptrdiff_t fileCount() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }
    static void put(const std::string& path, const std::string& text) { std::ofstream(path) << text; }
    static std::string get(const std::string& path) {
        std::ostringstream out;
        out << std::ifstream(path).rdbuf();
        return out.str();
    }
    static mode_t modeOf(const std::string& path) {
        struct stat status{};
        return ::stat(path.c_str(), &status) == 0 ? status.st_mode & 07777U : 0;
    }

    fs::path folder_;
};

TEST_F(AtomicFileTest, AppearsOnlyOnCommit) {
    put(at("a"), "old");
    auto file = AtomicFile::create(at("a"));
    ASSERT_TRUE(file.has_value());
    ASSERT_TRUE(file->write("new ").has_value());
    ASSERT_TRUE(file->write(std::string(200000, 'x')).has_value());
    EXPECT_EQ(get(at("a")), "old");
    ASSERT_TRUE(file->commit().has_value());
    EXPECT_EQ(get(at("a")), "new " + std::string(200000, 'x'));
    EXPECT_EQ(fileCount(), 1);
    const auto again = file->commit();
    ASSERT_FALSE(again.has_value());
    EXPECT_EQ(toText(again.error()),
              at("a") + ": error: this file is already closed: Bad file descriptor [io.write]\n");
    EXPECT_EQ(get(at("a")).size(), 200004U);
}

TEST_F(AtomicFileTest, WithoutCommitNothingHappens) {
    put(at("a"), "old");
    {
        auto file = AtomicFile::create(at("a"));
        ASSERT_TRUE(file.has_value());
        ASSERT_TRUE(file->write("new").has_value());
        AtomicFile moved = std::move(*file);
        EXPECT_EQ(fileCount(), 2);
    }
    EXPECT_EQ(get(at("a")), "old");
    EXPECT_EQ(fileCount(), 1);
}

TEST_F(AtomicFileTest, KeepsTheModeOfTheTarget) {
    put(at("a"), "old");
    ASSERT_EQ(::chmod(at("a").c_str(), 0640), 0);
    ASSERT_TRUE(writeWholeFile(at("a"), "new").has_value());
    EXPECT_EQ(modeOf(at("a")), mode_t{0640});
    const mode_t before = ::umask(0027);
    ASSERT_TRUE(writeWholeFile(at("b"), "new").has_value());
    ::umask(before);
    EXPECT_EQ(modeOf(at("b")), mode_t{0640});
}

TEST_F(AtomicFileTest, FollowsLinks) {
    put(at("real"), "old");
    fs::create_symlink("real", at("link"));
    fs::create_symlink("link", at("link2"));
    ASSERT_TRUE(writeWholeFile(at("link2"), "new").has_value());
    EXPECT_TRUE(fs::is_symlink(at("link2")) && fs::is_symlink(at("link")));
    EXPECT_EQ(get(at("real")), "new");
    fs::create_symlink("later", at("dangling"));
    ASSERT_TRUE(writeWholeFile(at("dangling"), "fresh").has_value());
    EXPECT_TRUE(fs::is_symlink(at("dangling")));
    EXPECT_EQ(get(at("later")), "fresh");
}

TEST_F(AtomicFileTest, SaysWhyItCannotCreate) {
    const auto text = [](const std::string& path) {
        const auto file = AtomicFile::create(path);
        return file ? std::string("created") : toText(file.error());
    };
    EXPECT_EQ(text(at("")), folder_.string() + "/: error: cannot create this file: Is a directory [io.open]\n");
    EXPECT_EQ(text(at("missing/a")),
              at("missing/a") + ": error: cannot create this file: No such file or directory [io.open]\n");
    put(at("plain"), "");
    EXPECT_EQ(text(at("plain/a")), at("plain/a") + ": error: cannot create this file: Not a directory [io.open]\n");
    EXPECT_EQ(text(""), "error: cannot create this file: No such file or directory [io.open]\n");
    // Root may write anywhere on a disk, but nobody makes files in /proc.
    EXPECT_EQ(text("/proc/cusp-test"),
              "/proc/cusp-test: error: cannot create this file: No such file or directory [io.open]\n");
    EXPECT_EQ(fileCount(), 1);
}

TEST_F(AtomicFileTest, HonoursWriteProtection) {
    if (::geteuid() == 0) GTEST_SKIP() << "root is above permission bits";
    put(at("a"), "old");
    ASSERT_EQ(::chmod(at("a").c_str(), 0444), 0);
    const auto file = AtomicFile::create(at("a"));
    ASSERT_FALSE(file.has_value());
    EXPECT_EQ(toText(file.error()), at("a") + ": error: cannot create this file: Permission denied [io.open]\n");
    EXPECT_EQ(fileCount(), 1);
}

TEST_F(AtomicFileTest, FullDeviceIsAnError) {
    auto file = AtomicFile::create("/dev/full");
    ASSERT_TRUE(file.has_value());
    ASSERT_TRUE(file->write("small").has_value());  // still in the buffer
    const auto committed = file->commit();
    ASSERT_FALSE(committed.has_value());
    EXPECT_EQ(toText(committed.error()),
              "/dev/full: error: cannot write this file: No space left on device [io.write]\n");
    const auto after = file->write("more");
    ASSERT_FALSE(after.has_value());
    EXPECT_EQ(toText(after.error()), toText(committed.error()));
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

/// A disk that fills up half-way, by the limit on file sizes: the old content stays and the temporary goes.
TEST_F(AtomicFileTest, FailureHalfwayLeavesTheOldFile) {
    put(at("a"), "old");
    const auto write_to_full_disk = [this] {
        static_cast<void>(std::signal(SIGXFSZ, SIG_IGN));
        const rlimit limit{100000, 100000};
        if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) ::_exit(9);
        const auto written = writeWholeFile(at("a"), std::string(300000, 'x'));
        const std::string expected = at("a") + ": error: cannot write this file: File too large [io.write]\n";
        ::_exit(!written && toText(written.error()) == expected ? 0 : 1);
    };
    EXPECT_EXIT(write_to_full_disk(), ::testing::ExitedWithCode(0), "");
    EXPECT_EQ(get(at("a")), "old");
    EXPECT_EQ(fileCount(), 1);
}

TEST_F(AtomicFileTest, WritesPipesDirectly) {
    ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
    const int reader = ::open(at("pipe").c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    ASSERT_TRUE(writeWholeFile(at("pipe"), "through").has_value());
    std::array<char, 16> got{};
    EXPECT_EQ(::read(reader, got.data(), got.size()), 7);
    ::close(reader);
    EXPECT_TRUE(fs::is_fifo(at("pipe")));
}

TEST_F(AtomicFileTest, DashIsStandardOutput) {
    EXPECT_EXIT(
        {
            const int file = ::open(at("out").c_str(), O_WRONLY | O_CREAT, 0600);
            if (::dup2(file, STDOUT_FILENO) < 0) ::_exit(9);
            auto target = OutputTarget::open("-");
            const bool done = target && target->isStandardOutput() && target->write("to stdout") && target->commit();
            ::_exit(done ? 0 : 1);
        },
        ::testing::ExitedWithCode(0), "");
    EXPECT_EQ(get(at("out")), "to stdout");
    EXPECT_FALSE(OutputTarget::open(at("a"))->isStandardOutput());
}

TEST_F(AtomicFileTest, ReadsWholeFiles) {
    const std::string bytes = std::string(150000, 'z') + '\0' + "end";
    ASSERT_TRUE(writeWholeFile(at("a"), bytes).has_value());
    EXPECT_EQ(readWholeFile(at("a"), bytes.size()).value(), bytes);
    EXPECT_EQ(toText(readWholeFile(at("a"), bytes.size() - 1).error()),
              at("a") + ": error: this file is larger than 150003 bytes [io.too-large]\n");
    EXPECT_EQ(toText(readWholeFile("/dev/zero", 1000).error()),
              "/dev/zero: error: this file is larger than 1000 bytes [io.too-large]\n");
    EXPECT_EQ(toText(readWholeFile(at("no"), 10).error()),
              at("no") + ": error: cannot open this file: No such file or directory [io.open]\n");
    EXPECT_EQ(toText(readWholeFile(folder_.string(), 10).error()),
              folder_.string() + ": error: cannot read this file: Is a directory [io.read]\n");
    put(at("empty"), "");
    EXPECT_EQ(readWholeFile(at("empty"), 0).value(), "");
}

TEST_F(AtomicFileTest, DashIsStandardInput) {
    put(at("in"), "from stdin");
    EXPECT_EXIT(
        {
            const int file = ::open(at("in").c_str(), O_RDONLY);
            if (::dup2(file, STDIN_FILENO) < 0) ::_exit(9);
            const auto text = readWholeFile("-", 100);
            ::_exit(text && *text == "from stdin" ? 0 : 1);
        },
        ::testing::ExitedWithCode(0), "");
}

}  // namespace
