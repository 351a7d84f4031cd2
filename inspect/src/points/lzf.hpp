// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The compression of binary PCD files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace cusp::inspect {

/// Unpacks LZF (the stream format of M. Lehmann's LibLZF); nothing when the data are damaged or do not give exactly
/// `size` bytes.
[[nodiscard]] std::optional<std::string> unpackLzf(std::string_view packed, std::size_t size);

}  // namespace cusp::inspect
