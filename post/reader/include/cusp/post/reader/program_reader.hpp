// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Runs a Sinumerik 840D program on paper and tells a sink what the machine would do.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/machine/setup_definition.hpp>
#include <cusp/post/control/control_definition.hpp>
#include <cusp/post/reader/executed_program.hpp>

#include <array>
#include <cstddef>
#include <istream>
#include <memory>
#include <optional>
#include <string>

namespace cusp::post::reader {

/// The shop's knowledge, from figures that hold throughout or from a setup file; the figures go before it.
struct MachineSetup {
    std::optional<double> tool_length_mm;
    std::optional<std::array<double, 3>> wcs_origin_mm;
    /// Looked up by the tool and the work offset at hand. Must outlive the read.
    const machine::SetupDefinition* definition = nullptr;
};

struct ReaderOptions {
    /// M and H functions whose meaning belongs to the machine builder are errors instead of warnings.
    bool strict = false;
    /// With it, poses are known where rotary axes are away from zero without TRAORI.
    MachineSetup setup;
    /// Blocks longer than the control takes (512 characters) are errors, but a line longer than this ends the read: a
    /// binary file must not be taken for one huge block.
    std::size_t max_line_bytes = 64 * 1024;
    /// Loops may run this many lines a second time and more, all loops together; then the program is taken for endless.
    std::size_t max_repeated_lines = 1'000'000;
};

struct ReadSummary {
    std::size_t lines = 0;
    std::size_t blocks = 0;  ///< lines with at least one word, as often as they were run
    std::size_t motions = 0;
};

/// Streams: memory does not grow with the program, unless it has jumps, loops or subprograms; from the first of these on
/// it is kept whole, which needs a stream that can be read again from its beginning (of a pipe, the blocks before the first
/// jump are out of its reach). Every problem is reported with its line, and reading goes on after
/// those that leave the rest readable; what was handed to the sink is only meaningful when `report` gained no error.
/// Errors: `nc.unsupported` (a word whose effect this reader cannot compute, by name), `nc.unknown-word`, `nc.syntax`,
/// and the others that post/reader/README.md lists.
ReadSummary readProgram(std::istream& in, const std::string& file_name, const MachineFile& machine,
                        const ReaderOptions& options, ProgramSink& sink, base::Diagnostics& report);

/// The same, line by line, for whoever is handed a program while it runs. A line must be there as a whole when `step` is
/// called; the stream may have been at its end before, if whoever owns it has cleared that. The machine must have no more
/// than `max_rotary_axes`; all references must outlive the run.
class ProgramRun {
public:
    ProgramRun(std::istream& in, std::string file_name, const MachineFile& machine, ReaderOptions options,
               ProgramSink& sink, base::Diagnostics& report);
    ~ProgramRun();
    ProgramRun(const ProgramRun&) = delete;
    ProgramRun& operator=(const ProgramRun&) = delete;

    /// Reads and runs one line. False when the program is over: at its end, at the end of the text, or after a problem that
    /// ends the read.
    [[nodiscard]] bool step();
    /// M30, M2 or M17 was reached.
    [[nodiscard]] bool ended() const;
    /// The line read last.
    [[nodiscard]] std::size_t line() const;
    /// After the last step: reports a program without end, and what stands behind it.
    ReadSummary finish();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace cusp::post::reader
