// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp optimize`: tool and parameters of a finishing path, searched for.
#include "command.hpp"
#include "console.hpp"
#include "optimize_output.hpp"
#include "optimize_run.hpp"

#include <cusp/base/atomic_file.hpp>

#include <memory>

namespace cusp::cli {

namespace {

ExitCode runOptimize(const OptimizeFlags& flags) {
    const auto done = runOptimization(flags);
    if (!done) return interrupted() ? ExitCode::Interrupted : failWith(done.error());
    if (const auto written = writeFolder(flags.folder, flags.job_file, *done); !written)
        return failWith(written.error());
    if (flags.json)
        sayJson(toJson(flags.folder, flags.job_file, *done));
    else
        say(toText(flags.folder, *done));
    return interrupted() ? ExitCode::Interrupted : ExitCode::Done;
}

}  // namespace

void addOptimizeCommand(CLI::App& app, Action& action) {
    CLI::App* optimize = app.add_subcommand(
        "optimize",
        "Searches tool and parameters of a finishing path: by the formulas of Fountas 2017 (paper mode), or the "
        "least machining time within a tolerance, by the exact envelope of the tool (true mode).");
    const auto flags = std::make_shared<OptimizeFlags>();
    optimize->add_option("JOB", flags->job_file, "Job file (TOML); `cusp schema optimize-job` lists its keys.")
        ->required();
    optimize
        ->add_option("-o,--output", flags->folder,
                     "Folder for the path, the job that plans it again, convergence, front, map and page.")
        ->required();
    optimize->add_option("--seed", flags->seed, "Wins over the job's seed.")->check(CLI::NonNegativeNumber);
    optimize->add_option("--evaluations", flags->evaluations, "Candidates to judge; wins over the job's.")
        ->check(CLI::Range(4, 10000000));
    optimize
        ->add_option(
            "--evaluator", flags->evaluator,
            "Paper mode: another CAM system plans. This command of the shell gets the parameters of a candidate as "
            "JSON on its input and answers with a CL file on its output.")
        ->type_name("CMD");
    optimize
        ->add_option("--evaluator-seconds", flags->evaluator_seconds, "How long that command may take for a candidate.")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    optimize->add_flag("--resume", flags->resume,
                       "Goes on with an interrupted search, or with one that shall judge more candidates, from the "
                       "folder's checkpoint.");
    optimize->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    optimize->callback([flags, &action] { action = [flags] { return runOptimize(*flags); }; });
}

}  // namespace cusp::cli
