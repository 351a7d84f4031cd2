// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What `cusp simulate` is asked for, and what it reads: path, tools, stock, nominal, fixtures.
#pragma once

#include "machine_lookup.hpp"

#include <cusp/base/result.hpp>
#include <cusp/geometry/closest_point.hpp>
#include <cusp/simulation/milling.hpp>
#include <cusp/simulation/stock.hpp>
#include <cusp/simulation/tool_move.hpp>
#include <cusp/toolpath/tool_library.hpp>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cusp::cli {

struct SimulateFlags {
    std::string file;
    std::string stock;
    std::vector<double> stock_box_mm;
    std::string nominal;
    std::vector<std::string> fixtures;
    std::vector<std::string> tables;
    std::string tool_library;
    std::string tool;
    std::vector<double> head_mm;
    std::vector<double> ram_mm;
    double pivot_mm = 0.0;
    double clearance_mm = 0.0;
    std::string machine;
    std::vector<double> wcs_origin_mm;
    double resolution_mm = 0.5;
    double sweep_tolerance_mm = 0.002;
    double tolerance_mm = 0.05;
    double memory_mb = 4096.0;
    std::string dialect;
    std::string units;
    std::string output;
    bool strict = false;
    bool json = false;
};

/// What keeps the direction of the part's Z while the tool leans; no rings: nothing does.
struct RamShape {
    double pivot_mm = 0.0;                       ///< from the gauge plane up to the swivel's axis
    std::vector<simulation::ProfileRing> rings;  ///< from the swivel's axis upwards
    double clearance_mm = 0.0;
};

/// A solid that must not be touched.
struct Obstacle {
    std::string kind;  ///< "fixture", "table"
    std::string file;
    std::unique_ptr<geometry::NominalShape> shape;
};

struct SimulateInput {
    toolpath::ToolLibrary library;
    std::optional<LoadedMachine> machine;
    simulation::CutterPath path;
    std::vector<simulation::ToolAssembly> assemblies;
    std::optional<simulation::Stock> stock;
    std::unique_ptr<geometry::NominalShape> nominal;
    std::vector<Obstacle> obstacles;
    RamShape ram;
    bool is_program = false;  ///< of a control, not a CL file
};

/// Reads everything and says what is wrong with it, before any work begins.
/// Errors: those of the readers; `simulate.stock` (none, or two), `simulate.tool`, `simulate.head`, `simulate.ram`, `simulate.machine` (a program without one),
/// `simulate.pose` (the program does not tell where the tool is), `simulate.outside` (the path misses the stock).
[[nodiscard]] base::Result<std::unique_ptr<SimulateInput>> readSimulateInput(const SimulateFlags& flags);

}  // namespace cusp::cli
