// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Turns of phrase that messages and documentation of a schema share.
#pragma once

#include <cusp/base/schema_field.hpp>

#include <string>

namespace cusp::base {

/// "greater than 0", "at least 1", "at most 90", "between 0 and 90", "greater than 0 and at most 90"; "" without bounds.
[[nodiscard]] std::string rangeText(const FieldRules& rules);

/// "a number in mm/min", "a list of 3 numbers", "\"a\" | \"b\"".
[[nodiscard]] std::string expectedText(const FieldInfo& info);

}  // namespace cusp::base
