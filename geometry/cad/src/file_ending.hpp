// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The ending of a file's name, in small letters.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>

namespace cusp::geometry::detail {

[[nodiscard]] inline std::string endingOf(const std::string& path) {
    std::string ending = std::filesystem::path(path).extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return ending;
}

}  // namespace cusp::geometry::detail
