// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp simulate`: removes from a stock what a path's tools sweep, and says what is left and what was hit.
#include "command.hpp"
#include "console.hpp"
#include "simulate_run.hpp"

#include <memory>

namespace cusp::cli {

namespace {

ExitCode runSimulate(const SimulateFlags& flags) {
    auto input = readSimulateInput(flags);
    if (!input) return failWith(input.error());
    const auto done = runSimulation(flags, **input);
    if (interrupted()) return ExitCode::Interrupted;
    if (!done) return failWith(done.error());
    if (!flags.output.empty())
        if (const auto written = writeSimulation(flags, **input, *done); !written) return failWith(written.error());
    if (flags.json)
        sayJson(simulateSummary(flags, **input, *done));
    else
        say(simulateText(flags, **input, *done));
    return foundSomething(flags, *done) ? ExitCode::FoundSomething : ExitCode::Done;
}

void addInputs(CLI::App& app, SimulateFlags& flags) {
    app.add_option("FILE", flags.file,
                   "CL file from any CAM, or an 840D program (.MPF, .SPF, .NC; needs -m and --tool-library).")
        ->required();
    app.add_option("--stock", flags.stock, "The blank: STL, PLY, STEP or IGES, closed, in the frame of the part.");
    app.add_option("--stock-box-mm", flags.stock_box_mm, "The blank as a box: lowest and highest corner, X Y Z X Y Z.")
        ->expected(6);
    app.add_option(
        "--nominal", flags.nominal,
        "What the part shall be: surface file (TOML), STL, PLY, STEP or IGES. Deviations are measured to it.");
    app.add_option("--fixture", flags.fixtures, "What nothing may touch: STL, PLY, STEP or IGES; may be repeated.")
        ->allow_extra_args(false);
    app.add_option("--table", flags.tables, "The machine's table, likewise.")->allow_extra_args(false);
    app.add_option("--tool-library", flags.tool_library,
                   "Tools with shank and holder (TOML); looked up by the numbers and names of the file.");
    app.add_option("--tool", flags.tool, "Name or number of the library's tool to use for all of the file.");
    app.add_option(
           "--head-mm", flags.head_mm,
           "Ring of the spindle head above the gauge plane: height, lower and upper diameter, by commas; may be repeated.")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option(
           "--ram-mm", flags.ram_mm,
           "Ring of the ram above the swivel's axis, which keeps the direction of Z while the tool leans: height, "
           "lower and upper diameter, by commas; may be repeated.")
        ->delimiter(',')
        ->allow_extra_args(false);
    app.add_option("--pivot-mm", flags.pivot_mm, "From the gauge plane up to the swivel's axis, for --ram-mm.")
        ->capture_default_str();
    app.add_option("--clearance-mm", flags.clearance_mm, "Kept free around shank, holder and head.")
        ->capture_default_str();
    app.add_option("-m,--machine", flags.machine,
                   "Machine file, or the name of one that ships: checks that the machine reaches every pose.");
    app.add_option("--wcs-origin-mm", flags.wcs_origin_mm,
                   "Where the part's origin lies in the machine, X Y Z: checks the linear axes too.")
        ->expected(3);
    app.add_option("--dialect", flags.dialect, "Who wrote the CL file, when it cannot be told from the text.")
        ->check(CLI::IsMember({"nx", "catia", "solidworks", "apt"}));
    app.add_option("--units", flags.units, "Unit of lengths, when the CL file does not say.")
        ->check(CLI::IsMember({"mm", "inch"}));
    app.add_flag("--strict", flags.strict, "Statements that are not understood are errors.");
}

void addWork(CLI::App& app, SimulateFlags& flags) {
    app.add_option("--resolution-mm", flags.resolution_mm, "Distance of the rays the stock is made of.")
        ->capture_default_str();
    app.add_option("--sweep-tolerance-mm", flags.sweep_tolerance_mm,
                   "How exactly the sweep of a turning tool is followed.")
        ->capture_default_str()
        ->check(CLI::Range(1e-5, 1.0));
    app.add_option("--tolerance-mm", flags.tolerance_mm, "Deviation to each side that is in order.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option("--memory-mb", flags.memory_mb, "The stock must fit into this.")
        ->capture_default_str()
        ->check(CLI::PositiveNumber);
    app.add_option(
        "-o,--output", flags.output,
        "Folder to write: the page, pictures, what is left as a mesh, deviations, engagement of every move.");
    app.add_flag("--json", flags.json, "One machine-readable summary on stdout.");
}

}  // namespace

void addSimulateCommand(CLI::App& app, Action& action) {
    CLI::App* simulate = app.add_subcommand(
        "simulate", "Removes material with the whole tool along a path: what is left, its deviation, collisions.");
    const auto flags = std::make_shared<SimulateFlags>();
    addInputs(*simulate, *flags);
    addWork(*simulate, *flags);
    simulate->callback([flags, &action] { action = [flags] { return runSimulate(*flags); }; });
}

}  // namespace cusp::cli
