// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The field tables, and what a sequence must not leave out.
#include <cusp/post/control/sequence_definition.hpp>

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <initializer_list>

namespace cusp::post {

namespace {

using base::Diagnostics;
using base::Section;
using base::TomlNode;
using Blocks = std::vector<std::string>;
using Names = std::initializer_list<std::string_view>;

/// With a number, positions of all axes and the line end, within the 512 characters of a block.
constexpr std::size_t longest_block = 300;

bool contains(Names names, std::string_view name) { return std::find(names.begin(), names.end(), name) != names.end(); }

std::string listed(Names names) {
    std::string out;
    for (const std::string_view name : names) out += fmt::format("{}{{{}}}", out.empty() ? "" : ", ", name);
    return out;
}

struct Rule {
    const char* key;
    Blocks SequenceDefinition::* blocks;
    Names known;
    Names demanded;
};

void checkBlock(const std::string& block, const Rule& rule, const base::Location& where, Diagnostics& report) {
    const auto complain = [&](std::string text) { report.error("control.sequence", std::move(text), where); };
    const bool printable = std::all_of(block.begin(), block.end(),
                                       [](char c) { return std::isprint(static_cast<unsigned char>(c)) != 0; });
    if (block.empty() || block.size() > longest_block || !printable)
        return complain(fmt::format("a block has 1 to {} printable characters", longest_block));
    if (block.front() != '{') {
        if (block.find_first_of("{}") != std::string::npos)
            complain(fmt::format("\"{}\": a placeholder stands alone", block));
        return;
    }
    const std::string_view name = std::string_view(block).substr(1, block.size() - 2);
    if (block.back() != '}' || !contains(rule.known, name))
        complain(fmt::format("\"{}\" means nothing here; known are {}", block, listed(rule.known)));
}

void checkSequences(const SequenceDefinition& sequence, const TomlNode& table, Diagnostics& report) {
    static const std::initializer_list<Rule> rules = {
        {"program_start",
         &SequenceDefinition::program_start,
         {"modal", "transformation_off", "home"},
         {"modal", "home"}},
        {"tool_change", &SequenceDefinition::tool_change, {"tool"}, {"tool"}},
        {"approach",
         &SequenceDefinition::approach,
         {"modal", "smoothing", "work_offset", "spindle", "coolant", "rotary", "transformation"},
         {"work_offset", "spindle", "coolant", "rotary", "transformation"}},
        {"operation",
         &SequenceDefinition::operation,
         {"modal", "smoothing", "work_offset", "spindle", "coolant", "transformation"},
         {}},
        {"retract",
         &SequenceDefinition::retract,
         {"transformation_off", "spindle_off", "coolant_off", "smoothing_off", "home"},
         {"transformation_off", "spindle_off", "coolant_off", "home"}},
        {"program_end", &SequenceDefinition::program_end, {"smoothing_off", "home"}, {}}};
    for (const Rule& rule : rules) {
        const Blocks& blocks = sequence.*rule.blocks;
        for (const std::string& block : blocks) checkBlock(block, rule, table.whereKey(rule.key), report);
        for (const std::string_view name : rule.demanded)
            if (std::find(blocks.begin(), blocks.end(), fmt::format("{{{}}}", name)) == blocks.end())
                report.error("control.sequence", fmt::format("{{{}}} is missing", name), table.whereKey(rule.key));
    }
    const bool ends =
        std::any_of(sequence.program_end.begin(), sequence.program_end.end(),
                    [](const std::string& block) { return block == "M30" || block == "M2" || block == "M17"; });
    if (!ends)
        report.error("control.sequence", "a program ends with a block M30, M2 or M17", table.whereKey("program_end"));
    if (sequence.home.empty()) report.error("control.sequence", "the way home needs a block", table.whereKey("home"));
}

void checkSwivel(const SwivelDefinition& swivel, const TomlNode& table, Diagnostics& report) {
    if (swivel.direction != -1 && swivel.direction != 1)
        report.error("control.swivel", "the direction is -1 or 1: 0 would not turn the axes",
                     table.whereKey("direction"));
    if (swivel.status % 10 != 0)
        report.error("control.swivel", "the last digit of the status is 0: every plane is a new one",
                     table.whereKey("status"));
    const bool name = swivel.data_set.size() <= 31 &&
                      std::all_of(swivel.data_set.begin(), swivel.data_set.end(),
                                  [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; });
    if (!name)
        report.error("control.swivel", "a data set has at most 31 letters, digits, underscores",
                     table.whereKey("data_set"));
}

}  // namespace

const Section<SequenceDefinition>& sequenceSection() {
    static const Section<SequenceDefinition> section = [] {
        Section<SequenceDefinition> made(
            "What stands around the motions. Each entry is one block: {name} for what cusp knows how to write, or the words "
            "of a block as they are.");
        using Sequence = SequenceDefinition;
        made.field("header", &Sequence::header,
                   "Comments at the head of the program: {program}, {cl_file}, {cusp}, {machine}, {form}, {travel}.")
            .field("program_start", &Sequence::program_start, "{modal}, {transformation_off}, {home}.")
            .field("tool_change", &Sequence::tool_change, "{tool} is the T word.")
            .field(
                "approach", &Sequence::approach,
                "From home to the part: {smoothing}, {work_offset}, {spindle}, {coolant}, {rotary}, {transformation}, "
                "{modal}.")
            .field("operation", &Sequence::operation,
                   "Where an operation begins with the tool at the part: everything modal again. Placeholders as in "
                   "approach, but for {rotary}.")
            .field(
                "retract", &Sequence::retract,
                "From the part to home: {transformation_off}, {spindle_off}, {coolant_off}, {smoothing_off}, {home}.")
            .field("program_end", &Sequence::program_end, "{smoothing_off}, {home}, and M30, M2 or M17.")
            .field(
                "home", &Sequence::home,
                "The blocks of {home}: {retract_axis} and {other_axes} stand for axes and their home positions, {X} for "
                "the axis X.")
            .field("operations_from_home", &Sequence::operations_from_home,
                   "Every operation goes home first and calls its tool again, so that it can be started by itself.")
            .field("messages", &Sequence::messages, "MSG lines name the operation on the screen.")
            .check(checkSequences);
        return made;
    }();
    return section;
}

const Section<SwivelDefinition>& swivelSection() {
    static const Section<SwivelDefinition> section = [] {
        Section<SwivelDefinition> made("Tilted planes: CYCLE800, mode 57 (turns about X, Y, Z).");
        made.field(
                "available", &SwivelDefinition::available,
                "false: the machine has no CYCLE800; what needs a tilted plane is cut in straight moves, or refused.")
            .field("data_set", &SwivelDefinition::data_set,
                   "_TC, the name of the swivel data set; empty: the only one.")
            .field("retract", &SwivelDefinition::retract,
                   "_FR, the retraction before turning; 0: none, the tool is at home.", {.min = 0.0, .max = 8.0})
            .field("status", &SwivelDefinition::status, "_ST; the last digit is 0.", {.min = 0.0, .max = 9999999.0})
            .field("direction", &SwivelDefinition::direction,
                   "_DIR, -1 or 1: which of the two positions of the rotary axes the control takes.",
                   {.min = -1.0, .max = 1.0})
            .field("display", &SwivelDefinition::display, "_DMODE.", {.min = 0.0, .max = 99999.0})
            .check(checkSwivel);
        return made;
    }();
    return section;
}

}  // namespace cusp::post
