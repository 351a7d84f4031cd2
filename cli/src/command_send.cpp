// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp send`: brings a program to a control, or back from it, and says how it went.
#include "command.hpp"
#include "console.hpp"
#include "input.hpp"
#include "machine_lookup.hpp"
#include "program_demand.hpp"
#include "program_resume.hpp"
#include "send_delivery.hpp"
#include "setup_lookup.hpp"

#include <cusp/base/atomic_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

namespace cusp::cli {

namespace {

constexpr std::size_t most_program_bytes = std::size_t{256} << 20U;
constexpr std::size_t most_key_bytes = 4096;

base::Result<comm::ResumePreamble> computedPreamble(const SendFlags& flags, const std::string& text) {
    const auto machine = loadMachine(flags.machine);
    if (!machine) return base::fail(machine.error());
    ResumeOptions options;
    options.block = *flags.resume_block;
    options.back_up_blocks = flags.back_up_blocks;
    options.approach_mm = flags.approach_mm;
    std::optional<machine::SetupDefinition> setup;
    if (!flags.setup.empty()) {
        auto read = loadSetup(flags.setup);
        if (!read) return base::fail(std::move(read).error());
        setup = *std::move(read);
        options.setup.definition = &*setup;
    }
    return resumePreamble(text, flags.program, machine->file, options);
}

base::Result<comm::Program> resumed(const SendFlags& flags, comm::Program program) {
    if (!flags.resume_block) return program;
    if (flags.preamble.empty()) {
        auto computed = computedPreamble(flags, program.text);
        if (!computed) return base::fail(std::move(computed).error());
        return comm::resumedProgram(program, *computed);
    }
    const auto from = byteOfBlock(program.text, *flags.resume_block);
    if (!from)
        return base::fail("send.no-block", fmt::format("has no block N{}", *flags.resume_block),
                          {flags.program, 0, 0, {}});
    auto preamble = base::readWholeFile(flags.preamble, most_program_bytes);
    if (!preamble) return base::fail(std::move(preamble).error());
    return comm::resumedProgram(program, {*std::move(preamble), *from, *flags.resume_block});
}

base::Result<comm::Program> readProgram(const SendFlags& flags) {
    auto text = base::readWholeFile(flags.program, most_program_bytes);
    if (!text) return base::fail(std::move(text).error());
    const base::Location where{flags.program, 0, 0, {}};
    if (text->empty()) return base::fail("send.empty", "is empty", where);
    comm::Program program;
    program.name = flags.name.empty() ? fileNameOf(flags.program) : flags.name;
    if (!comm::isProgramName(program.name))
        return base::fail(
            "send.name",
            fmt::format("'{}' is no name a control takes: at most {} letters, digits, '_', '-' and '.'; give "
                        "another with --name",
                        program.name, comm::max_name_bytes),
            where);
    if (text->find('\0') != std::string::npos) {
        base::Diagnostics doubt;
        doubt.warning("send.binary", "holds NUL bytes, as no NC program does; it is sent all the same", where);
        tell(doubt);
    }
    const ProgramFacts facts = factsOf(*text);
    program.blocks = facts.blocks;
    program.jumps_backward = facts.jump_line.has_value();
    program.text = *std::move(text);
    if (flags.drip && facts.jump_line)
        return base::fail("send.jumps", "may lead backward, where a drip-fed program is gone already; send it whole",
                          {flags.program, *facts.jump_line, 0, {}});
    return resumed(flags, std::move(program));
}

base::Result<comm::SenderOptions> senderOptions(const SendFlags& flags, const comm::Program& program) {
    comm::SenderOptions options;
    options.mode = flags.drip ? comm::TransferMode::Drip : comm::TransferMode::Store;
    options.client = randomClient();
    options.compare = flags.compare && !flags.drip;
    options.arm = flags.arm || flags.start || flags.drip;
    options.start = flags.start;
    options.refuse_slow_link = !flags.allow_slow_link;
    if (!flags.key_file.empty()) {
        auto key = base::readWholeFile(flags.key_file, most_key_bytes);
        if (!key) return base::fail(std::move(key).error());
        options.commit_key = key->substr(0, key->find_last_not_of("\r\n") + 1);
        if (options.commit_key.empty()) return base::fail("send.key", "holds no key", {flags.key_file, 0, 0, {}});
    }
    if (flags.drip && !flags.machine.empty()) {
        const auto machine = loadMachine(flags.machine);
        if (!machine) return base::fail(machine.error());
        auto demand = demandOf(program.text, flags.program, machine->file);
        if (!demand) return base::fail(std::move(demand).error());
        options.demand = *std::move(demand);
    }
    if (options.demand || flags.measure) options.probes = 24;
    return options;
}

ExitCode runSend(const SendFlags& flags) {
    const auto url = comm::parseLinkUrl(flags.to);
    if (!url) return failWith(url.error());
    if (flags.program.empty()) return fetchProgram(flags, *url);
    const auto program = readProgram(flags);
    if (!program) return failWith(program.error());
    if (flags.plain) return sendPlain(flags, *url, *program);
    if (url->kind == comm::LinkKind::File) return deliverToFolder(flags, *url, *program);
    const auto options = senderOptions(flags, *program);
    if (!options) return failWith(options.error());
    return sendOverLink(flags, *url, *program, *options);
}

/// Combinations CLI11 cannot check.
std::string contradiction(const SendFlags& flags) {
    if (flags.program.empty() == flags.fetch.empty()) return "give either a program to send or --fetch NAME";
    if (!flags.fetch.empty() && flags.output.empty()) return "--fetch needs -o FILE";
    if (!flags.resume_block && !flags.preamble.empty()) return "--preamble goes with --resume-block";
    if (flags.resume_block && flags.preamble.empty() && flags.machine.empty())
        return "--resume-block needs the machine file (-m), or a preamble of your own (--preamble)";
    return "";
}

}  // namespace

void addSendCommand(CLI::App& app, Action& action) {
    CLI::App* send = app.add_subcommand("send", "Brings a program to a control, bit-exact, over a poor link too.");
    const auto flags = std::make_shared<SendFlags>();
    send->add_option("PROGRAM", flags->program, "Program to send.");
    send->add_option("--to", flags->to,
                     "Where: tcp://, serial://, modbus-tcp://, modbus-rtu://, can://, file:// (docs/dnc-protocol.md).")
        ->required();
    send->add_option("--name", flags->name, "Name in the control; the file's when left out.");
    send->add_option("--fetch", flags->fetch, "Bring the program of this name back instead.");
    send->add_option("-o,--output", flags->output, "Where to put what --fetch brings.");
    send->add_flag("--drip", flags->drip, "The program runs while it comes: for programs larger than the memory.");
    send->add_option("-m,--machine", flags->machine,
                     "Machine file: with --drip, the program's need is compared with the measured link.");
    send->add_flag("--allow-slow-link", flags->allow_slow_link, "Warn of a link that is too slow instead of refusing.");
    send->add_flag("--measure", flags->measure, "Measure the link before the transfer.");
    send->add_flag("--compare", flags->compare, "Read the program back afterwards and compare.");
    send->add_flag("--arm", flags->arm, "Make it ready for the start at the control.");
    send->add_flag("--start", flags->start, "Ask for the start; the operator must have enabled that at the control.");
    send->add_option("--key-file", flags->key_file, "Key the control demands of what is committed.");
    send->add_option(
        "--resume-block", flags->resume_block,
        "Send the rest from the block with this N word on, behind a preamble that rebuilds tool, state and place; "
        "computed with -m, and proved by reading it back.");
    send->add_option("--back-up-blocks", flags->back_up_blocks, "With it, blocks before that are run again (3).")
        ->check(CLI::Range(0, 1000));
    send->add_option("--approach-mm", flags->approach_mm, "With it, distance above the place along the tool axis (10).")
        ->check(CLI::NonNegativeNumber);
    send->add_option("--preamble", flags->preamble,
                     "File with what comes before that block instead of what is computed.");
    send->add_flag("--plain", flags->plain,
                   "No protocol: bare text held by XON/XOFF, for controls that speak nothing else.");
    send->add_option("--eol", flags->line_end, "With --plain, line ends.")
        ->check(CLI::IsMember({"keep", "lf", "crlf"}))
        ->capture_default_str();
    send->add_flag("--wait-for-xon", flags->wait_for_xon, "With --plain, the control asks for the program by XON.");
    send->add_flag("--extcall", flags->extcall, "With file://, put a caller program beside it.");
    send->add_option("--operator", flags->operator_label, "Who sends, for the ledger.");
    send->add_option("--control", flags->control_label, "Which machine it goes to, for the ledger.");
    send->add_option("--ledger", flags->ledger, "Ledger of transfers; in the user's state folder when left out.");
    send->add_flag("--no-ledger", flags->no_ledger, "Keep no record.");
    send->add_option("--monitor", flags->monitor,
                     "Serves a page to watch the transfer at HOST:PORT of this machine (port 0: a free one).");
    send->add_option("--setup", flags->setup, "Setup file: where the work offsets lie and how long the tools are.");
    send->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    send->callback([flags, &action] {
        if (const std::string wrong = contradiction(*flags); !wrong.empty()) throw CLI::ValidationError(wrong);
        action = [flags] { return runSend(*flags); };
    });
}

}  // namespace cusp::cli
