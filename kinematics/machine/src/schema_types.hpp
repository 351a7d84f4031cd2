// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Teaches the TOML schema the machine room's own value types; found by argument-dependent lookup from base's Section.
#pragma once

#include <cusp/base/schema_field.hpp>
#include <cusp/machine/machine_definition.hpp>

#include <string>

namespace cusp::machine {

/// Three numbers, not all zero; stored with unit length.
void readValue(const base::TomlNode& node, const base::FieldInfo& info, Direction& out, base::Diagnostics& report);
[[nodiscard]] std::string printValue(const Direction& value, const base::FieldInfo& info);

/// A table of numbers under axis names, in the unit of the field's key.
void readValue(const base::TomlNode& node, const base::FieldInfo& info, RotaryPose& out, base::Diagnostics& report);
[[nodiscard]] std::string printValue(const RotaryPose& value, const base::FieldInfo& info);

}  // namespace cusp::machine

template <>
struct cusp::base::TypeName<cusp::machine::Direction> {
    static std::string text() { return TypeName<std::array<double, 3>>::text(); }
};
template <>
struct cusp::base::TypeName<cusp::machine::RotaryPose> {
    static std::string text() { return "table of numbers"; }
};
