// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CL files and setups for the commands of the loop.
#include "cut_input.hpp"

#include "console.hpp"

namespace cusp::cli {

base::Result<toolpath::ToolPath> readWholeCl(const std::string& path, const toolpath::ClReaderOptions& options) {
    base::Diagnostics warnings;
    auto read = toolpath::readToolPathFile(path, options, warnings);
    tell(warnings);
    return read;
}

loop::CuttingSetup SetupFlags::setup() const {
    loop::CuttingSetup out{.tool_length_mm = tool_length_mm};
    if (wcs_origin_mm.size() == 3) out.wcs_origin_mm = {wcs_origin_mm[0], wcs_origin_mm[1], wcs_origin_mm[2]};
    return out;
}

void addSetupFlags(CLI::App& app, SetupFlags& flags) {
    app.add_option("--tool-length-mm", flags.tool_length_mm, "Of the tool as the control has it, gauge point to tip.")
        ->capture_default_str()
        ->check(CLI::NonNegativeNumber);
    app.add_option("--wcs-origin-mm", flags.wcs_origin_mm,
                   "Origin of the work offset in machine coordinates, X Y Z (0 0 0).")
        ->expected(3);
}

}  // namespace cusp::cli
