// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Diagnostics, results and Ctrl-C.
#include "console.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace cusp::cli {

namespace {

volatile std::sig_atomic_t interrupt_seen = 0;

void onInterrupt(int) {
    interrupt_seen = 1;
    // A second Ctrl-C ends the process at once.
    std::signal(SIGINT, SIG_DFL);
}

void put(std::FILE* stream, std::string_view text) { std::fwrite(text.data(), 1, text.size(), stream); }

}  // namespace

void tell(const base::Diagnostics& diagnostics) {
    if (!diagnostics.empty()) put(stderr, base::toText(diagnostics));
}

void say(std::string_view text) { put(stdout, text); }

void sayNow(std::string_view text) {
    say(text);
    std::fflush(stdout);
}

void sayJson(const base::Json& summary) {
    const auto text = base::jsonText(summary);
    if (!text) throw std::logic_error(base::toText(text.error()));
    say(*text);
}

ExitCode exitCodeOf(const base::Diagnostics& diagnostics) {
    const bool only_io = std::all_of(diagnostics.begin(), diagnostics.end(), [](const base::Diagnostic& item) {
        return item.severity != base::Severity::Error || item.code.starts_with("io.");
    });
    return only_io ? ExitCode::Io : ExitCode::BadInput;
}

ExitCode failWith(const base::Diagnostics& diagnostics) {
    tell(diagnostics);
    return exitCodeOf(diagnostics);
}

bool interrupted() { return interrupt_seen != 0; }

void watchForSignals() {
    std::signal(SIGINT, onInterrupt);
    // A closed pipe behind stdout is a failed write with an exit code, not a silent death.
    std::signal(SIGPIPE, SIG_IGN);
}

}  // namespace cusp::cli
