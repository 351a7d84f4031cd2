// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Lines in, blocks parsed, evaluated and run, in the order the program says.
#include <cusp/post/reader/program_reader.hpp>

#include "executor.hpp"
#include "program_flow.hpp"
#include "program_source.hpp"

#include <algorithm>
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

/// The loop over blocks, and what it has to remember.
class Run {
public:
    Run(std::istream& in, const std::string& file_name, const MachineFile& machine, const ForwardChain& chain,
        const ReaderOptions& options, ProgramSink& sink, base::Diagnostics& report)
        : options_(options),
          report_(report),
          source_(in, file_name, options.max_line_bytes),
          contents_(machine.machine, chain, options, report),
          executor_(machine, chain, options.setup, sink, report),
          flow_(source_, contents_.variables(), report) {}

    bool step() {
        if (executor_.ended() || aborted_) return false;
        one();
        return !executor_.ended() && !aborted_;
    }
    [[nodiscard]] bool ended() const { return executor_.ended(); }
    [[nodiscard]] std::size_t line() const { return source_.lineNumber(); }

    ReadSummary finish(const std::string& file_name) {
        if (!executor_.ended() && !broken_)
            report_.error("nc.no-end", "the program ends without M30, M2 or M17",
                          {file_name, source_.lineNumber(), 0, {}});
        if (executor_.ended() && source_.index() == nullptr) warnOfTheRest();
        summary_.motions = executor_.motions();
        return summary_;
    }

private:
    void one() {
        const std::size_t errors_before = report_.errorCount();
        if (!source_.next(block_.line, report_) || flow_.ranOut()) {
            aborted_ = true;
            broken_ = report_.errorCount() > errors_before;
            return;
        }
        block_.where = source_.where();
        summary_.lines = std::max(summary_.lines, source_.lineNumber());
        if (runsAway()) return;
        checkLength(block_, report_);
        if (!parseBlock(block_, report_)) return;
        warnOfSkippedBlock(block_, skip_warned_, report_);
        if (block_.is_header) checkHeader(block_, summary_.blocks, report_);
        if (block_.words.empty()) return;
        ++summary_.blocks;
        const std::size_t errors_before_flow = report_.errorCount();
        if (flow_.takes(block_)) {
            aborted_ = broken_ = !flow_.run(block_);
            return;
        }
        // An unknown word may be a subprogram of this file; keeping the whole text to find out may have failed.
        aborted_ = broken_ = report_.errorCount() > errors_before_flow;
        if (aborted_) return;
        executor_.run(block_, contents_.read(block_), flow_.inSubprogram());
        if (executor_.returned()) flow_.leaveSubprogram();
    }

    /// Lines run again find the same errors again, and a program without end would find them for ever.
    bool runsAway() {
        if (source_.repeatedLines() == repeated_) return false;
        repeated_ = source_.repeatedLines();
        if (repeated_ > options_.max_repeated_lines)
            report_.error(
                "nc.endless",
                fmt::format("{} lines were run a second time and more without an end: the program does not end",
                            options_.max_repeated_lines),
                source_.where());
        aborted_ = broken_ = report_.hasErrors();
        return aborted_;
    }

    void warnOfTheRest() {
        while (source_.next(block_.line, report_))
            if (!isBlank(block_.line))
                return report_.warning("nc.after-end", "what follows the end of the program is not read",
                                       source_.where());
    }

    const ReaderOptions& options_;
    base::Diagnostics& report_;
    ProgramSource source_;
    ContentReader contents_;
    Executor executor_;
    ProgramFlow flow_;
    Block block_;
    ReadSummary summary_;
    std::size_t repeated_ = 0;
    bool skip_warned_ = false;
    bool aborted_ = false;
    bool broken_ = false;  ///< for a reason that is reported
};

}  // namespace

struct ProgramRun::State {
    State(std::istream& in, std::string name, const MachineFile& machine, ReaderOptions reader_options,
          ProgramSink& sink, base::Diagnostics& report)
        : file_name(std::move(name)),
          options(std::move(reader_options)),
          chain(machine.machine),
          run(in, file_name, machine, chain, options, sink, report) {}

    std::string file_name;
    ReaderOptions options;
    ForwardChain chain;
    Run run;
};

ProgramRun::ProgramRun(std::istream& in, std::string file_name, const MachineFile& machine, ReaderOptions options,
                       ProgramSink& sink, base::Diagnostics& report)
    : state_(std::make_unique<State>(in, std::move(file_name), machine, std::move(options), sink, report)) {}
ProgramRun::~ProgramRun() = default;

bool ProgramRun::step() { return state_->run.step(); }
bool ProgramRun::ended() const { return state_->run.ended(); }
std::size_t ProgramRun::line() const { return state_->run.line(); }
ReadSummary ProgramRun::finish() { return state_->run.finish(state_->file_name); }

ReadSummary readProgram(std::istream& in, const std::string& file_name, const MachineFile& machine,
                        const ReaderOptions& options, ProgramSink& sink, base::Diagnostics& report) {
    if (machine.machine.rotary.size() > max_rotary_axes) {
        report.error("nc.machine", fmt::format("the machine has more than {} rotary axes", max_rotary_axes),
                     {file_name, 0, 0, {}});
        return {};
    }
    ProgramRun run(in, file_name, machine, options, sink, report);
    while (run.step()) continue;
    return run.finish();
}

}  // namespace cusp::post::reader
