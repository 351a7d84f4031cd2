// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Names the packing of a file by its first bytes, so that a reader can say what to do with it.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace cusp::inspect {

/// "gzip", "zip" …; empty when the bytes are of no such file.
[[nodiscard]] inline std::string_view compressionOf(std::string_view head) {
    using namespace std::string_view_literals;
    constexpr std::array<std::pair<std::string_view, std::string_view>, 6> signatures{{{"\x1f\x8b"sv, "gzip"},
                                                                                       {"PK\x03\x04"sv, "zip"},
                                                                                       {"\xfd"
                                                                                        "7zXZ\0"sv,
                                                                                        "xz"},
                                                                                       {"7z\xbc\xaf\x27\x1c"sv, "7z"},
                                                                                       {"BZh"sv, "bzip2"},
                                                                                       {"\x28\xb5\x2f\xfd"sv, "zstd"}}};
    for (const auto& [bytes, name] : signatures)
        if (head.starts_with(bytes)) return name;
    return {};
}

}  // namespace cusp::inspect
