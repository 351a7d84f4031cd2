// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Running fragile foreign code in a process of its own, with limits on time, memory and output.
#pragma once

#include <cusp/base/result.hpp>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::base {

struct ProcessLimits {
    double wall_s = std::numeric_limits<double>::infinity();
    double cpu_s = std::numeric_limits<double>::infinity();  ///< counted in whole seconds, rounded up, by the system
    std::uint64_t address_space_bytes = 0;                   ///< 0: no limit
    std::size_t output_bytes = std::size_t{64} << 20U;       ///< standard output and error together
};

/// Which limit ended the process. A refused allocation is not among them: the program sees that itself, and ends as it
/// chooses (`std::bad_alloc`, exit code 1 …).
enum class LimitHit { None, WallTime, CpuTime, Output };

struct ProcessOutcome {
    int exit_code = -1;  ///< -1 when a signal ended it
    int signal = 0;
    LimitHit limit = LimitHit::None;
    std::string output;
    std::string errors;
    double wall_s = 0.0;
    double cpu_s = 0.0;
    std::uint64_t peak_memory_bytes = 0;  ///< largest resident set

    [[nodiscard]] bool succeeded() const { return exit_code == 0 && limit == LimitHit::None; }
};

/// Runs `argv` without a shell (argv[0] is searched in PATH unless it has a slash), feeds it `input` and collects what it
/// writes until it ends or a limit kills it. Its whole process group dies with it, and it dies with the calling thread.
/// It inherits the environment and no open file but the three standard ones.
/// Errors: `process.not-found`, `process.not-executable`, `process.start` (with the system's reason). Whatever the program
/// does once it runs is an outcome, not an error.
[[nodiscard]] Result<ProcessOutcome> runProcess(const std::vector<std::string>& argv, const ProcessLimits& limits = {},
                                                std::string_view input = {});

/// "exit code 3", "killed by signal 11 (Segmentation fault)", "stopped after 2.5 s" …, for messages.
[[nodiscard]] std::string outcomeText(const ProcessOutcome& outcome);

}  // namespace cusp::base
