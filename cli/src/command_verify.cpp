// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp verify`: reads a program back through kinematics of its own and says whether it does what its CL file says.
#include "command.hpp"
#include "console.hpp"
#include "input.hpp"
#include "machine_lookup.hpp"
#include "setup_lookup.hpp"

#include <cusp/base/json_report.hpp>
#include <cusp/base/units.hpp>
#include <cusp/post/verify/execution.hpp>
#include <cusp/post/verify/verify_program.hpp>

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cusp::cli {

namespace {

using post::verify::ExecutedExtreme;
using post::verify::ExecutionReport;
using post::verify::Extreme;
using post::verify::VerifyReport;

struct Flags {
    std::string program;
    std::string machine;
    std::string against;
    std::string dialect;
    std::string units;
    std::vector<std::string> work_offsets;
    double tip_tolerance_mm = 0.001;
    double axis_tolerance_deg = 0.001;
    std::optional<double> between_axis_tolerance_deg;
    std::optional<double> between_tip_tolerance_mm;
    std::optional<double> tool_length_mm;
    std::vector<double> wcs_origin_mm;
    std::string setup;
    std::string record;
    std::optional<double> execution_tolerance_mm;
    int cutting_edge = 1;
    bool fixed_tool_length_axis = false;
    bool strict = false;
    bool json = false;
};

base::Json toJson(const Extreme& extreme, double per_unit) {
    base::Json out;
    out["value"] = extreme.value * per_unit;
    out["program_line"] = extreme.program_line;
    if (extreme.block_number) out["block_number"] = *extreme.block_number;
    out["cl_line"] = extreme.cl_line;
    return out;
}

base::Json toJson(const ExecutedExtreme& extreme, double per_unit) {
    return {{"value", extreme.value * per_unit}, {"time_s", extreme.time_s}, {"program_line", extreme.line}};
}

base::Json toJson(const Flags& flags, const ExecutionReport& report) {
    const double deg = base::degFromRad(1.0);
    base::Json out;
    out["record"] = flags.record;
    out["pass"] = report.pass;
    out["samples"] = report.samples;
    out["compared"] = report.compared;
    out["cutting"] = report.cutting;
    out["points"] = report.points;
    out["unreached"] = report.unreached;
    out["rms_tip_mm"] = report.rms_tip_mm;
    out["max_tip_mm"] = toJson(report.max_tip_mm, 1.0);
    out["max_axis_deg"] = toJson(report.max_axis_rad, deg);
    out["max_tip_rapid_mm"] = toJson(report.max_tip_rapid_mm, 1.0);
    out["diagnostics"] = base::diagnosticsToJson(report.findings);
    return out;
}

base::Json toJson(const Flags& flags, const VerifyReport& report) {
    const double deg = base::degFromRad(1.0);
    base::Json out = base::jsonReport("verify", 1);
    out["program"] = flags.program;
    out["against"] = report.compared ? base::Json(flags.against) : base::Json();
    out["pass"] = report.pass;
    out["points"] = report.points;
    out["matched"] = report.matched;
    out["missed"] = report.missed;
    out["blocks"] = report.blocks;
    out["motions"] = report.motions;
    out["intermediate"] = report.intermediate;
    out["links"] = report.links;
    out["excursions"] = report.excursions;
    out["extra"] = report.extra;
    out["max_tip_error_mm"] = report.max_tip_error_mm.value;
    out["max_axis_error_deg"] = report.max_axis_error_rad.value * deg;
    out["max_tip_between_mm"] = report.max_tip_between_mm.value;
    out["max_axis_between_deg"] = report.max_axis_between_rad.value * deg;
    out["max_tip_between_rapid_mm"] = report.max_tip_between_rapid_mm.value;
    out["max_axis_between_rapid_deg"] = report.max_axis_between_rapid_rad.value * deg;
    out["where"] = {{"max_tip_error", toJson(report.max_tip_error_mm, 1.0)},
                    {"max_axis_error", toJson(report.max_axis_error_rad, deg)},
                    {"max_tip_between", toJson(report.max_tip_between_mm, 1.0)},
                    {"max_axis_between", toJson(report.max_axis_between_rad, deg)},
                    {"max_tip_between_rapid", toJson(report.max_tip_between_rapid_mm, 1.0)},
                    {"max_axis_between_rapid", toJson(report.max_axis_between_rapid_rad, deg)}};
    out["limit_violations"] = report.limit_violations;
    out["rotary_limits"] = report.rotary_limits_checked ? "checked" : "not checked";
    out["linear_travel"] = report.linear_travel_checked ? "checked"
                           : report.travel_checked > 0  ? "partly checked"
                                                        : "not checked";
    out["diagnostics"] = base::diagnosticsToJson(report.findings);
    return out;
}

base::Result<std::optional<toolpath::ToolPath>> readAgainst(const Flags& flags) {
    if (flags.against.empty()) return std::optional<toolpath::ToolPath>();
    base::Diagnostics warnings;
    auto path =
        toolpath::readToolPathFile(flags.against, clReaderOptions(flags.dialect, flags.units, flags.strict), warnings);
    tell(warnings);
    if (!path) return base::fail(std::move(path).error());
    return std::optional<toolpath::ToolPath>(*std::move(path));
}

base::Result<std::optional<machine::SetupDefinition>> readSetup(const Flags& flags) {
    if (flags.setup.empty()) return std::optional<machine::SetupDefinition>();
    auto setup = loadSetup(flags.setup);
    if (!setup) return base::fail(std::move(setup).error());
    return std::optional<machine::SetupDefinition>(*std::move(setup));
}

/// The run of the program against the program, when there is a record of it.
base::Result<std::optional<ExecutionReport>> compareRecord(const Flags& flags, const post::MachineFile& machine,
                                                           const post::verify::VerifyOptions& verifying) {
    if (flags.record.empty()) return std::optional<ExecutionReport>();
    auto table = TextInput::open(flags.record);
    if (!table) return base::fail(std::move(table).error());
    const auto samples = post::verify::readExecutionRecord(table->stream(), table->name());
    if (!samples) return base::fail(samples.error());
    auto program = TextInput::open(flags.program);
    if (!program) return base::fail(std::move(program).error());
    post::verify::ExecutionOptions options;
    options.tip_tolerance_mm =
        flags.execution_tolerance_mm.value_or(machine.control.cycle832_tolerance_mm + flags.tip_tolerance_mm);
    options.tool_length_mm = verifying.tool_length_mm;
    options.wcs_origin_mm = verifying.wcs_origin_mm;
    options.setup = verifying.setup;
    auto report = post::verify::compareExecution(program->stream(), program->name(), machine, *samples, options);
    if (!report) return base::fail(std::move(report).error());
    return std::optional<ExecutionReport>(*std::move(report));
}

ExitCode runVerify(const Flags& flags) {
    auto machine = loadMachine(flags.machine);
    if (!machine) return failWith(machine.error());
    const auto against = readAgainst(flags);
    if (!against) return failWith(against.error());
    const auto setup = readSetup(flags);
    if (!setup) return failWith(setup.error());
    auto program = TextInput::open(flags.program);
    if (!program) return failWith(program.error());

    post::verify::VerifyOptions options;
    options.tip_tolerance_mm = flags.tip_tolerance_mm;
    options.between_tip_tolerance_mm = flags.between_tip_tolerance_mm.value_or(flags.tip_tolerance_mm);
    options.tool_length_mm = flags.tool_length_mm;
    if (flags.wcs_origin_mm.size() == 3)
        options.wcs_origin_mm = {flags.wcs_origin_mm[0], flags.wcs_origin_mm[1], flags.wcs_origin_mm[2]};
    options.axis_tolerance_rad = base::radFromDeg(flags.axis_tolerance_deg);
    if (flags.between_axis_tolerance_deg)
        options.between_axis_tolerance_rad = base::radFromDeg(*flags.between_axis_tolerance_deg);
    if (*setup) options.setup = &**setup;
    options.work_offsets = flags.work_offsets;
    options.cutting_edge = flags.cutting_edge;
    options.fixed_tool_length_axis = flags.fixed_tool_length_axis;
    options.strict = flags.strict;
    const auto report = post::verify::verifyProgram(program->stream(), program->name(), machine->file,
                                                    *against ? &**against : nullptr, options);
    if (!report) return failWith(report.error());
    tell(report->findings);
    const auto execution = compareRecord(flags, machine->file, options);
    if (!execution) return failWith(execution.error());
    if (*execution) tell((*execution)->findings);
    const bool pass = report->pass && (!*execution || (*execution)->pass);
    if (flags.json) {
        base::Json json = toJson(flags, *report);
        json["pass"] = pass;
        json["execution"] = *execution ? toJson(flags, **execution) : base::Json();
        sayJson(json);
    } else
        say(fmt::format("{} on {}{}\n", fileNameOf(flags.program), machine->file.machine.name,
                        flags.against.empty() ? "" : ", against " + fileNameOf(flags.against)) +
            (machine->unanchored() ? unanchored_text : "") + post::verify::toText(*report) +
            (*execution ? post::verify::toText(**execution) : ""));
    return pass ? ExitCode::Done : ExitCode::FoundSomething;
}

}  // namespace

void addVerifyCommand(CLI::App& app, Action& action) {
    CLI::App* verify = app.add_subcommand(
        "verify", "Reads an 840D program back through kinematics of its own and compares it with its CL file.");
    const auto flags = std::make_shared<Flags>();
    verify->add_option("PROGRAM", flags->program, "Program to read; - for standard input.")->required();
    verify->add_option("-m,--machine", flags->machine, "Machine file, or the name of one that ships with cusp.")
        ->required();
    verify->add_option("--against", flags->against, "CL file the program must follow.");
    verify->add_option("--dialect", flags->dialect, "Who wrote the CL file, when it cannot be told from the text.")
        ->check(CLI::IsMember({"nx", "catia", "solidworks", "apt"}));
    verify->add_option("--units", flags->units, "Unit of lengths, when the CL file does not say.")
        ->check(CLI::IsMember({"mm", "inch"}));
    verify
        ->add_option("--work-offset", flags->work_offsets,
                     "Work offsets of the CL file's frames in the order they come in, when not the machine file's and "
                     "those behind it; several by commas.")
        ->allow_extra_args(false)
        ->delimiter(',');
    verify->add_option("--tip-tolerance-mm", flags->tip_tolerance_mm, "Allowed distance of the tip from the CL file.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    verify
        ->add_option("--axis-tolerance-deg", flags->axis_tolerance_deg, "Allowed angle of the tool axis at block ends.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    verify
        ->add_option("--between-axis-tolerance-deg", flags->between_axis_tolerance_deg,
                     "Allowed angle between block ends; stated but not judged when left out.")
        ->check(CLI::PositiveNumber);
    verify
        ->add_option(
            "--between-tip-tolerance-mm", flags->between_tip_tolerance_mm,
            "Allowed distance of the tip from the CL file between block ends; as --tip-tolerance-mm when left out.")
        ->check(CLI::PositiveNumber);
    verify
        ->add_option("--tool-length-mm", flags->tool_length_mm,
                     "Length of the tool, for programs that turn rotary axes without TRAORI.")
        ->check(CLI::NonNegativeNumber);
    verify
        ->add_option(
            "--wcs-origin-mm", flags->wcs_origin_mm,
            "Origin of the work offset in machine coordinates, X Y Z: for such programs on machines with a rotary table.")
        ->expected(3);
    verify->add_option("--setup", flags->setup,
                       "Setup file: where the work offsets lie and how long the tools are; checks linear travel too.");
    verify->add_option("--record", flags->record,
                       "What the tool really did (cusp controller --record): compared with the program as well.");
    verify
        ->add_option(
            "--execution-tolerance-mm", flags->execution_tolerance_mm,
            "Allowed distance of the executed tip from the programmed path; the machine file's CYCLE832 tolerance "
            "and --tip-tolerance-mm together when left out.")
        ->check(CLI::PositiveNumber);
    verify->add_option("--cutting-edge", flags->cutting_edge, "D the cuts must run with.")
        ->capture_default_str()
        ->check(CLI::Range(1, 9999));
    verify->add_flag(
        "--fixed-tool-length-axis", flags->fixed_tool_length_axis,
        "The tool length acts along the spindle in every plane (SD42940), so G18 and G19 may stand in cuts.");
    verify->add_flag("--strict", flags->strict, "Words whose meaning is the machine builder's are errors.");
    verify->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    verify->callback([flags, &action] {
        if (flags->program == "-" && !flags->record.empty())
            throw CLI::ValidationError("--record",
                                       "reads the program twice, so that it cannot come from standard input");
        action = [flags] { return runVerify(*flags); };
    });
}

}  // namespace cusp::cli
