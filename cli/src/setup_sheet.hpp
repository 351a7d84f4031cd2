// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The page that hangs at the machine beside a program: offsets, tools, operations.
#pragma once

#include "post_text.hpp"

#include <cusp/machine/setup_definition.hpp>

#include <optional>
#include <string>

namespace cusp::cli {

/// Markdown. Lengths of tools and places of offsets are those of the setup, or left blank to be filled in by hand.
[[nodiscard]] std::string setupSheet(const PostOutcome& outcome, const std::string& program_name,
                                     const std::optional<machine::SetupDefinition>& setup);

}  // namespace cusp::cli
