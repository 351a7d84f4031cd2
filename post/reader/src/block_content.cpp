// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Sorting words by meaning; whatever has none here is named with its place.
#include "block_content.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace cusp::post::reader {

namespace {

constexpr std::size_t most_m_functions = 5;

std::size_t axisIndex(std::string_view letter, std::string_view letters) { return letters.find(letter.front()); }

std::string axisNames(const ForwardChain& chain) {
    std::string names = "X, Y, Z";
    for (std::size_t i = 0; i < chain.rotaryCount(); ++i) names += ", " + chain.rotaryName(i);
    return names;
}

/// "M1" → 1; nothing when the rest is no number.
std::optional<int> extensionOf(std::string_view name) {
    int number = 0;
    const char* const end = name.data() + name.size();
    const auto [stop, problem] = std::from_chars(name.data() + 1, end, number);
    if (problem != std::errc{} || stop != end) return std::nullopt;
    return number;
}

std::optional<FrameCommand> frameCommand(std::string_view name) {
    if (name == "TRANS") return FrameCommand::Trans;
    if (name == "ATRANS") return FrameCommand::ATrans;
    if (name == "ROT") return FrameCommand::Rot;
    if (name == "AROT") return FrameCommand::ARot;
    return std::nullopt;
}

}  // namespace

void ContentReader::error(std::string_view code, std::string message, std::size_t column) {
    report_.error(code, std::move(message), block_->at(column));
}

void ContentReader::refuse(std::string_view word, std::string_view what, std::size_t column) {
    error("nc.unsupported", fmt::format("{} ({}) is not interpreted", word, what), column);
}

void ContentReader::repeated(const Word& word) {
    error("nc.repeated-address", fmt::format("{} stands twice in this block", word.name), word.column);
}

BlockContent ContentReader::read(const Block& block) {
    block_ = &block;
    out_ = BlockContent{};
    for (const Word& word : block.words) {
        switch (word.kind) {
            case WordKind::Code: code(word); break;
            case WordKind::Value: value(word); break;
            case WordKind::Indexed: indexed(word); break;
            case WordKind::Keyword: keyword(word); break;
            case WordKind::Call: call(word); break;
            case WordKind::Statement: statement(word); break;
        }
    }
    if (out_.m_functions.size() > most_m_functions)
        error("nc.too-many-m",
              fmt::format("{} M functions stand in this block; the control takes {}", out_.m_functions.size(),
                          most_m_functions),
              block.words.front().column);
    return std::move(out_);
}

void ContentReader::addCode(const GroupCode& added, std::size_t column) {
    for (const GroupCode& other : out_.codes)
        if (other.group == added.group)
            error("nc.same-group",
                  fmt::format("{} and {} belong to one G group ({}): only one may stand in a block", other.name,
                              added.name, added.group),
                  column);
    out_.codes.push_back(added);
}

void ContentReader::code(const Word& word) {
    if (word.name == "M") return mFunction(word.number, word.column);
    if (word.number == 4) {
        out_.dwell = true;
        return;
    }
    if (const auto found = findGroupCode(word.number)) return addCode(*found, word.column);
    const std::string name = fmt::format("G{}", word.number);
    if (const auto what = refusedCode(word.number); !what.empty()) return refuse(name, what, word.column);
    error("nc.unknown-word", fmt::format("{} is no G code of the 840D that is known here", name), word.column);
}

void ContentReader::mFunction(int number, std::size_t column) {
    static constexpr int known[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 17, 30};
    const bool gear_stage = number >= 40 && number <= 45;
    if (number == 19 || number == 70) return refuse(fmt::format("M{}", number), "spindle positioning", column);
    out_.m_functions.push_back(number);
    if (gear_stage || std::find(std::begin(known), std::end(known), number) != std::end(known)) return;
    if (!machine_functions_seen_.insert(number).second) return;
    std::string message = fmt::format("M{} belongs to the machine builder; what it does is not known here", number);
    if (options_.strict)
        error("nc.machine-function", std::move(message), column);
    else
        report_.warning("nc.machine-function", std::move(message), block_->at(column));
}

void ContentReader::keyword(const Word& word) {
    if (word.name == "TRAORI" || word.name == "TRAFOOF") {
        if (out_.transformation) return repeated(word);
        out_.transformation = word.name == "TRAORI";
        return;
    }
    if (word.name == "STOPRE") return;
    if (const auto command = frameCommand(word.name)) {
        if (out_.frame) return repeated(word);
        out_.frame = command;
        return;
    }
    if (word.name == "MCALL") {
        out_.modal_call = true;
        return;
    }
    if (word.name == "TRAOOF")
        return error("nc.misspelled", "TRAOOF is a misspelling of TRAFOOF: the transformation would stay active",
                     word.column);
    if (const auto found = findGroupCode(word.name)) return addCode(*found, word.column);
    if (const auto what = refusedWord(word.name); !what.empty()) return refuse(word.name, what, word.column);
    error("nc.unknown-word",
          fmt::format("{} is not known here; if it is a subprogram, its call is not interpreted", word.name),
          word.column);
}

void ContentReader::call(const Word& word) {
    const bool empty = word.first == word.last;
    if (word.name == "MSG") {
        const bool plain = word.last == word.first + 1 && block_->tokens[word.first].kind == TokenKind::Text;
        out_.message = plain ? std::string(block_->tokens[word.first].text) : block_->textOf(word.first, word.last);
        return;
    }
    if (word.name == "CYCLE832") return highSpeed(word);
    if (hasNoEffect(word.name)) return;
    if (word.name == "CYCLE800") return swivel(word);
    if (isDrillingCycle(word.name)) return drillingCycle(word);
    if (word.name == "SETMS" || word.name == "TRAORI") {
        const auto argument = empty ? std::optional<double>(1.0) : number(word);
        if (argument && *argument != 1.0)
            refuse(block_->textOf(word.first - 2, word.last + 1), "another spindle or transformation than the first",
                   word.column);
        if (word.name == "TRAORI") out_.transformation = true;
        return;
    }
    if (const auto what = refusedWord(word.name); !what.empty()) return refuse(word.name, what, word.column);
    error("nc.unknown-word",
          fmt::format("{}(…) is not known here; if it is a subprogram, its call is not interpreted", word.name),
          word.column);
}

/// CYCLE832 sets what the control may deviate by; the programmed geometry, which is what is read here, stays.
void ContentReader::highSpeed(const Word& word) {
    out_.high_speed.emplace();
    if (word.first == word.last) return;
    for (const auto& [first, last] : splitAtCommas(*block_, word.first, word.last)) {
        const bool name = last == first + 1 && block_->tokens[first].kind == TokenKind::Name &&
                          block_->tokens[first].text.starts_with("_");
        if (!name && first != last) static_cast<void>(evaluate(*block_, first, last, variables_, report_));
        out_.high_speed->push_back(first == last ? std::string() : block_->textOf(first, last));
    }
}

void ContentReader::indexed(const Word& word) {
    if (word.name == "FGREF") return;  // weighs rotary axes in the path feed; no bearing on where the tool goes
    refuse(fmt::format("{}[…]", word.name), "an indexed word", word.column);
}

void ContentReader::statement(const Word& word) {
    if (word.name == "DEF") return declare(word);
    refuse(word.name, refusedWord(word.name), word.column);
}

void ContentReader::declare(const Word& word) {
    const Token& type = block_->tokens[word.first];
    const bool integer = type.text == "INT" || type.text == "BOOL";
    if (!integer && type.text != "REAL")
        return refuse("DEF " + std::string(type.text), "a variable that is no number", word.column);
    for (const auto& [first, last] : splitAtCommas(*block_, word.first + 1, word.last)) {
        const Token& name = block_->tokens[first];
        const bool assigned = first + 1 < last && block_->tokens[first + 1].is("=");
        if (first == last || name.kind != TokenKind::Name || (first + 1 != last && !assigned)) {
            error("nc.syntax", "DEF takes names of at least two characters, with \"= value\" or without", name.column);
            continue;
        }
        if (!variables_.declare(name.text, integer))
            error("nc.declared-twice", fmt::format("{} is declared already", name.text), name.column);
        if (!assigned) continue;
        if (const auto initial = evaluate(*block_, first + 2, last, variables_, report_))
            variables_.set(name.text, *initial);
    }
}

void ContentReader::value(const Word& word) {
    if (axisValue(word)) return;
    if (word.name.size() == 1 ? singleLetterValue(word) : (extendedValue(word) || namedValue(word))) return;
    if (const auto what = refusedAddress(word.name); !what.empty()) return refuse(word.name, what, word.column);
    error("nc.unknown-word",
          fmt::format("{} is neither an address that is known here nor a declared variable", word.name), word.column);
}

bool ContentReader::axisValue(const Word& word) {
    for (std::size_t i = 0; i < chain_.rotaryCount(); ++i)
        if (word.name == chain_.rotaryName(i)) {
            setTarget(out_.rotary[i], word);
            return true;
        }
    if (word.name == "X" || word.name == "Y" || word.name == "Z") {
        setTarget(out_.linear[axisIndex(word.name, "XYZ")], word);
        return true;
    }
    if (machine_.linear.contains(std::string(word.name))) {
        refuse(word.name, "a machine axis that is no geometry axis", word.column);
        return true;
    }
    static constexpr std::string_view axis_letters = "ABCUVWQ";
    if (word.name.size() != 1 || axis_letters.find(word.name.front()) == std::string_view::npos) return false;
    error("nc.unknown-axis", fmt::format("this machine has no axis {}; it has {}", word.name, axisNames(chain_)),
          word.column);
    return true;
}

bool ContentReader::singleLetterValue(const Word& word) {
    switch (word.name.front()) {
        case 'I':
        case 'J':
        case 'K': setTarget(out_.center[axisIndex(word.name, "IJK")], word); return true;
        case 'F': setNumber(out_.feed, word); return true;
        case 'S': setNumber(out_.speed, word); return true;
        case 'D': setNumber(out_.cutting_edge, word); return true;
        case 'T': toolValue(word); return true;
        case 'H':
            report_.warning("nc.machine-function",
                            "H functions belong to the machine builder; what this one does is not known here",
                            block_->at(word.column));
            return true;
        default: return false;
    }
}

/// Addresses of one letter and a number: R1=, A3=, M1=, S1=.
bool ContentReader::extendedValue(const Word& word) {
    const auto extension = extensionOf(word.name);
    if (!extension) return false;
    const char letter = word.name.front();
    if (letter == 'R') {
        if (const auto result = number(word)) variables_.setParameter(*extension, *result);
        return true;
    }
    if ((*extension == 3 || *extension == 2) && (letter == 'A' || letter == 'B' || letter == 'C')) {
        auto& values = *extension == 3 ? out_.vector : out_.angles_deg;
        setNumber(values[axisIndex(word.name, "ABC")], word);
        return true;
    }
    if (*extension == 1 && (letter == 'I' || letter == 'J' || letter == 'K')) {
        setTarget(out_.through[axisIndex(word.name, "IJK")], word);
        return true;
    }
    if (letter != 'M' && letter != 'S') return false;
    if (*extension != 1) {
        refuse(word.name, "another spindle than the first", word.column);
        return true;
    }
    if (letter == 'S')
        setNumber(out_.speed, word);
    else if (const auto function = number(word))
        mFunction(static_cast<int>(std::clamp(*function, 0.0, 9999.0)), word.column);
    return true;
}

bool ContentReader::namedValue(const Word& word) {
    if (word.name == "CR")
        setNumber(out_.radius, word);
    else if (word.name == "AR")
        setNumber(out_.arc_angle_deg, word);
    else if (word.name == "TURN")
        setNumber(out_.turns, word);
    else if (word.name == "RPL")
        setNumber(out_.plane_angle_deg, word);
    else if (word.name == "CTOL")
        setNumber(out_.contour_tolerance, word);
    else if (word.name == "OTOL")
        setNumber(out_.orientation_tolerance_deg, word);
    else if (word.name == "ADIS" || word.name == "ADISPOS")
        static_cast<void>(number(word));  // ways of smoothing: the programmed geometry stays
    else if (variables_.isDeclared(word.name)) {
        if (const auto result = number(word)) variables_.set(word.name, *result);
    } else
        return false;
    return true;
}

void ContentReader::toolValue(const Word& word) {
    if (out_.tool) return repeated(word);
    if (word.last == word.first + 1 && block_->tokens[word.first].kind == TokenKind::Text) {
        out_.tool = std::string(block_->tokens[word.first].text);
        return;
    }
    const auto result = number(word);
    if (!result) return;
    if (*result < 0.0 || *result > 99'999'999.0 || *result != std::floor(*result))
        return error("nc.tool", "a tool number is a whole number of up to eight digits", word.column);
    out_.tool = fmt::format("{}", static_cast<long long>(*result));
}

std::optional<double> ContentReader::number(const Word& word) {
    return evaluate(*block_, word.first, word.last, variables_, report_);
}

void ContentReader::setNumber(std::optional<double>& slot, const Word& word) {
    if (slot) return repeated(word);
    slot = number(word);
}

/// A coordinate, plain or as AC(…), IC(…), DC(…).
void ContentReader::setTarget(std::optional<AxisTarget>& slot, const Word& word) {
    if (slot) return repeated(word);
    using Mode = AxisTarget::Mode;
    static constexpr std::pair<std::string_view, Mode> modes[] = {
        {"AC", Mode::Absolute}, {"IC", Mode::Incremental}, {"DC", Mode::ShortestWay}};
    const std::string_view first = block_->tokens[word.first].text;
    const bool wrapped = block_->tokens[word.first].kind == TokenKind::Name && word.last > word.first + 2 &&
                         block_->tokens[word.first + 1].is("(");
    if (wrapped && (first == "ACP" || first == "ACN")) return refuse(first, "travel in a given direction", word.column);
    AxisTarget target;
    std::size_t begin = word.first;
    for (const auto& [name, mode] : modes)
        if (wrapped && first == name) {
            target.mode = mode;
            ++begin;
        }
    if (const auto result = evaluate(*block_, begin, word.last, variables_, report_)) {
        target.value = *result;
        slot = target;
    }
}

}  // namespace cusp::post::reader
