// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the commands of the loop have in common: a CL file read whole, and where it is cut.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/loop/executed_motion.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <CLI/App.hpp>

#include <string>
#include <vector>

namespace cusp::cli {

/// Warnings of the reader are told.
[[nodiscard]] base::Result<toolpath::ToolPath> readWholeCl(const std::string& path,
                                                           const toolpath::ClReaderOptions& options = {});

struct SetupFlags {
    double tool_length_mm = 100.0;
    std::vector<double> wcs_origin_mm;

    [[nodiscard]] loop::CuttingSetup setup() const;
};

/// --tool-length-mm and --wcs-origin-mm, as `cusp controller` has them.
void addSetupFlags(CLI::App& app, SetupFlags& flags);

}  // namespace cusp::cli
