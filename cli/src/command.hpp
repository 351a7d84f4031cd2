// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How a subcommand joins the command line: it declares its flags and leaves behind what to run.
#pragma once

#include "exit_code.hpp"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <functional>

namespace cusp::cli {

/// Set by the subcommand the user named.
using Action = std::function<ExitCode()>;

void addControllerCommand(CLI::App& app, Action& action);
void addEvaluateCommand(CLI::App& app, Action& action);
void addCalibrateCommand(CLI::App& app, Action& action);
void addCapabilityCommand(CLI::App& app, Action& action);
void addCompensateCommand(CLI::App& app, Action& action);
void addDemoCommand(CLI::App& app, Action& action);
void addInspectCommand(CLI::App& app, Action& action);
void addMachineCommand(CLI::App& app, Action& action);
void addOptimizeCommand(CLI::App& app, Action& action);
void addPlanCommand(CLI::App& app, Action& action);
void addPocketCommand(CLI::App& app, Action& action);
void addMeasureCommand(CLI::App& app, Action& action);
void addPostCommand(CLI::App& app, Action& action);
void addSimulateCommand(CLI::App& app, Action& action);
void addSchemaCommand(CLI::App& app, Action& action);
void addTiltCommand(CLI::App& app, Action& action);
void addTextureCommand(CLI::App& app, Action& action);
void addSendCommand(CLI::App& app, Action& action);
void addVerifyCommand(CLI::App& app, Action& action);

}  // namespace cusp::cli
