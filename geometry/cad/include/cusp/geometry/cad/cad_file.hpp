// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Faces from STEP and IGES files.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/parametric_surface.hpp>

#include <cstdint>
#include <string>

namespace cusp::geometry {

struct CadOptions {
    /// The program that reads the file. Empty: the environment variable CUSP_CAD_READER, `cusp-cad` beside the running program,
    /// `../libexec/cusp/cusp-cad` from there, `cusp-cad` in PATH.
    std::string reader;
    double time_limit_s = 300.0;
    std::uint64_t memory_limit_bytes = std::uint64_t{8} << 30U;
};

/// The faces of a STEP file (AP203, AP214, AP242) or IGES file with their edges, in mm whatever unit the file states. The file
/// is read by OCCT in a process of its own. Planes, quadrics and swept surfaces become rational B-splines exactly; curves in
/// the parameters of a face are as exact as OCCT converts them (1e-7 mm).
///
/// Warnings go to `report`: `cad.partial`. Errors: `io.open`, `cad.reader` (the program is not there), `cad.syntax`,
/// `cad.no-shape`, `cad.no-faces`, `cad.unreadable`, `cad.crashed`, `cad.limit` (time, memory or size), `cad.stream`,
/// `cad.face` (a face that is no surface).
[[nodiscard]] base::Result<ParametricSurface> readCadFile(const std::string& path, base::Diagnostics& report,
                                                          const CadOptions& options = {});

}  // namespace cusp::geometry
