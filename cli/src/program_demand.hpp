// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What sending must know of a program and the protocol does not look for itself: blocks, jumps, and its need of bytes.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/comm/dnc/demand.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace cusp::cli {

struct ProgramFacts {
    std::uint32_t blocks = 0;  ///< lines with more than a comment
    /// First line with a word that may lead backward (GOTO, GOTOB, LOOP, FOR, WHILE, REPEAT, UNTIL …).
    std::optional<std::size_t> jump_line;
};
[[nodiscard]] ProgramFacts factsOf(const std::string& text);

/// Byte at which the line with block number `block` begins.
[[nodiscard]] std::optional<std::uint32_t> byteOfBlock(const std::string& text, std::uint32_t block);

/// Runs the program on paper and spreads its bytes and blocks over its time: feeds as programmed, rapids at the slowest
/// linear axis' limit. Accelerations are left out, so that the real need is lower and never higher.
/// Errors: those of the reader.
[[nodiscard]] base::Result<comm::DemandProfile> demandOf(const std::string& text, const std::string& name,
                                                         const post::MachineFile& machine);

}  // namespace cusp::cli
