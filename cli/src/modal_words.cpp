// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Tables of modal words (840D sl programming manual, lists of G functions), and a scanner that needs no more than words.
#include "modal_words.hpp"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <set>
#include <utility>

namespace cusp::cli {

namespace {

using Table = std::map<std::string, std::string, std::less<>>;

/// G code or keyword to its group; "-" acts in its block only or moves nothing that a preamble must repeat.
const Table& groups() {
    static const Table table{
        {"G0", "motion"},
        {"G1", "motion"},
        {"G2", "motion"},
        {"G3", "motion"},
        {"CIP", "motion"},
        {"G4", "-"},
        {"G9", "-"},
        {"G53", "-"},
        {"G153", "-"},
        {"SUPA", "-"},
        {"G74", "-"},
        {"G75", "-"},
        {"G17", "plane"},
        {"G18", "plane"},
        {"G19", "plane"},
        {"G70", "units"},
        {"G71", "units"},
        {"G700", "units"},
        {"G710", "units"},
        {"G90", "dimensions"},
        {"G91", "dimensions"},
        {"G93", "feed-mode"},
        {"G94", "feed-mode"},
        {"G95", "feed-mode"},
        {"G97", "speed-mode"},
        {"G40", "compensation"},
        {"G41", "compensation"},
        {"G42", "compensation"},
        {"G60", "stop"},
        {"G64", "stop"},
        {"G641", "stop"},
        {"G642", "stop"},
        {"G643", "stop"},
        {"G644", "stop"},
        {"G645", "stop"},
        {"G601", "stop-window"},
        {"G602", "stop-window"},
        {"G603", "stop-window"},
        {"G54", "offset"},
        {"G55", "offset"},
        {"G56", "offset"},
        {"G57", "offset"},
        {"G500", "offset"},
        {"G450", "corners"},
        {"G451", "corners"},
        {"ORIWKS", "orientation-frame"},
        {"ORIMKS", "orientation-frame"},
        {"ORIAXES", "orientation"},
        {"ORIVECT", "orientation"},
        {"ORIPLANE", "orientation"},
        {"ORIEULER", "orientation-angles"},
        {"ORIRPY", "orientation-angles"},
        {"TRAORI", "transformation"},
        {"TRAFOOF", "transformation"},
        {"FFWON", "feed-forward"},
        {"FFWOF", "feed-forward"},
        {"BRISK", "jerk"},
        {"SOFT", "jerk"},
        {"DRIVE", "jerk"},
        {"COMPOF", "compressor"},
        {"COMPON", "compressor"},
        {"COMPCURV", "compressor"},
        {"COMPCAD", "compressor"},
        {"COMPSURF", "compressor"},
        {"CUT2D", "cut"},
        {"CUT2DF", "cut"},
        {"CUT3DC", "cut"},
        {"CUT3DF", "cut"},
        {"CUT3DFS", "cut"},
        {"NORM", "approach"},
        {"KONT", "approach"},
        {"UPATH", "path"},
        {"SPATH", "path"},
        {"FIFOCTRL", "fifo"},
        {"STARTFIFO", "fifo"},
        {"STOPFIFO", "fifo"},
        {"CFC", "feed-control"},
        {"CFTCP", "feed-control"},
        {"CFIN", "feed-control"},
        {"WALIMON", "area"},
        {"WALIMOF", "area"},
        {"DIAMOF", "diameter"},
        {"MSG", "-"},
        {"STOPRE", "-"},
        {"WORKPIECE", "-"},
        {"CYCLE832", "CYCLE832"},
        {"CTOL", "CTOL"},
        {"OTOL", "OTOL"},
        {"T", "T"},
        {"D", "D"},
        {"F", "F"},
        {"S", "S"},
    };
    return table;
}

/// Groups the preamble says at a place of their own.
const std::set<std::string, std::less<>>& placed() {
    static const std::set<std::string, std::less<>> names{"motion",
                                                          "plane",
                                                          "units",
                                                          "dimensions",
                                                          "feed-mode",
                                                          "stop",
                                                          "stop-window",
                                                          "offset",
                                                          "orientation-frame",
                                                          "orientation",
                                                          "transformation",
                                                          "compensation",
                                                          "CYCLE832",
                                                          "CTOL",
                                                          "OTOL",
                                                          "T",
                                                          "D",
                                                          "F",
                                                          "S",
                                                          "spindle",
                                                          "mist",
                                                          "flood"};
    return names;
}

/// What lies between the ends of a move says nothing to the next one.
bool isMoveWord(const std::string& name) {
    static const std::set<std::string, std::less<>> names{"X",  "Y",  "Z",  "A",   "B",    "C",   "I",   "J",  "K",
                                                          "A2", "B2", "C2", "A3",  "B3",   "C3",  "CR",  "AR", "TURN",
                                                          "I1", "J1", "K1", "RND", "RNDM", "CHF", "CHR", "FRC"};
    return names.contains(name);
}

bool isSettableOffset(const std::string& text) {
    return text.size() == 4 && text.starts_with("G5") && text != "G500" && text >= "G505" && text <= "G599";
}

std::string upper(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return out;
}

bool letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '$'; }
bool digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool numeric(char c) { return digit(c) || c == '.' || c == '-' || c == '+'; }

/// The end of what stands in brackets or quotes from `at` on.
std::size_t closed(std::string_view line, std::size_t at) {
    int depth = 0;
    bool quoted = false;
    for (; at < line.size(); ++at) {
        if (line[at] == '"') quoted = !quoted;
        if (quoted) continue;
        if (line[at] == '(') ++depth;
        if (line[at] == ')') --depth;
        if (depth == 0) return at + 1;
    }
    return line.size();
}

}  // namespace

std::vector<NcWord> wordsOf(std::string_view line) {
    std::vector<NcWord> out;
    std::size_t at = 0;
    while (at < line.size() && line[at] != ';') {
        if (!letter(line[at])) {
            if (line[at] != ' ' && line[at] != '\t' && line[at] != '/' && line[at] != '\r')
                out.push_back({std::string(1, line[at]), "", std::string(1, line[at])});
            ++at;
            continue;
        }
        const std::size_t begin = at;
        while (at < line.size() && letter(line[at])) ++at;
        // A letter and digits are an address and its value, unless "=" or a bracket makes the digits part of the name.
        std::size_t name_end = at;
        while (name_end < line.size() && digit(line[name_end])) ++name_end;
        const char next = name_end < line.size() ? line[name_end] : ' ';
        const bool long_name = at - begin > 1 || next == '=' || next == '(' || next == '[';
        if (long_name) at = name_end;
        NcWord word{upper(line.substr(begin, at - begin)), "", ""};
        std::size_t value = at;
        if (at < line.size() && (line[at] == '=' || line[at] == '(')) {
            if (line[at] == '=') ++value;
            at = value;
            if (at < line.size() && (line[at] == '"' || line[at] == '('))
                at = closed(line, at);
            else
                while (at < line.size() && !std::isspace(static_cast<unsigned char>(line[at])) && line[at] != ';') ++at;
        } else if (!long_name) {
            while (at < line.size() && numeric(line[at])) ++at;
        }
        word.value = line.substr(value, at - value);
        word.text = line.substr(begin, at - begin);
        const bool is_number = word.name == "N" && out.empty();
        if (!is_number) out.push_back(std::move(word));
    }
    return out;
}

std::string ModalWords::last(const std::string& group) const {
    const auto found = last_.find(group);
    return found == last_.end() ? std::string() : found->second;
}

std::string ModalWords::others() const {
    std::string out;
    for (const auto& [group, text] : last_)
        if (!placed().contains(group)) out += (out.empty() ? "" : " ") + text;
    return out;
}

std::string ModalWords::takeG(const NcWord& word) {
    std::string code = "G" + word.value;
    if (code.size() == 3 && code[1] == '0') code.erase(1, 1);  // G01
    if (isSettableOffset(code)) {
        last_["offset"] = code;
        return {};
    }
    const auto found = groups().find(code);
    if (found == groups().end()) return fmt::format("{} is not known here", code);
    if (found->second != "-") last_[found->second] = code;
    return {};
}

std::string ModalWords::takeM(const NcWord& word) {
    static const std::set<std::string, std::less<>> passing{"0", "1", "00", "01", "2", "02", "30", "17"};
    std::string number = word.value;
    if (number.size() == 2 && number[0] == '0') number.erase(0, 1);
    if (passing.contains(word.value)) return {};
    if (number == "3" || number == "4" || number == "5")
        last_["spindle"] = "M" + number;
    else if (number == "7")
        last_["mist"] = "M7";
    else if (number == "8")
        last_["flood"] = "M8";
    else if (number == "9")
        last_["mist"] = last_["flood"] = "";
    else if (number == "6")
        tool_changed_ = true;
    else
        return fmt::format("M{} belongs to the machine builder", number);
    return {};
}

std::string ModalWords::takeWord(const NcWord& word) {
    if (isMoveWord(word.name)) return {};
    if (word.name == "G") return takeG(word);
    if (word.name == "M") return takeM(word);
    const auto found = groups().find(word.name);
    if (found == groups().end()) return fmt::format("{} cannot be repeated", word.text);
    if (found->second == "-") return {};
    last_[found->second] = word.text;
    if (word.name == "T") tool_changed_ = false;
    return {};
}

std::string ModalWords::take(std::string_view line) {
    for (const NcWord& word : wordsOf(line)) {
        if (word.name == "%") return {};
        if (std::string wrong = takeWord(word); !wrong.empty()) return wrong;
    }
    return {};
}

bool ModalWords::onlyMoves(std::string_view line) {
    const std::vector<NcWord> words = wordsOf(line);
    return !words.empty() && std::ranges::all_of(words, [](const NcWord& word) {
        if (word.name == "G") return word.value.size() == 1 && word.value[0] <= '3';
        return isMoveWord(word.name) || word.name == "F";
    });
}

}  // namespace cusp::cli
