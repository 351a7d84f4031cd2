// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Going on in the middle of a program: what has to come before the rest of it is received as data.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/comm/dnc/sender.hpp>

#include <cstdint>
#include <string>

namespace cusp::comm {

/// Made by whoever understands the program: the text that rebuilds its modal state (transformation, frame, tool, feed,
/// spindle, approach), and where the rest begins.
struct ResumePreamble {
    std::string text;
    std::uint32_t from_byte = 0;
    std::uint32_t start_block = 0;
};

/// A program of its own, with a digest of its own: preamble, then the rest. Lines are never just skipped: without a
/// preamble there is no resume.
/// Errors: `dnc.resume` (no preamble, a place that is not the beginning of a line, nothing left).
[[nodiscard]] base::Result<Program> resumedProgram(const Program& program, const ResumePreamble& preamble);

}  // namespace cusp::comm
