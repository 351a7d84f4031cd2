// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Interrupted and resumed, a search ends in the same bytes as one that ran through; foreign checkpoints are refused.
#include "problems.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/json_report.hpp>
#include <cusp/optimizer/evolution/evolution_strategy.hpp>
#include <cusp/optimizer/evolution/search.hpp>

#include <atomic>
#include <filesystem>
#include <gtest/gtest.h>

namespace {

using namespace cusp::optimizer;
using test_problems::bohachevsky;
using test_problems::bohachevskyGenes;
namespace base = cusp::base;

constexpr Algorithm algorithms[] = {Algorithm::VirusEvolutionary, Algorithm::Genetic, Algorithm::SteadyState,
                                    Algorithm::RandomSearch};

std::string fileOf(const std::string& name) {
    const auto folder = std::filesystem::path(::testing::TempDir()) / "cusp_evolution";
    std::filesystem::create_directories(folder);
    const auto path = folder / (name + ".json");
    std::filesystem::remove(path);
    return path.string();
}

std::string content(const std::string& path) { return base::readWholeFile(path, 1U << 26U).value(); }

/// Stops once so many candidates were judged, wherever in a generation that is.
class StopAfter : public base::CountingProgress {
public:
    explicit StopAfter(std::uint64_t count) : count_(count) {}
    void advance(std::uint64_t steps) override {
        base::CountingProgress::advance(steps);
        if (done() >= count_) requestStop();
    }

private:
    std::uint64_t count_;
};

TEST(Resume, AnInterruptedSearchEndsInTheSameBytes) {
    const Encoding genes = bohachevskyGenes(23, Coding::Gray);
    for (const Algorithm algorithm : algorithms) {
        SearchOptions options;
        options.algorithm = algorithm;
        options.max_evaluations = 900;
        options.checkpoint_interval = 8;
        options.checkpoint_file = fileOf("through");
        const auto through = search(genes, inParallel(bohachevsky), options).value();
        const std::string expected = content(options.checkpoint_file);

        options.checkpoint_file = fileOf("pieces");
        options.resume = true;
        std::atomic<std::size_t> judged = 0;
        const auto counted = [&](const Values& v) {
            ++judged;
            return bohachevsky(v);
        };
        std::size_t pieces = 0;
        for (;; ++pieces) {
            StopAfter progress(137 * (pieces + 1));
            const auto piece = search(genes, inParallel(counted), options, progress).value();
            if (piece.termination != Termination::Stopped) break;
            ASSERT_LT(pieces, 30U);
        }
        EXPECT_GE(pieces, 4U);
        EXPECT_EQ(content(options.checkpoint_file), expected);
        // Two threads: whoever was being judged when the first gap opened may have been judged again.
        EXPECT_LE(judged.load(), through.evaluations + 8 * pieces);
    }
}

TEST(Resume, AFinishedSearchGoesOnWithALargerBudget) {
    const Encoding genes = bohachevskyGenes(23, Coding::Gray);
    SearchOptions options;
    options.max_evaluations = 900;
    const auto through = search(genes, inParallel(bohachevsky), options).value();
    options.checkpoint_file = fileOf("larger");
    options.resume = true;
    options.max_evaluations = 350;
    static_cast<void>(search(genes, inParallel(bohachevsky), options).value());
    options.max_evaluations = 900;
    const auto after = search(genes, inParallel(bohachevsky), options).value();
    EXPECT_EQ(convergenceCsv(after.history), convergenceCsv(through.history));
    EXPECT_EQ(after.bestValues(), through.bestValues());
}

TEST(Resume, TheStrategyToo) {
    const std::vector<RealVariable> variables{{"x", -1.0, 1.0}, {"y", -1.0, 1.0}};
    StrategyOptions options;
    options.max_evaluations = 1'000;
    options.checkpoint_interval = 8;
    options.checkpoint_file = fileOf("strategy_through");
    static_cast<void>(evolve(variables, inParallel(bohachevsky), options).value());
    const std::string expected = content(options.checkpoint_file);
    options.checkpoint_file = fileOf("strategy_pieces");
    options.resume = true;
    for (std::size_t pieces = 0;; ++pieces) {
        StopAfter progress(217 * (pieces + 1));
        if (evolve(variables, inParallel(bohachevsky), options, progress).value().termination != Termination::Stopped)
            break;
        ASSERT_LT(pieces, 30U);
    }
    EXPECT_EQ(content(options.checkpoint_file), expected);
}

TEST(Resume, AnotherSearchsCheckpointIsRefused) {
    const Encoding genes = bohachevskyGenes(12, Coding::Gray);
    SearchOptions options;
    options.max_evaluations = 100;
    options.checkpoint_file = fileOf("other");
    static_cast<void>(search(genes, inParallel(bohachevsky), options).value());
    options.resume = true;
    options.seed = 5;
    const auto refused = search(genes, inParallel(bohachevsky), options);
    ASSERT_FALSE(refused);
    EXPECT_EQ(
        base::toText(refused.error()),
        options.checkpoint_file +
            ": error: this checkpoint is of another search: 'seed' is not the same; resume with the settings it was "
            "begun with, or remove the file to begin anew [evolution.checkpoint-differs]\n");
}

TEST(Resume, DamagedCheckpointsAreRefused) {
    const Encoding genes = bohachevskyGenes(12, Coding::Gray);
    SearchOptions options;
    options.max_evaluations = 60;
    options.checkpoint_file = fileOf("damaged");
    static_cast<void>(search(genes, inParallel(bohachevsky), options).value());
    const std::string good = content(options.checkpoint_file);
    options.resume = true;
    options.max_evaluations = 100;
    std::size_t refused = 0;
    for (std::size_t cut = 0; cut < good.size(); cut += 97) {
        ASSERT_TRUE(base::writeWholeFile(options.checkpoint_file, good.substr(0, cut)));
        const auto result = search(genes, inParallel(bohachevsky), options);
        ASSERT_FALSE(result);
        ASSERT_EQ(result.error().front().code, "evolution.checkpoint");
        ++refused;
    }
    EXPECT_GT(refused, 20U);
    base::Json wrong = base::Json::parse(good);
    wrong["run"]["population"][0][1] = 1'000'000;
    ASSERT_TRUE(base::writeWholeFile(options.checkpoint_file, wrong.dump()));
    EXPECT_EQ(search(genes, inParallel(bohachevsky), options).error().front().code, "evolution.checkpoint");
}

}  // namespace
