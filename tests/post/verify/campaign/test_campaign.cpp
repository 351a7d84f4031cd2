// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Thousands of programs with one thing wrong, drawn at random from a seed: every one the paper machine calls harmed must
// be caught, and no unharmed one accused. CUSP_CAMPAIGN_PROGRAMS draws more of each form, CUSP_CAMPAIGN_SEED others.
#include "../program_pair.hpp"
#include "harms.hpp"
#include "paper_machine.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <map>

namespace cusp::post::verify::test {
namespace {

constexpr std::uint64_t default_seed = 20260719;
constexpr std::uint64_t default_programs = 16;  ///< of each form
/// Each of the harms is tried this often on every program.
constexpr int rounds = 2;
constexpr std::size_t shown = 3;  ///< programs printed of each sort of failure

std::uint64_t setting(const char* name, std::uint64_t otherwise) {
    const char* const text = std::getenv(name);
    return text == nullptr ? otherwise : std::strtoull(text, nullptr, 10);
}

struct Count {
    std::size_t caught = 0;
    std::size_t warned = 0;  ///< of a change of branch in a rapid, which may be meant
    std::size_t missed = 0;
    std::size_t harmless = 0;  ///< nothing to find: the machine does the same
};

class Campaign : public testing::Test {
protected:
    const MachineFile& machine(const std::string& name) {
        auto found = machines_.find(name);
        if (found == machines_.end()) found = machines_.emplace(name, shippedMachine(name)).first;
        return found->second;
    }

    VerifyReport report(const DrawnProgram& program) {
        return verify(toText(program.blocks), program.path, machine(program.machine), program.options);
    }

    void unharmed(const DrawnProgram& program) {
        ++programs_;
        const VerifyReport found = report(program);
        if (found.pass && found.findings.empty()) return;
        if (++accused_ <= shown)
            ADD_FAILURE() << nameOf(program.form) << " on " << program.machine << " is accused:\n"
                          << base::toText(found.findings) << toText(program.blocks);
    }

    void harmed(const std::string& kind, const DrawnProgram& program, const std::vector<TraceMotion>& original) {
        Count& count = counts_[kind];
        const VerifyReport found = report(program);
        const bool warned = found.findings.size() == 1 && found.findings.front().code == "verify.winding";
        if (!differ(original, trace(program)))
            ++count.harmless;
        else if (!found.pass)
            ++count.caught;
        else if (warned)
            ++count.warned;
        else if (++count.missed <= shown)
            ADD_FAILURE() << "not caught: " << kind << ", " << nameOf(program.form) << " on " << program.machine << "\n"
                          << toText(program.blocks);
    }

    [[nodiscard]] std::string table(std::uint64_t seed) {
        std::string text = fmt::format("seed {}\n{:<34}{:>8}{:>8}{:>8}{:>10}\n", seed, "kind", "caught", "warned",
                                       "missed", "harmless");
        for (const auto& [kind, count] : counts_) {
            text += fmt::format("{:<34}{:>8}{:>8}{:>8}{:>10}\n", kind, count.caught, count.warned, count.missed,
                                count.harmless);
            total_.caught += count.caught;
            total_.warned += count.warned;
            total_.missed += count.missed;
            total_.harmless += count.harmless;
        }
        return text +
               fmt::format(
                   "harmed: {} caught, {} warned, {} missed; {} changed without harm; unharmed: {}, {} accused\n",
                   total_.caught, total_.warned, total_.missed, total_.harmless, programs_, accused_);
    }

    std::map<std::string, MachineFile> machines_;
    std::map<std::string, Count> counts_;
    Count total_;
    std::size_t programs_ = 0;
    std::size_t accused_ = 0;
};

TEST_F(Campaign, EveryHarmIsCaughtAndNoUnharmedProgramAccused) {
    const std::uint64_t seed = setting("CUSP_CAMPAIGN_SEED", default_seed);
    const std::uint64_t programs = setting("CUSP_CAMPAIGN_PROGRAMS", default_programs);
    base::Random random(seed);
    for (const Form form : all_forms)
        for (std::uint64_t i = 0; i < programs; ++i) {
            base::Random own = random.split((static_cast<std::uint64_t>(form) << 32) + i);
            base::Random again = own;
            const DrawnProgram program = drawProgram(form, own);
            unharmed(program);
            const auto original = trace(program);
            for (int round = 0; round < rounds; ++round)
                for (const Harm& harm : allHarms()) {
                    DrawnProgram changed = program;
                    if (harm.apply(changed, own)) harmed(harm.name, changed, original);
                }
            if (form == Form::MachineCoordinates)
                harmed("tool length wrong by 0.1 mm", drawProgram(form, again, 0.1), original);
        }
    std::fputs(table(seed).c_str(), stdout);
    EXPECT_EQ(total_.missed, 0U);
    EXPECT_EQ(accused_, 0U);
    EXPECT_GT(total_.caught, 200 * programs);
}

}  // namespace
}  // namespace cusp::post::verify::test
