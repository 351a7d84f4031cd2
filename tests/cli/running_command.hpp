// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A cusp command that runs on while a test talks to it: lines in, lines out.
#pragma once

#include <chrono>
#include <csignal>
#include <gtest/gtest.h>
#include <poll.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace cusp::cli {

class RunningCommand {
public:
    explicit RunningCommand(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), CUSP_COMMAND);
        int in[2];
        int out[2];
        EXPECT_EQ(::pipe(in), 0);
        EXPECT_EQ(::pipe(out), 0);
        process_ = ::fork();
        if (process_ == 0) {
            ::dup2(in[0], STDIN_FILENO);
            ::dup2(out[1], STDOUT_FILENO);
            for (const int end : {in[0], in[1], out[0], out[1]}) ::close(end);
            std::vector<char*> words;
            words.reserve(arguments.size() + 1);
            for (std::string& word : arguments) words.push_back(word.data());
            words.push_back(nullptr);
            ::execv(words.front(), words.data());
            ::_exit(127);
        }
        ::close(in[0]);
        ::close(out[1]);
        to_ = in[1];
        from_ = out[0];
    }
    ~RunningCommand() {
        ::close(to_);
        if (process_ > 0 && ::waitpid(process_, nullptr, WNOHANG) == 0) {
            ::kill(process_, SIGTERM);
            ::waitpid(process_, nullptr, 0);
        }
        ::close(from_);
    }
    RunningCommand(const RunningCommand&) = delete;
    RunningCommand& operator=(const RunningCommand&) = delete;

    void type(const std::string& line) const {
        EXPECT_EQ(::write(to_, (line + "\n").data(), line.size() + 1), static_cast<ssize_t>(line.size() + 1));
    }
    /// What stands behind `words` in the first line that has them, as soon as it is said; at most a minute.
    std::string behind(const std::string& words) {
        const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (std::chrono::steady_clock::now() < until) {
            const std::size_t at = said_.find(words);
            const std::size_t end = at == std::string::npos ? at : said_.find('\n', at);
            if (end != std::string::npos) return said_.substr(at + words.size(), end - at - words.size());
            if (!listen()) break;
        }
        ADD_FAILURE() << "'" << words << "' was not said, but:\n" << said_;
        return {};
    }
    /// Its exit code.
    int end() {
        type("quit");
        return exitCode();
    }
    /// Of a command that ends by itself.
    int exitCode() {
        while (listen()) continue;
        int status = 0;
        EXPECT_EQ(::waitpid(process_, &status, 0), process_);
        process_ = -1;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    const std::string& said() const { return said_; }
    /// What has been said so far is no answer to what is typed next.
    void forget() { said_.clear(); }

private:
    /// False when it says nothing more.
    bool listen() {
        pollfd waiting{from_, POLLIN, 0};
        if (::poll(&waiting, 1, 1000) == 0) return true;
        char bytes[4096];
        const ssize_t count = ::read(from_, bytes, sizeof bytes);
        if (count <= 0) return false;
        said_.append(bytes, static_cast<std::size_t>(count));
        return true;
    }

    pid_t process_ = -1;
    int to_ = -1;
    int from_ = -1;
    std::string said_;
};

}  // namespace cusp::cli
