// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A setup's tools are its own first, then its library's.
#include "setup_lookup.hpp"

#include <cusp/toolpath/tool_library.hpp>

#include <filesystem>
#include <utility>

namespace cusp::cli {

base::Result<machine::SetupDefinition> loadSetup(const std::string& path) {
    auto setup = machine::readSetupFile(path);
    if (!setup || setup->tool_library.empty()) return setup;
    const std::filesystem::path beside = std::filesystem::path(path).parent_path();
    const auto library = toolpath::readToolLibraryFile((beside / setup->tool_library).string());
    if (!library) return base::fail(library.error());
    // The first that fits is taken, so what the setup itself says of a tool wins.
    for (const toolpath::Tool& tool : library->tools)
        setup->tools.push_back({.number = tool.number, .name = tool.name, .length_mm = tool.gauge_length_mm});
    return setup;
}

}  // namespace cusp::cli
