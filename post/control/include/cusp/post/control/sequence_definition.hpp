// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The `[control.sequence]` and `[control.swivel]` tables: what stands around the motions, and in which order.
#pragma once

#include <cusp/base/toml_schema.hpp>

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::post {

/// Each entry is one block: `{name}` for what cusp knows how to write, or the words of a block as they are. The order of the
/// defaults is that of Siemens' own Sinumerik post.
struct SequenceDefinition {
    /// Comments at the head: {program}, {cl_file}, {cusp}, {machine}, {form}, {travel}.
    std::vector<std::string> header = {"{program}", "from {cl_file} by {cusp}", "machine: {machine}",
                                       "{form}; {travel}"};
    std::vector<std::string> program_start = {"{modal}", "{transformation_off}", "{home}"};
    std::vector<std::string> tool_change = {"{tool}", "M6"};
    /// From home, where the tool length is off, to the part.
    std::vector<std::string> approach = {"{smoothing}", "{work_offset}",   "D1", "{spindle}", "{coolant}",
                                         "{rotary}",    "{transformation}"};
    /// Where an operation begins with the tool at the part already: everything modal again.
    std::vector<std::string> operation = {"{modal}",   "{smoothing}",     "D1", "{work_offset}", "{spindle}",
                                          "{coolant}", "{transformation}"};
    /// From the part to home.
    std::vector<std::string> retract = {"{transformation_off}", "{spindle_off}", "{coolant_off}", "{home}"};
    std::vector<std::string> program_end = {"{smoothing_off}", "M30"};
    /// The blocks of `{home}`: {retract_axis} is the retract axis with its home position, {other_axes} are the others, and
    /// {X} is the axis X.
    std::vector<std::string> home = {"SUPA G0 {retract_axis} D0", "SUPA G0 {other_axes} D0"};
    /// Every operation goes home first and calls its tool again, rather than beginning at the part.
    bool operations_from_home = false;
    /// MSG lines name the operation on the screen.
    bool messages = true;
};

/// How planes are tilted by CYCLE800.
struct SwivelDefinition {
    bool available = true;
    std::string data_set;         ///< _TC: name of the swivel data set; empty: the only one
    std::int64_t retract = 0;     ///< _FR; 0: none, the tool stands at home
    std::int64_t status = 0;      ///< _ST; its last digit must stay 0: a new plane
    std::int64_t direction = -1;  ///< _DIR: which of the two solutions, −1 or 1
    std::int64_t display = 0;     ///< _DMODE
};

[[nodiscard]] const base::Section<SequenceDefinition>& sequenceSection();
[[nodiscard]] const base::Section<SwivelDefinition>& swivelSection();

/// `text` with every `{name}` replaced by what `value` answers for the name.
template <class Value>
[[nodiscard]] std::string expandPlaceholders(std::string_view text, const Value& value) {
    std::string out;
    while (true) {
        const std::size_t open = text.find('{');
        const std::size_t close = text.find('}', open == std::string_view::npos ? 0 : open);
        if (open == std::string_view::npos || close == std::string_view::npos) return out += text;
        out += text.substr(0, open);
        out += value(text.substr(open + 1, close - open - 1));
        text.remove_prefix(close + 1);
    }
}

}  // namespace cusp::post
