// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Runs the cusp command in a folder of the test's own.
#pragma once

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/child_process.hpp>

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <string>
#include <unistd.h>
#include <vector>

namespace cusp::cli {

class CommandLine : public ::testing::Test {
protected:
    void SetUp() override {
        const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
        folder = std::filesystem::path(::testing::TempDir()) / (std::string("cusp_") + info->name() + "_" + unique());
        std::filesystem::create_directories(folder);
    }
    void TearDown() override { std::filesystem::remove_all(folder); }

    base::ProcessOutcome run(std::vector<std::string> arguments, const std::string& input = {}) {
        arguments.insert(arguments.begin(), CUSP_COMMAND);
        auto outcome = base::runProcess(arguments, {.wall_s = 60.0}, input);
        EXPECT_TRUE(outcome.has_value());
        EXPECT_EQ(outcome->limit, base::LimitHit::None) << base::outcomeText(*outcome);
        return *outcome;
    }

    std::string path(const std::string& name) const { return (folder / name).string(); }
    std::string write(const std::string& name, const std::string& text) const {
        EXPECT_TRUE(base::writeWholeFile(path(name), text).has_value());
        return path(name);
    }
    std::string read(const std::string& name) const {
        return base::readWholeFile(path(name), std::size_t{1} << 28U).value_or("");
    }
    /// Names in the folder, sorted: what a command left behind.
    std::vector<std::string> left() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) names.push_back(entry.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

    std::filesystem::path folder;

private:
    /// Tests of one program may run at the same time.
    static std::string unique() { return std::to_string(::getpid()); }
};

/// A few blocks every machine with a C-then-A head can run.
inline const char* const small_cl = "TOOL PATH/OP1,TOOL,BALL_6\n"
                                    "TLDATA/MILL,6.0,3.0,50.0,0.0,0.0\n"
                                    "MSYS/0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0\n"
                                    "SPINDL/RPM,8000,CLW\n"
                                    "RAPID\n"
                                    "GOTO/0.0,0.0,50.0,0.0,0.0,1.0\n"
                                    "FEDRAT/MMPM,1200.0\n"
                                    "GOTO/0.0,0.0,0.0,0.6,0.0,0.8\n"
                                    "GOTO/10.0,0.0,0.0\n"
                                    "RAPID\n"
                                    "GOTO/10.0,0.0,50.0\n"
                                    "END-OF-PATH\n";

}  // namespace cusp::cli
