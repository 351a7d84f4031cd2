// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The field table of `[control]`, and the reading and printing of a whole machine file.
#include <cusp/post/control/control_definition.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fmt/format.h>
#include <string_view>
#include <vector>

namespace cusp::post {

bool isSettableFrame(std::string_view text) {
    if (text.size() < 2 || text.front() != 'G' || text[1] == '0') return false;
    int number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, problem] = std::from_chars(text.data() + 1, end, number);
    if (problem != std::errc{} || stop != end) return false;
    return (number >= 54 && number <= 57) || (number >= 505 && number <= 599) || number == 500;
}

namespace {

using base::Diagnostics;
using base::Section;
using base::TomlNode;

/// A block is at most 512 characters, comment and line end included; a number, a space and the line end go with it.
constexpr std::size_t longest_start_codes = 480;

/// Nine decimals of a millimetre are far below any control's resolution; more would only lengthen the blocks.
constexpr base::FieldRules decimals() { return {.min = 0.0, .max = 9.0}; }

Section<NumberFormat> formatSection() {
    Section<NumberFormat> section("How numbers are written: decimals after the point.");
    section
        .field(
            "linear_decimals", &NumberFormat::linear_decimals,
            "Decimals of X, Y, Z and of other linear axes; 5 for finishing (Siemens five-axis manual 05/2009, p. 50).",
            decimals())
        .field("rotary_decimals", &NumberFormat::rotary_decimals, "Decimals of rotary axes.", decimals())
        .field("vector_decimals", &NumberFormat::vector_decimals,
               "Decimals of the direction components A3, B3, C3; fewer than 6 are felt in the surface.", decimals())
        .field("feed_decimals", &NumberFormat::feed_decimals, "Decimals of F.", decimals())
        .field("speed_decimals", &NumberFormat::speed_decimals, "Decimals of S.", decimals());
    return section;
}

void checkWorkOffset(const ControlDefinition& control, const TomlNode& table, Diagnostics& report) {
    if (isSettableFrame(control.work_offset)) return;
    report.error("control.work-offset",
                 fmt::format("\"{}\" is no settable frame of an 840D: G54 to G57, G505 to G599, or G500 for none",
                             control.work_offset),
                 table.whereKey("work_offset"));
}

void checkStartCodes(const ControlDefinition& control, const TomlNode& table, Diagnostics& report) {
    if (control.start_codes.size() > longest_start_codes)
        report.error("control.start-codes",
                     fmt::format("{} characters do not fit one block (at most {})", control.start_codes.size(),
                                 longest_start_codes),
                     table.whereKey("start_codes"));
    const bool printable = std::all_of(control.start_codes.begin(), control.start_codes.end(), [](char character) {
        return std::isprint(static_cast<unsigned char>(character)) != 0 && character != ';';
    });
    if (!printable)
        report.error("control.start-codes",
                     "these are the words of one block: no line ends, comments or special characters",
                     table.whereKey("start_codes"));
}

Section<ControlDefinition> makeControlSection() {
    Section<ControlDefinition> section("The control: which words it takes and how it moves between block ends.");
    section
        .choice<ControlDefinition::Kind>("kind", &ControlDefinition::kind,
                                         {{"sinumerik-840d", ControlDefinition::Kind::Sinumerik840D}},
                                         "The family of the control.")
        .field(
            "md21104_ori_ipo_with_g_code", &ControlDefinition::md21104_ori_ipo_with_g_code,
            "Machine datum MD21104 $MC_ORI_IPO_WITH_G_CODE. true: ORIVECT and ORIAXES decide how the orientation moves; "
            "false: ORIWKS and ORIMKS do, and ORIAXES does nothing.")
        .choice<ControlDefinition::Cycle832>(
            "cycle832", &ControlDefinition::cycle832,
            {{"none", ControlDefinition::Cycle832::None},
             {"up-to-4.4", ControlDefinition::Cycle832::UpTo44},
             {"from-4.5", ControlDefinition::Cycle832::From45}},
            "The form of CYCLE832 by software version: (tolerance, mode, 1) up to 4.4, "
            "(tolerance, mode, orientation tolerance) from 4.5; none leaves it out.")
        .field("cycle832_tolerance_mm", &ControlDefinition::cycle832_tolerance_mm,
               "Contour tolerance given to CYCLE832; the control may leave the programmed path by as much.",
               base::positive())
        .field("cycle832_orientation_tolerance_deg", &ControlDefinition::cycle832_orientation_tolerance_rad,
               "Orientation tolerance given to CYCLE832 from software 4.5; 0 gives none.", {.min = 0.0, .max = 90.0})
        .choice<ProgramForm>(
            "form", &ControlDefinition::form, programFormWords(),
            "How programs say where the tool is: traori-rotary (TRAORI, tip and rotary axes), traori-vectors "
            "(TRAORI, tip and A3 B3 C3), machine (no TRAORI: all axes, tool length and pivot resolved).")
        .field("start_codes", &ControlDefinition::start_codes,
               "The modal codes every program and operation starts from.")
        .field("work_offset", &ControlDefinition::work_offset,
               "The settable frame the programs run in: G54 to G57, G505 to G599, or G500 for none.")
        .field("block_number_step", &ControlDefinition::block_number_step,
               "Difference of successive block numbers; 0 writes none.", {.min = 0.0, .max = 1000.0})
        .field("retract_axis", &ControlDefinition::retract_axis,
               "The linear axis that goes home alone, before all others.")
        .field("block_number_max", &ControlDefinition::block_number_max,
               "Block numbers begin again behind it; N takes eight digits.", {.min = 1000.0, .max = 99999999.0})
        .field(
            "fgref_mm", &ControlDefinition::fgref_mm,
            "FGREF of the rotary axes: the radius at which they count in the feed of blocks that only turn. Absent: as "
            "the control has it (57.296 mm as delivered).",
            base::positive())
        .table("format", &ControlDefinition::format, formatSection())
        .table("sequence", &ControlDefinition::sequence, sequenceSection())
        .table("swivel", &ControlDefinition::swivel, swivelSection())
        .check(checkWorkOffset)
        .check(checkStartCodes);
    return section;
}

/// The part of the root that belongs to this room.
Section<MachineFile> makeRootSection() {
    Section<MachineFile> section("A machine file.");
    section.table("control", &MachineFile::control, controlSection()).sharesTable();
    return section;
}

const Section<MachineFile>& rootSection() {
    static const Section<MachineFile> section = makeRootSection();
    return section;
}

/// The machine's own field table, told that `control` stands beside it.
const Section<machine::MachineDefinition>& machineRootSection() {
    static const Section<machine::MachineDefinition> section = [] {
        Section<machine::MachineDefinition> shared = machine::machineSection();
        shared.sharesTable();
        return shared;
    }();
    return section;
}

std::string linearNames(const machine::MachineDefinition& machine) {
    std::string names;
    for (const auto& [name, axis] : machine.linear) names += (names.empty() ? "" : ", ") + name;
    return names.empty() ? "none" : names;
}

void checkHome(const MachineFile& file, const std::optional<TomlNode>& control, Diagnostics& report) {
    const auto sequence = control ? control->at("sequence") : std::nullopt;
    if (!sequence) return;
    const auto& machine = file.machine;
    for (const std::string& block : file.control.sequence.home)
        static_cast<void>(expandPlaceholders(block, [&](std::string_view name) {
            const std::string axis(name);
            if (axis != "retract_axis" && axis != "other_axes" && !machine.linear.contains(axis) &&
                !machine.rotary.contains(axis))
                report.error(
                    "control.sequence",
                    fmt::format("{{{}}} is no axis of this machine, nor {{retract_axis}} or {{other_axes}}", axis),
                    sequence->whereKey("home"));
            return std::string();
        }));
}

/// What needs both parts of the file.
void crossCheck(const MachineFile& file, const TomlNode& root, Diagnostics& report) {
    const auto control = root.at("control");
    checkHome(file, control, report);
    if (file.machine.linear.contains(file.control.retract_axis)) return;
    report.error("control.unknown-axis",
                 fmt::format("\"{}\" is no linear axis of this machine; it has: {}", file.control.retract_axis,
                             linearNames(file.machine)),
                 control ? control->whereKey("retract_axis") : root.whereKey("control.retract_axis"));
}

base::Result<MachineFile> readRoot(const base::TomlDocument& document) {
    Diagnostics report;
    const TomlNode root = document.root();
    MachineFile file = rootSection().read(root, report);
    file.machine = machineRootSection().read(root, report);
    base::reportUnknownKeys(root, {machineRootSection().describe(), rootSection().describe()}, report);
    if (!report.hasErrors()) crossCheck(file, root, report);
    if (report.hasErrors()) return base::fail(std::move(report));
    return file;
}

}  // namespace

const std::vector<std::pair<std::string, ProgramForm>>& programFormWords() {
    static const std::vector<std::pair<std::string, ProgramForm>> words = {
        {"traori-rotary", ProgramForm::TraoriRotary},
        {"traori-vectors", ProgramForm::TraoriVectors},
        {"machine", ProgramForm::Machine}};
    return words;
}

const base::Section<ControlDefinition>& controlSection() {
    static const Section<ControlDefinition> section = makeControlSection();
    return section;
}

base::Result<MachineFile> readMachineFile(const std::string& path) {
    const auto document = base::TomlDocument::readFile(path);
    if (!document) return base::fail(document.error());
    return readRoot(*document);
}

base::Result<MachineFile> parseMachineFile(std::string_view text, const std::string& file_name) {
    const auto document = base::TomlDocument::parse(text, file_name);
    if (!document) return base::fail(document.error());
    return readRoot(*document);
}

std::string toToml(const MachineFile& file) {
    base::ConfigPrinter out;
    machineRootSection().print(file.machine, out);
    rootSection().print(file, out);
    return out.text();
}

}  // namespace cusp::post
