// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The path a program will take, for the monitor page: the reader's motions, thinned to what a picture shows.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/post/reader/program_reader.hpp>

#include <memory>
#include <string>

namespace cusp::cli {

/// {"tip_mm": [x, y, z, …], "line": […], "rapid": […], "points", "whole"}: the tip in the frame of the work offset; "line"
/// is the program's line a point ends, "rapid" 1 where the way to it is one. At most `most_points`; "whole" is false where the
/// program was too long to be read to its end, or could not be.
[[nodiscard]] base::Json programPath(const std::string& text, const std::string& name, const post::MachineFile& machine,
                                     const post::reader::MachineSetup& setup, std::size_t most_points = 12'000);

}  // namespace cusp::cli
