// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The cusp command: finds the subcommand, runs it, answers its exit code.
#include "command.hpp"
#include "console.hpp"

#include <cusp/base/version.hpp>

#include <cstdio>
#include <exception>
#include <string>

namespace {

using cusp::cli::ExitCode;

ExitCode run(int argc, char** argv) {
    CLI::App app{"cusp closes the loop of sculptured-surface machining: plan, post, prove, send, measure, correct.",
                 "cusp"};
    app.set_version_flag("--version", "cusp " + std::string(cusp::base::version()));
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 done, 1 done and it found something, 2 usage, 3 bad input, 4 I/O, 5 internal, 130 interrupted.");
    cusp::cli::Action action;
    addControllerCommand(app, action);
    addPlanCommand(app, action);
    addOptimizeCommand(app, action);
    addTiltCommand(app, action);
    addPocketCommand(app, action);
    addPostCommand(app, action);
    addVerifyCommand(app, action);
    addEvaluateCommand(app, action);
    addTextureCommand(app, action);
    addSendCommand(app, action);
    addCapabilityCommand(app, action);
    addInspectCommand(app, action);
    addMeasureCommand(app, action);
    addDemoCommand(app, action);
    addCompensateCommand(app, action);
    addCalibrateCommand(app, action);
    addMachineCommand(app, action);
    addSchemaCommand(app, action);
    addSimulateCommand(app, action);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const int code = app.exit(error);
        return code == 0 ? ExitCode::Done : ExitCode::Usage;
    }
    cusp::cli::watchForSignals();
    const ExitCode code = action();
    // A full disk or a closed pipe behind stdout must not look like success.
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        std::perror("cusp: standard output");
        return ExitCode::Io;
    }
    return code;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return static_cast<int>(run(argc, argv));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "cusp: internal error: %s\n", error.what());
        return static_cast<int>(ExitCode::Internal);
    }
}
