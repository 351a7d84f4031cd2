// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Opens a setup file and the tool library it names.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/machine/setup_definition.hpp>

#include <string>

namespace cusp::cli {

/// The setup with the gauge lengths of its library's tools put behind its own. Errors: those of both readers.
[[nodiscard]] base::Result<machine::SetupDefinition> loadSetup(const std::string& path);

}  // namespace cusp::cli
