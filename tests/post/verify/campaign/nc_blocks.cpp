// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Spelling.
#include "nc_blocks.hpp"

#include <algorithm>
#include <fmt/format.h>

namespace cusp::post::verify::test {

bool NcBlock::has(std::string_view address) const {
    return std::any_of(words.begin(), words.end(), [&](const NcWord& word) { return word.address == address; });
}

bool NcBlock::has(std::string_view address, double value) const {
    return std::any_of(words.begin(), words.end(),
                       [&](const NcWord& word) { return word.address == address && word.value == value; });
}

std::optional<double> NcBlock::value(std::string_view address) const {
    for (const NcWord& word : words)
        if (word.address == address) return word.value;
    return std::nullopt;
}

std::string toText(const NcBlock& block) {
    std::string text;
    for (const NcWord& word : block.words) {
        if (!text.empty()) text += ' ';
        text += word.address;
        if (!word.value) continue;
        if (word.address.size() > 1) text += '=';
        text += fmt::format("{:.{}f}", *word.value, word.decimals);
    }
    if (block.cycle.empty()) return text;
    if (!text.empty()) text += ' ';
    text += block.cycle + '(';
    for (std::size_t i = 0; i < block.arguments.size(); ++i) {
        if (i > 0) text += ',';
        if (!block.arguments[i]) continue;
        text +=
            block.cycle == "CYCLE800" && i == 1 ? std::string("\"TC\"") : fmt::format("{:.5f}", *block.arguments[i]);
    }
    return text + ')';
}

std::string toText(const std::vector<NcBlock>& blocks) {
    std::string text;
    for (std::size_t i = 0; i < blocks.size(); ++i) text += fmt::format("N{} {}\n", 10 * (i + 1), toText(blocks[i]));
    return text;
}

}  // namespace cusp::post::verify::test
