// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the command says to people: diagnostics and progress on stderr, results on stdout.
#pragma once

#include "exit_code.hpp"

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/json_report.hpp>

#include <string_view>

namespace cusp::cli {

/// Writes all diagnostics to stderr, one per line.
void tell(const base::Diagnostics& diagnostics);

/// Writes to stdout.
void say(std::string_view text);

/// The same, and at once: for those who wait for the line.
void sayNow(std::string_view text);

/// Writes a `--json` summary to stdout. A number that is not finite is our own mistake and ends the command (exit 5).
void sayJson(const base::Json& summary);

/// The exit code for input that failed: Io when every error is one of the system's (`io.*`), BadInput otherwise.
[[nodiscard]] ExitCode exitCodeOf(const base::Diagnostics& diagnostics);

/// Tells the diagnostics and answers their exit code.
[[nodiscard]] ExitCode failWith(const base::Diagnostics& diagnostics);

/// After Ctrl-C: long loops ask and leave tidily, so that no temporary file stays behind.
[[nodiscard]] bool interrupted();
void watchForSignals();

}  // namespace cusp::cli
