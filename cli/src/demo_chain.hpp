// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The chain of `cusp demo`: every step is a function of the rooms, and every step leaves its files.
#pragma once

#include "machine_lookup.hpp"

#include <cusp/loop/artefact.hpp>
#include <cusp/loop/budget_path.hpp>
#include <cusp/loop/calibration.hpp>
#include <cusp/loop/closed_loop.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace cusp::cli {

struct DemoOptions {
    std::string folder;
    std::string machine = "fooke-endura-ca";
    std::string nominal;  ///< empty: the benchmark surface
    std::string sections = "X=-5,-30,-60,-90";
    std::string link = "modbus-tcp://127.0.0.1:0";
    double budget_mm = 0.004;
    double out_mm = 0.030;    ///< the first part is to be out by more
    double limit_mm = 0.010;  ///< what the second is judged by
    std::uint64_t seed = 1;
    bool calibrate = true;
};

/// Everything the chain came by. The pointers of the tasks point into here.
struct Demo {
    DemoOptions options;
    std::unique_ptr<LoadedMachine> machine;
    std::unique_ptr<geometry::ParametricSurface> nominal;
    toolpath::Tool tool;
    loop::BudgetPath plan;
    loop::CuttingSetup setup;
    loop::PostedProgram program;
    loop::ExecutedProgram run;
    loop::FirstPart first;
    loop::MeasuredPart uncorrected;
    loop::SecondPart second;
    std::optional<loop::CalibrationResult> calibration;
    std::optional<loop::MeasuredPart> calibrated;
    double path_remains_mm = 0.0;  ///< of the path itself, cut without any error
    double control_mm = 0.0;       ///< what the control's way and the printed digits add
};

/// Called before each step with what it does; false ends the chain (`demo.interrupted`).
using DemoTold = std::function<bool(const std::string&)>;

/// Runs the chain and fills the folder. Errors: those of every step.
[[nodiscard]] base::Result<std::unique_ptr<Demo>> runDemo(const DemoOptions& options, const DemoTold& told);

/// demo.json and `--json`; with `curves`, the document of the page "loop".
[[nodiscard]] base::Json demoJson(const Demo& demo, double seconds, bool curves);

}  // namespace cusp::cli
