// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Every harm changes words or blocks, never text, and no link; whether it does harm is for the paper machine to say.
#include "harms.hpp"

#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace cusp::post::verify::test {

namespace {

using Blocks = std::vector<NcBlock>;
using Change = std::function<double(double value, base::Random& random)>;

/// Positions that fit, one of them drawn.
template <class Fits>
std::optional<std::size_t> pick(std::size_t count, base::Random& random, const Fits& fits) {
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < count; ++i)
        if (fits(i)) places.push_back(i);
    if (places.empty()) return std::nullopt;
    return places[static_cast<std::size_t>(random.below(places.size()))];
}

NcWord* pickWord(Blocks& blocks, base::Random& random, const std::function<bool(const NcBlock&, const NcWord&)>& fits) {
    std::vector<NcWord*> places;
    for (NcBlock& block : blocks)
        for (NcWord& word : block.words)
            if (fits(block, word)) places.push_back(&word);
    return places.empty() ? nullptr : places[static_cast<std::size_t>(random.below(places.size()))];
}

Harm value(std::string name, std::string address, Change change) {
    return {std::move(name), [=](DrawnProgram& program, base::Random& random) {
                NcWord* word = pickWord(program.blocks, random, [&](const NcBlock& block, const NcWord& candidate) {
                    return !block.link && candidate.address == address && candidate.value;
                });
                if (word == nullptr) return false;
                const double before = *word->value;
                word->value = change(before, random);
                return *word->value != before;
            }};
}

Harm replaced(const std::string& address, double from, double to) {
    return {fmt::format("{0}{1:.0f} to {0}{2:.0f}", address, from, to),
            [=](DrawnProgram& program, base::Random& random) {
                NcWord* word = pickWord(program.blocks, random, [&](const NcBlock& block, const NcWord& candidate) {
                    return !block.link && candidate.address == address && candidate.value == from;
                });
                if (word != nullptr) word->value = to;
                return word != nullptr;
            }};
}

Harm renamed(const std::string& from, const std::string& to) {
    return {fmt::format("{} to {}", from, to), [=](DrawnProgram& program, base::Random& random) {
                NcWord* word = pickWord(program.blocks, random, [&](const NcBlock& block, const NcWord& candidate) {
                    return !block.link && candidate.address == from;
                });
                if (word != nullptr) word->address = to;
                return word != nullptr;
            }};
}

/// Takes a word out: one of this address, or with this value as well.
Harm lost(const std::string& address, std::optional<double> with = std::nullopt) {
    return {fmt::format("lost {}{}", address, with ? fmt::format("{:.0f}", *with) : std::string()),
            [=](DrawnProgram& program, base::Random& random) {
                const auto fits = [&](const NcWord& word) {
                    return word.address == address && (!with || word.value == with);
                };
                const auto at = pick(program.blocks.size(), random, [&](std::size_t i) {
                    const auto& words = program.blocks[i].words;
                    return !program.blocks[i].link && std::any_of(words.begin(), words.end(), fits);
                });
                if (!at) return false;
                auto& words = program.blocks[*at].words;
                words.erase(std::find_if(words.begin(), words.end(), fits));
                return true;
            }};
}

Change negate() {
    return [](double v, base::Random&) { return -v; };
}
Change shift(double least, double most) {
    return [=](double v, base::Random& random) {
        const double by = random.uniform(least, most);
        return random.chance(0.5) ? v + by : v - by;
    };
}
Change scale(double by) {
    return [by](double v, base::Random&) { return by * v; };
}

std::size_t pickBlock(const Blocks& blocks, base::Random& random) {
    return *pick(blocks.size(), random, [&](std::size_t i) { return !blocks[i].link; });
}

bool dropBlock(DrawnProgram& program, base::Random& random) {
    const auto at = static_cast<std::ptrdiff_t>(pickBlock(program.blocks, random));
    program.blocks.erase(program.blocks.begin() + at);
    return true;
}

bool doubleBlock(DrawnProgram& program, base::Random& random) {
    const std::size_t at = pickBlock(program.blocks, random);
    const NcBlock copy = program.blocks[at];
    program.blocks.insert(program.blocks.begin() + static_cast<std::ptrdiff_t>(at), copy);
    return true;
}

bool exchangeBlocks(DrawnProgram& program, base::Random& random) {
    const std::size_t at = pickBlock(program.blocks, random);
    if (at + 1 == program.blocks.size() || program.blocks[at + 1].link) return false;
    std::swap(program.blocks[at], program.blocks[at + 1]);
    return true;
}

/// Right at the end of the block, another way to it. Near the pole a program may do so and be right.
Harm turned(std::string name,
            const std::function<void(const std::string& machine, double& first, double& second)>& change) {
    return {std::move(name), [=](DrawnProgram& program, base::Random& random) {
                if (program.closed_form == nullptr || program.form == Form::NearThePole) return false;
                const ClosedForm& form = *program.closed_form;
                const auto at = pick(program.blocks.size(), random, [&](std::size_t i) {
                    const NcBlock& block = program.blocks[i];
                    return !block.link && block.has(form.first) && block.has(form.second);
                });
                if (!at) return false;
                double* values[2] = {};
                for (NcWord& word : program.blocks[*at].words) {
                    if (word.address == form.first) values[0] = &*word.value;
                    if (word.address == form.second) values[1] = &*word.value;
                }
                change(form.machine, *values[0], *values[1]);
                return true;
            }};
}

void otherBranch(const std::string& machine, double& first, double& second) {
    if (machine == "nutating-45") {
        // t(B, C) lies at atan2(√2·sin B, 1 − cos B) − C about Z: −B mirrors it about X.
        const double b = base::radFromDeg(second);
        first -= 2.0 * base::degFromRad(std::atan2(std::numbers::sqrt2 * std::sin(b), 1.0 - std::cos(b)));
    } else
        first += first > 0.0 ? -180.0 : 180.0;
    second = -second;
}

Harm argument(const std::string& cycle, std::size_t index, const Change& change) {
    return {fmt::format("{} argument {}", cycle, index + 1), [=](DrawnProgram& program, base::Random& random) {
                const auto at = pick(program.blocks.size(), random, [&](std::size_t i) {
                    const NcBlock& block = program.blocks[i];
                    return block.cycle == cycle && block.arguments.size() > index && block.arguments[index];
                });
                if (!at) return false;
                double& value = *program.blocks[*at].arguments[index];
                value = change(value, random);
                return true;
            }};
}

Harm otherCycle(const std::string& from, const std::string& to) {
    return {fmt::format("{} to {}", from, to), [=](DrawnProgram& program, base::Random& random) {
                const auto at =
                    pick(program.blocks.size(), random, [&](std::size_t i) { return program.blocks[i].cycle == from; });
                if (at) program.blocks[*at].cycle = to;
                return at.has_value();
            }};
}

bool loseSwivel(DrawnProgram& program, base::Random& random) {
    const auto at = pick(program.blocks.size(), random, [&](std::size_t i) {
        return program.blocks[i].cycle == "CYCLE800" && !program.blocks[i].arguments.empty();
    });
    if (at) program.blocks[*at].arguments.clear();
    return at.has_value();
}

void addValues(std::vector<Harm>& all) {
    for (const char* address : {"X", "Y", "Z", "A", "B", "C", "A3", "B3", "C3", "I", "J"})
        all.push_back(value(fmt::format("sign of {}", address), address, negate()));
    for (const char* address : {"X", "Y", "Z", "I", "J"}) {
        all.push_back(value(fmt::format("{} by 2 to 10 µm", address), address, shift(0.002, 0.01)));
        all.push_back(value(fmt::format("{} by up to 5 mm", address), address, shift(0.01, 5.0)));
    }
    for (const char* address : {"A", "B", "C"})
        all.push_back(value(fmt::format("{} by up to 1°", address), address, shift(0.002, 1.0)));
    for (const char* address : {"A3", "B3", "C3"})
        all.push_back(value(fmt::format("{} by up to 0.02", address), address, shift(0.0001, 0.02)));
    all.push_back(value("F ×10", "F", scale(10.0)));
    all.push_back(value("F less by 1 to 9 %", "F",
                        [](double v, base::Random& random) { return v * random.uniform(0.91, 0.99); }));
    all.push_back(value("S ×10", "S", scale(10.0)));
    all.push_back(value("S more by 1", "S", [](double v, base::Random&) { return v + 1.0; }));
    all.push_back(value("wrong T", "T", [](double v, base::Random&) { return v + 1.0; }));
}

void addWords(std::vector<Harm>& all) {
    const std::pair<double, double> codes[] = {{0, 1},   {1, 0},   {2, 3},   {3, 2},   {2, 1},    {3, 1},
                                               {17, 18}, {17, 19}, {54, 55}, {54, 57}, {54, 500}, {90, 91},
                                               {91, 90}, {94, 95}, {95, 94}, {93, 94}, {94, 93},  {710, 700}};
    for (const auto& [from, to] : codes) all.push_back(replaced("G", from, to));
    for (const auto& [from, to] : {std::pair{3.0, 4.0}, {4.0, 3.0}, {3.0, 5.0}, {7.0, 8.0}, {8.0, 7.0}, {8.0, 9.0}})
        all.push_back(replaced("M", from, to));
    for (const double code : {0.0, 1.0, 2.0, 3.0, 54.0, 90.0, 91.0, 93.0, 95.0}) all.push_back(lost("G", code));
    for (const double code : {3.0, 4.0, 6.0, 7.0, 8.0, 30.0}) all.push_back(lost("M", code));
    for (const char* address : {"X", "Y", "Z", "A", "B", "C",      "A3",      "B3",    "C3",    "I",
                                "J", "F", "S", "T", "D", "TRAORI", "TRAFOOF", "MCALL", "TRANS", "AROT"})
        all.push_back(lost(address));
    all.push_back(replaced("D", 1, 0));
    all.push_back(replaced("D", 1, 2));
    all.push_back(renamed("TRAORI", "TRAFOOF"));
    all.push_back(renamed("TRAFOOF", "TRAOOF"));
    all.push_back(renamed("AROT", "ROT"));
    all.push_back(renamed("ORIAXES", "ORIVECT"));
    all.push_back(renamed("ORIMKS", "ORIWKS"));
    all.push_back(renamed("X", "Y"));
}

void addCycles(std::vector<Harm>& all) {
    for (const char* cycle : {"CYCLE81", "CYCLE82", "CYCLE83", "CYCLE84", "CYCLE85"}) {
        all.push_back(argument(cycle, 0, shift(0.05, 0.9)));
        all.push_back(argument(cycle, 2, shift(0.05, 0.9)));
        all.push_back(argument(cycle, 3, shift(0.002, 0.5)));
    }
    all.push_back(argument("CYCLE82", 5, shift(0.1, 0.4)));
    all.push_back(argument("CYCLE83", 6, shift(0.05, 0.5)));
    all.push_back(argument("CYCLE83", 10, scale(0.5)));
    all.push_back(argument("CYCLE83", 11, [](double v, base::Random&) { return 1.0 - v; }));
    all.push_back(argument("CYCLE84", 8, scale(1.2)));
    all.push_back(argument("CYCLE84", 10, scale(0.9)));
    all.push_back(argument("CYCLE85", 6, scale(2.0)));
    all.push_back(argument("CYCLE85", 7, scale(2.0)));
    all.push_back(otherCycle("CYCLE83", "CYCLE81"));
    all.push_back(otherCycle("CYCLE84", "CYCLE82"));
    all.push_back(otherCycle("CYCLE85", "CYCLE82"));
    all.push_back(otherCycle("CYCLE82", "CYCLE85"));
    for (std::size_t i = 4; i <= 12; ++i) all.push_back(argument("CYCLE800", i, shift(0.005, 0.5)));
    for (const double mode : {27.0, 39.0, 57.0})
        all.push_back(argument("CYCLE800", 3, [mode](double, base::Random&) { return mode; }));
    all.push_back({"lost CYCLE800", loseSwivel});
}

}  // namespace

const std::vector<Harm>& allHarms() {
    static const std::vector<Harm> all = [] {
        std::vector<Harm> harms = {{"dropped block", dropBlock},
                                   {"doubled block", doubleBlock},
                                   {"exchanged blocks", exchangeBlocks},
                                   turned("other branch", otherBranch),
                                   turned("other winding", [](const std::string&, double& first, double&) {
                                       first += first > 0.0 ? -360.0 : 360.0;
                                   })};
        addValues(harms);
        addWords(harms);
        addCycles(harms);
        return harms;
    }();
    return all;
}

}  // namespace cusp::post::verify::test
