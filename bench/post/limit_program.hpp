// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The least a post must do, and nothing else: read six numbers, two arc tangents, print five numbers.
#pragma once

#include <cstdint>
#include <cstdio>

namespace cusp::bench {

/// Parses every `GOTO/` line with std::from_chars, computes C and A of a C-then-A head, prints X Y Z C A with
/// std::to_chars and five decimals. Answers the number of points.
std::uint64_t runLimitProgram(std::FILE* in, std::FILE* out);

}  // namespace cusp::bench
