// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The arguments of CYCLE800 and of the drilling cycles.
#include "block_content.hpp"

#include <cmath>
#include <fmt/format.h>

namespace cusp::post::reader {

namespace {

/// _FR, _TC, _ST, _MODE, X0, Y0, Z0, A, B, C, X1, Y1, Z1, _DIR, _FR_I, _DMODE
constexpr std::size_t swivel_arguments = 16;

}  // namespace

/// A text counts as given, with the value 0.
std::optional<CycleArguments> ContentReader::arguments(const Word& word) {
    CycleArguments values;
    if (word.first == word.last) return values;
    for (const auto& [first, last] : splitAtCommas(*block_, word.first, word.last)) {
        values.emplace_back();
        if (first == last) continue;
        if (last == first + 1 && block_->tokens[first].kind == TokenKind::Text) {
            values.back() = 0.0;
            continue;
        }
        values.back() = evaluate(*block_, first, last, variables_, report_);
        if (!values.back()) return std::nullopt;
    }
    return values;
}

/// _MODE below 64 turns axis by axis; its pairs of bits, lowest first, name the axes in the order they turn, each about
/// the axis as the ones before left it: 57 is X, Y, Z; 27 is Z, Y, X; 39 is Z, X, Y.
void ContentReader::swivel(const Word& word) {
    const auto given = arguments(word);
    if (!given) return;
    Swivel swivel;
    const auto at = [&](std::size_t index) { return index < given->size() ? (*given)[index].value_or(0.0) : 0.0; };
    const bool deselected = given->size() >= 2 && word.first + 2 < word.last &&
                            block_->tokens[word.first + 2].kind == TokenKind::Text &&
                            block_->tokens[word.first + 2].text == "0";
    swivel.clear = given->empty() || deselected;
    if (swivel.clear) {
        out_.swivel = swivel;
        return;
    }
    if (given->size() > swivel_arguments)
        return error("nc.cycle", fmt::format("CYCLE800 takes {} arguments", swivel_arguments), word.column);
    const double mode = at(3);
    const double status = std::fmod(std::abs(at(2)), 10.0);
    if (mode < 0.0 || mode >= 64.0 || mode != std::floor(mode))
        return refuse(fmt::format("CYCLE800 with _MODE {:g}", mode), "angles other than axis by axis", word.column);
    if (status != 0.0 && status != 1.0)
        return refuse(fmt::format("CYCLE800 with _ST {:g}", at(2)), "a plane neither new nor additive", word.column);
    for (std::size_t turn = 0; turn < 3; ++turn) {
        const auto axis = static_cast<std::size_t>(static_cast<unsigned>(mode) >> (2 * turn)) & 3U;
        if (axis == 0 && at(7 + turn) != 0.0)
            return error("nc.cycle", fmt::format("_MODE {:g} of CYCLE800 names no axis for turn {}", mode, turn + 1),
                         word.column);
        swivel.order[turn] = axis == 0 ? turn : axis - 1;
        swivel.before[turn] = at(4 + turn);
        swivel.angles_deg[turn] = at(7 + turn);
        swivel.after[turn] = at(10 + turn);
    }
    swivel.additive = status == 1.0;
    swivel.moves = at(13) != 0.0;
    out_.swivel = swivel;
}

void ContentReader::drillingCycle(const Word& word) {
    const auto given = arguments(word);
    if (!given) return;
    std::string problem;
    auto steps = drillingSteps(word.name, *given, problem);
    if (!steps) return error("nc.cycle", fmt::format("{}: {}", word.name, problem), word.column);
    out_.cycle = CycleCall{*std::move(steps)};
}

}  // namespace cusp::post::reader
