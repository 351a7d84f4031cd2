// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a machine file must fulfil beyond the type of each value.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/toml_node.hpp>
#include <cusp/machine/machine_definition.hpp>

namespace cusp::machine {

void checkLinearAxis(const LinearAxis& axis, const base::TomlNode& table, base::Diagnostics& report);
void checkRotaryAxis(const RotaryAxis& axis, const base::TomlNode& table, base::Diagnostics& report);
/// The rules that span tables: chain, axes and their directions, anchors, sources.
void checkMachine(const MachineDefinition& machine, const base::TomlNode& root, base::Diagnostics& report);

}  // namespace cusp::machine
