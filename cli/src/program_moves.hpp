// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The moves of an 840D program, as the reader understands it, for a simulation.
#pragma once

#include "machine_lookup.hpp"

#include <cusp/base/result.hpp>
#include <cusp/simulation/tool_move.hpp>
#include <cusp/toolpath/tool_library.hpp>

#include <istream>
#include <string>

namespace cusp::cli {

/// Moves in the frame of the work offset; lines are those of the program. Blocks whose way is no straight move with the axis
/// on a great circle are cut into chords within `chord_tolerance_mm`. `tool`: every tool of the program is this one; else they
/// are looked up in `library`. Motions in machine coordinates only place the tool.
/// Errors: those of the reader; `simulate.tool`, `simulate.pose`.
[[nodiscard]] base::Result<simulation::CutterPath>
readProgramMoves(const std::string& file, const LoadedMachine& machine, const toolpath::ToolLibrary& library,
                 const toolpath::Tool* tool, double chord_tolerance_mm);

/// The same from a stream; `name` is for messages, warnings go to `report`.
[[nodiscard]] base::Result<simulation::CutterPath>
readProgramMoves(std::istream& stream, const std::string& name, const LoadedMachine& machine,
                 const toolpath::ToolLibrary& library, const toolpath::Tool* tool, double chord_tolerance_mm,
                 base::Diagnostics& report);

}  // namespace cusp::cli
