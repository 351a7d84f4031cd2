// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A nominal shape from a file of whatever kind cusp reads.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/closest_point.hpp>

#include <memory>
#include <string>

namespace cusp::geometry {

/// The shape in a file, by the ending of its name (in small or capital letters): `.toml` is a surface file; `.step`,
/// `.stp`, `.iges` and `.igs` are CAD files; `.stl` and `.ply` are meshes in mm. Warnings (`mesh.open`, `cad.partial` …) go to
/// `report`.
/// Errors: `nominal.unknown-format`, and those of the reader.
[[nodiscard]] base::Result<std::unique_ptr<NominalShape>> loadNominal(const std::string& path,
                                                                      base::Diagnostics& report);
/// The same, warnings left aside.
[[nodiscard]] base::Result<std::unique_ptr<NominalShape>> loadNominal(const std::string& path);

}  // namespace cusp::geometry
