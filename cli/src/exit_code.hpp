// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The exit codes of the cusp command: a contract with scripts.
#pragma once

namespace cusp::cli {

enum class ExitCode : int {
    Done = 0,
    FoundSomething = 1,  ///< done, and it found something: out of tolerance, limit violated, verification failed
    Usage = 2,
    BadInput = 3,
    Io = 4,
    Internal = 5,
    Interrupted = 130,
};

}  // namespace cusp::cli
