// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Counting from many threads loses nothing, and a request to stop arrives.
#include <cusp/base/progress.hpp>
#include <cusp/base/version.hpp>

#include <algorithm>
#include <gtest/gtest.h>
#include <thread>
#include <vector>

namespace {

using namespace cusp::base;

TEST(Progress, CountsFromManyThreads) {
    CountingProgress progress;
    progress.begin(40000, "work");
    {
        std::vector<std::jthread> threads;
        threads.reserve(4);
        for (int i = 0; i < 4; ++i)
            threads.emplace_back([&progress] {
                for (int k = 0; k < 5000; ++k) progress.advance(2);
            });
    }
    EXPECT_EQ(progress.done(), 40000U);
    EXPECT_EQ(progress.total(), 40000U);
    progress.begin(7, "more");
    EXPECT_EQ(progress.done(), 0U);
    EXPECT_EQ(progress.total(), 7U);
}

TEST(Progress, StopReachesTheWork) {
    CountingProgress progress;
    EXPECT_FALSE(progress.stopRequested());
    progress.requestStop();
    EXPECT_TRUE(progress.stopRequested());
    noProgress().begin(1, "");
    noProgress().advance();
    noProgress().end();
    EXPECT_FALSE(noProgress().stopRequested());
}

TEST(Version, IsThreeNumbers) {
    const std::string_view text = version();
    EXPECT_EQ(std::count(text.begin(), text.end(), '.'), 2);
    EXPECT_EQ(text.find_first_not_of("0123456789."), std::string_view::npos);
}

}  // namespace
