// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What has to come before the rest of a program that is resumed: computed from the lines before, and proved by the reader.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/comm/dnc/resume.hpp>
#include <cusp/post/control/control_definition.hpp>
#include <cusp/post/reader/program_reader.hpp>

#include <cstdint>
#include <string>

namespace cusp::cli {

struct ResumeOptions {
    std::uint32_t block = 0;  ///< N word to resume at
    /// So many blocks before it are run again, as far as they only move: the tool enters the cut where it has been.
    unsigned back_up_blocks = 3;
    /// Above the place it goes on from, along the tool axis.
    double approach_mm = 10.0;
    post::reader::MachineSetup setup{};
};

/// Modal words as they were last said, tool, offset, transformation; then the retract axis home, the rotary axes turned, over the
/// place, and down along the tool axis at the feed that holds there. Accepted only when the reader, having run preamble and
/// rest, begins the resumed block where and in which state the whole program does.
/// Errors: `send.no-block`; `send.resume` with the line, where the lines before hold what a preamble cannot say (jumps,
/// variables, frames, functions of the machine builder, incremental dimensions, radius compensation); those of the reader.
[[nodiscard]] base::Result<comm::ResumePreamble> resumePreamble(const std::string& text, const std::string& name,
                                                                const post::MachineFile& machine,
                                                                const ResumeOptions& options);

}  // namespace cusp::cli
