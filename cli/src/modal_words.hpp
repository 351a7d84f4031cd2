// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The modal words of a program's lines as they were last said, by group.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::cli {

/// One word of a block: "G1", "X12.5", "A3=0.1", "CYCLE832(0.01,_ORI_FINISH,0.1)", "T=\"BALL\"".
struct NcWord {
    std::string name;   ///< letters and the digits that belong to a keyword: "X", "A3", "G", "CYCLE832"
    std::string value;  ///< "12.5", "(0.01,…)", "\"BALL\"", or empty
    std::string text;   ///< as written
};

/// The words of a line without comment, block number and skip sign.
[[nodiscard]] std::vector<NcWord> wordsOf(std::string_view line);

class ModalWords {
public:
    /// Takes a line in. What is wrong with it for a resume, or empty.
    [[nodiscard]] std::string take(std::string_view line);
    /// As last written; empty when the group was never spoken of. Groups: "motion", "plane", "units", "dimensions",
    /// "feed-mode", "stop", "stop-window", "offset", "orientation-frame", "orientation", "transformation", "compensation",
    /// "CYCLE832", "CTOL", "OTOL", "T", "D", "F", "S", "spindle", "mist", "flood", and others that only need repeating.
    [[nodiscard]] std::string last(const std::string& group) const;
    /// Groups that only need repeating, in one line.
    [[nodiscard]] std::string others() const;
    /// A tool was called and changed.
    [[nodiscard]] bool toolChanged() const { return tool_changed_; }
    /// The line only moves: axis words, feed, G0 to G3.
    [[nodiscard]] static bool onlyMoves(std::string_view line);

private:
    [[nodiscard]] std::string takeWord(const NcWord& word);
    [[nodiscard]] std::string takeG(const NcWord& word);
    [[nodiscard]] std::string takeM(const NcWord& word);

    std::map<std::string, std::string> last_;
    bool tool_changed_ = false;
};

}  // namespace cusp::cli
