// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Lines in, blocks parsed, evaluated and run, one after the other.
#include <cusp/post/reader/program_reader.hpp>

#include "executor.hpp"
#include "line_source.hpp"

#include <fmt/format.h>

namespace cusp::post::reader {

namespace {

/// Comment and line end included (Siemens, block structure).
constexpr std::size_t longest_block = 512;

void checkLength(const Block& block, base::Diagnostics& report) {
    const std::size_t length = block.line.size() + 1;
    if (length > longest_block)
        report.error("nc.block-too-long",
                     fmt::format("the block has {} characters with its comment and line end; the control takes {}",
                                 length, longest_block),
                     block.where);
}

void warnOfSkippedBlock(const Block& block, bool& warned, base::Diagnostics& report) {
    if (!block.may_be_skipped || warned) return;
    warned = true;
    report.warning("nc.block-skip",
                   "blocks that begin with '/' may be skipped at the control; they are read as not skipped",
                   block.where);
}

/// A second heading would be a second program in one file.
void checkHeader(const Block& block, std::size_t blocks_before, base::Diagnostics& report) {
    if (blocks_before > 0)
        report.error("nc.unsupported", "a second program in one file is not interpreted", block.where);
}

bool isBlank(const std::string& line) { return line.find_first_not_of(" \t") == std::string::npos; }

}  // namespace

ReadSummary readProgram(std::istream& in, const std::string& file_name, const MachineFile& machine,
                        const ReaderOptions& options, ProgramSink& sink, base::Diagnostics& report) {
    ReadSummary summary;
    const ForwardChain chain(machine.machine);
    if (chain.rotaryCount() > max_rotary_axes) {
        report.error("nc.machine", fmt::format("the machine has more than {} rotary axes", max_rotary_axes),
                     {file_name, 0, 0, {}});
        return summary;
    }
    LineSource lines(in, file_name, options.max_line_bytes);
    ContentReader contents(machine.machine, chain, options, report);
    Executor executor(machine, chain, sink, report);
    Block block;
    bool skip_warned = false;
    bool aborted = false;
    while (!executor.ended()) {
        const std::size_t errors_before = report.errorCount();
        if (!lines.next(block.line, report)) {
            aborted = report.errorCount() > errors_before;
            break;
        }
        block.where = lines.where();
        checkLength(block, report);
        if (!parseBlock(block, report)) continue;
        warnOfSkippedBlock(block, skip_warned, report);
        if (block.is_header) checkHeader(block, summary.blocks, report);
        if (block.words.empty()) continue;
        ++summary.blocks;
        executor.run(block, contents.read(block));
    }
    summary.lines = lines.lineNumber();
    summary.motions = executor.motions();
    if (!executor.ended() && !aborted)
        report.error("nc.no-end", "the program ends without M30, M2 or M17", {file_name, summary.lines, 0, {}});
    while (executor.ended() && lines.next(block.line, report))
        if (!isBlank(block.line)) {
            report.warning("nc.after-end", "what follows the end of the program is not read", lines.where());
            break;
        }
    return summary;
}

}  // namespace cusp::post::reader
