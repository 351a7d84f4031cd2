// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The version stamped into everything cusp writes.
#pragma once

#include <string_view>

namespace cusp::base {

/// "0.1.0", the version of the CMake project.
[[nodiscard]] std::string_view version();

}  // namespace cusp::base
