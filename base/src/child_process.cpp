// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// fork, exec and a poll loop: no shell, no threads, no waiting by sleep.
#include <cusp/base/child_process.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <climits>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace cusp::base {
namespace {

using Clock = std::chrono::steady_clock;

/// A descriptor that closes itself.
class Descriptor {
public:
    Descriptor() = default;
    explicit Descriptor(int number) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() { reset(); }

    void reset() {
        if (number_ >= 0) static_cast<void>(::close(number_));
        number_ = -1;
    }
    [[nodiscard]] int get() const { return number_; }
    [[nodiscard]] bool isOpen() const { return number_ >= 0; }

private:
    int number_ = -1;
};

struct Pipe {
    Descriptor read_end;
    Descriptor write_end;

    [[nodiscard]] bool create() {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) return false;
        read_end = aboveStandard(Descriptor(ends[0]));
        write_end = aboveStandard(Descriptor(ends[1]));
        return read_end.isOpen() && write_end.isOpen();
    }

    /// In a process whose own standard input is closed a pipe may get number 0, and the child's wiring would cut it.
    [[nodiscard]] static Descriptor aboveStandard(Descriptor descriptor) {
        if (descriptor.get() > STDERR_FILENO) return descriptor;
        return Descriptor(::fcntl(descriptor.get(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
    }
};

struct Pipes {
    Pipe input;
    Pipe output;
    Pipe errors;
    Pipe start;  ///< carries errno when exec fails; closes by itself when it succeeds

    [[nodiscard]] bool create() { return input.create() && output.create() && errors.create() && start.create(); }
};

/// While it lives, writing to a pipe nobody reads is EPIPE for this thread, not the end of the process.
class NoSigpipe {
public:
    NoSigpipe() {
        sigset_t pending;
        sigemptyset(&pending);
        sigpending(&pending);
        was_pending_ = sigismember(&pending, SIGPIPE) == 1;
        sigemptyset(&sigpipe_);
        sigaddset(&sigpipe_, SIGPIPE);
        pthread_sigmask(SIG_BLOCK, &sigpipe_, &before_);
    }
    NoSigpipe(const NoSigpipe&) = delete;
    NoSigpipe& operator=(const NoSigpipe&) = delete;
    ~NoSigpipe() {
        const timespec at_once{};
        if (!was_pending_)
            while (sigtimedwait(&sigpipe_, nullptr, &at_once) < 0 && errno == EINTR) {
            }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
    }
    [[nodiscard]] const sigset_t& before() const { return before_; }

private:
    sigset_t sigpipe_{};
    sigset_t before_{};
    bool was_pending_ = false;
};

tl::unexpected<Diagnostics> processFailure(std::string_view code, const std::string& program, int error_number) {
    return fail(code, fmt::format("cannot run `{}`: {}", program, std::generic_category().message(error_number)));
}

bool isExecutableFile(const std::string& path) {
    struct stat status{};
    return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && ::access(path.c_str(), X_OK) == 0;
}

/// The path to execute: found before fork, because only system calls are safe after it.
Result<std::string> findProgram(const std::string& name) {
    if (name.empty()) return fail("process.not-found", "no program is named");
    std::vector<std::string> candidates;
    if (name.find('/') != std::string::npos) {
        candidates.push_back(name);
    } else {
        const char* const variable = std::getenv("PATH");  // NOLINT(concurrency-mt-unsafe): nobody here sets it
        std::string_view rest = variable == nullptr ? "/usr/bin:/bin" : variable;
        while (!rest.empty()) {
            const std::size_t colon = std::min(rest.find(':'), rest.size());
            const std::string folder(rest.substr(0, colon));
            candidates.push_back((folder.empty() ? "." : folder) + "/" + name);
            rest.remove_prefix(std::min(colon + 1, rest.size()));
        }
    }
    bool found = false;
    for (const std::string& candidate : candidates) {
        if (isExecutableFile(candidate)) return candidate;
        found = found || ::access(candidate.c_str(), F_OK) == 0;
    }
    if (found) return fail("process.not-executable", fmt::format("cannot run `{}`: it is no executable file", name));
    return fail("process.not-found", fmt::format("cannot run `{}`: there is no such program", name));
}

void setLimit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
    rlimit wanted{};
    if (::getrlimit(resource, &wanted) != 0) return;
    wanted.rlim_max = std::min(wanted.rlim_max, hard);
    wanted.rlim_cur = std::min(wanted.rlim_max, soft);
    static_cast<void>(::setrlimit(resource, &wanted));
}

rlim_t wholeSeconds(double seconds) { return static_cast<rlim_t>(std::clamp(std::ceil(seconds), 1.0, 1e9)); }

/// Runs between fork and exec: system calls only, no memory, no locks.
[[noreturn]] void becomeProgram(const char* path, char* const* argv, const Pipes& pipes, const ProcessLimits& limits,
                                const sigset_t& signal_mask, pid_t parent) {
    static_cast<void>(::setpgid(0, 0));
    static_cast<void>(::prctl(PR_SET_PDEATHSIG, SIGKILL));
    if (::getppid() != parent) ::_exit(127);  // it died before the line above
    const bool wired = ::dup2(pipes.input.read_end.get(), STDIN_FILENO) >= 0 &&
                       ::dup2(pipes.output.write_end.get(), STDOUT_FILENO) >= 0 &&
                       ::dup2(pipes.errors.write_end.get(), STDERR_FILENO) >= 0;
    if (wired) {
        static_cast<void>(::close_range(3, ~0U, CLOSE_RANGE_CLOEXEC));
        if (std::isfinite(limits.cpu_s)) {
            const rlim_t seconds = wholeSeconds(limits.cpu_s);
            setLimit(RLIMIT_CPU, seconds, seconds + 1);
        }
        if (limits.address_space_bytes > 0) setLimit(RLIMIT_AS, limits.address_space_bytes, limits.address_space_bytes);
        setLimit(RLIMIT_CORE, 0, 0);
        static_cast<void>(std::signal(SIGPIPE, SIG_DFL));
        static_cast<void>(::sigprocmask(SIG_SETMASK, &signal_mask, nullptr));
        static_cast<void>(::execv(path, argv));
    }
    const int error_number = errno;
    static_cast<void>(::write(pipes.start.write_end.get(), &error_number, sizeof error_number));
    ::_exit(127);
}

/// One running child: what is still to be written to it, what it has said so far.
class Run {
public:
    Run(pid_t pid, Pipes pipes, const ProcessLimits& limits, std::string_view input)
        : pid_(pid), pipes_(std::move(pipes)), limits_(limits), input_(input), started_(Clock::now()) {}

    ProcessOutcome finish() {
        // glibc 2.36 declares pidfd_open without C linkage, so C++ must ask the kernel itself.
        const Descriptor ended(static_cast<int>(::syscall(SYS_pidfd_open, pid_, 0)));
        for (Pipe* pipe : {&pipes_.output, &pipes_.errors}) makeNonBlocking(pipe->read_end);
        makeNonBlocking(pipes_.input.write_end);
        if (input_.empty()) pipes_.input.write_end.reset();
        while (!ended_ && outcome_.limit == LimitHit::None) waitOnce(ended);
        // Before the child is reaped its number cannot belong to anybody else.
        static_cast<void>(::kill(-pid_, SIGKILL));
        static_cast<void>(::kill(pid_, SIGKILL));
        drain(pipes_.output.read_end, outcome_.output);
        drain(pipes_.errors.read_end, outcome_.errors);
        reap();
        return std::move(outcome_);
    }

private:
    static void makeNonBlocking(const Descriptor& descriptor) {
        static_cast<void>(::fcntl(descriptor.get(), F_SETFL, O_NONBLOCK));
    }

    [[nodiscard]] double elapsed() const { return std::chrono::duration<double>(Clock::now() - started_).count(); }

    /// For poll: at most a day, so that it fits whatever the limit; without a pidfd (an old kernel) a tenth of a second.
    [[nodiscard]] int timeoutMs(bool has_pidfd) const {
        const double left_ms = std::clamp((limits_.wall_s - elapsed()) * 1e3, 0.0, has_pidfd ? 86.4e6 : 100.0);
        return static_cast<int>(std::ceil(left_ms));
    }

    void waitOnce(const Descriptor& ended) {
        std::array<pollfd, 4> watched{{{ended.get(), POLLIN, 0},
                                       {pipes_.input.write_end.get(), POLLOUT, 0},
                                       {pipes_.output.read_end.get(), POLLIN, 0},
                                       {pipes_.errors.read_end.get(), POLLIN, 0}}};
        static_cast<void>(::poll(watched.data(), watched.size(), timeoutMs(ended.isOpen())));
        if (watched[1].revents != 0) feed();
        if (watched[2].revents != 0) drain(pipes_.output.read_end, outcome_.output);
        if (watched[3].revents != 0) drain(pipes_.errors.read_end, outcome_.errors);
        siginfo_t info{};
        if (::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == pid_)
            ended_ = true;
        else if (outcome_.limit == LimitHit::None && elapsed() >= limits_.wall_s)
            outcome_.limit = LimitHit::WallTime;
    }

    void feed() {
        const ssize_t written = ::write(pipes_.input.write_end.get(), input_.data(), input_.size());
        if (written >= 0) input_.remove_prefix(static_cast<std::size_t>(written));
        const bool refused = written < 0 && errno != EAGAIN && errno != EINTR;
        if (refused || input_.empty()) pipes_.input.write_end.reset();
    }

    /// Takes what is there now; closes the descriptor at the end of the stream.
    void drain(Descriptor& from, std::string& into) {
        std::array<char, 65536> block{};
        while (from.isOpen()) {
            const ssize_t got = ::read(from.get(), block.data(), block.size());
            if (got < 0 && errno == EINTR) continue;
            if (got < 0 && errno == EAGAIN) return;
            if (got <= 0) {
                from.reset();
                return;
            }
            const std::size_t taken = outcome_.output.size() + outcome_.errors.size();
            const std::size_t room = limits_.output_bytes - std::min(limits_.output_bytes, taken);
            into.append(block.data(), std::min(room, static_cast<std::size_t>(got)));
            if (room < static_cast<std::size_t>(got)) {
                if (outcome_.limit == LimitHit::None) outcome_.limit = LimitHit::Output;
                return;
            }
        }
    }

    void reap() {
        int status = 0;
        rusage usage{};
        while (::wait4(pid_, &status, 0, &usage) < 0 && errno == EINTR) {
        }
        outcome_.wall_s = elapsed();
        const auto seconds = [](const timeval& t) {
            return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
        };
        outcome_.cpu_s = seconds(usage.ru_utime) + seconds(usage.ru_stime);
        outcome_.peak_memory_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024U;
        if (WIFEXITED(status)) outcome_.exit_code = WEXITSTATUS(status);
        if (WIFSIGNALED(status)) outcome_.signal = WTERMSIG(status);
        const bool killed = outcome_.signal == SIGXCPU || outcome_.signal == SIGKILL;
        if (outcome_.limit == LimitHit::None && killed && std::isfinite(limits_.cpu_s) &&
            (outcome_.signal == SIGXCPU || outcome_.cpu_s >= limits_.cpu_s))
            outcome_.limit = LimitHit::CpuTime;
    }

    pid_t pid_;
    Pipes pipes_;
    ProcessLimits limits_;
    std::string_view input_;
    Clock::time_point started_;
    ProcessOutcome outcome_;
    bool ended_ = false;
};

}  // namespace

Result<ProcessOutcome> runProcess(const std::vector<std::string>& argv, const ProcessLimits& limits,
                                  std::string_view input) {
    const Result<std::string> program = findProgram(argv.empty() ? std::string() : argv.front());
    if (!program) return fail(program.error());
    std::vector<std::string> words = argv;
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);

    Pipes pipes;
    if (!pipes.create()) return processFailure("process.start", argv.front(), errno);
    const NoSigpipe no_sigpipe;
    const pid_t parent = ::getpid();
    const pid_t pid = ::fork();
    if (pid < 0) return processFailure("process.start", argv.front(), errno);
    if (pid == 0) becomeProgram(program->c_str(), pointers.data(), pipes, limits, no_sigpipe.before(), parent);
    static_cast<void>(::setpgid(pid, pid));  // whichever of the two comes first

    pipes.input.read_end.reset();
    pipes.output.write_end.reset();
    pipes.errors.write_end.reset();
    pipes.start.write_end.reset();
    int error_number = 0;
    ssize_t got = 0;
    do got = ::read(pipes.start.read_end.get(), &error_number, sizeof error_number);
    while (got < 0 && errno == EINTR);
    ProcessOutcome outcome = Run(pid, std::move(pipes), limits, input).finish();
    if (got == static_cast<ssize_t>(sizeof error_number))
        return processFailure(error_number == ENOEXEC || error_number == EACCES ? "process.not-executable"
                                                                                : "process.start",
                              argv.front(), error_number);
    return outcome;
}

std::string outcomeText(const ProcessOutcome& outcome) {
    switch (outcome.limit) {
        case LimitHit::WallTime: return fmt::format("stopped after {:.1f} s", outcome.wall_s);
        case LimitHit::CpuTime: return fmt::format("stopped after {:.1f} s of computing", outcome.cpu_s);
        case LimitHit::Output: return "stopped for writing too much";
        case LimitHit::None: break;
    }
    if (outcome.signal != 0) {
        const char* const meaning = ::sigdescr_np(outcome.signal);
        return fmt::format("killed by signal {} ({})", outcome.signal, meaning == nullptr ? "unknown" : meaning);
    }
    return fmt::format("exit code {}", outcome.exit_code);
}

}  // namespace cusp::base
