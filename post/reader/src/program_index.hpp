// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where a program with jumps can go: labels, block numbers, programs in the file, and which words of its structures belong together.
#pragma once

#include <cusp/base/diagnostics.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace cusp::post::reader {

/// IF … ENDIF and the loops, as lines.
struct Structure {
    std::size_t begin = 0;
    std::size_t middle = 0;  ///< ELSE; 0 without
    std::size_t end = 0;
};

/// One program of a file in transfer form: `%_N_NAME_SPF` and what follows. Without a heading the file is one program.
struct ProgramPart {
    std::string name;       ///< in capitals, without `%_N_` and ending; empty without heading
    std::size_t first = 0;  ///< the line after the heading
    std::size_t last = 0;
};

struct ProgramIndex {
    std::map<std::string, std::vector<std::size_t>, std::less<>> labels;
    std::unordered_map<std::uint64_t, std::vector<std::size_t>> numbers;
    /// By each of the lines of a structure.
    std::unordered_map<std::size_t, Structure> structures;
    std::vector<ProgramPart> parts;

    [[nodiscard]] const ProgramPart& partOf(std::size_t line) const;
    /// Nothing when no program of the file has this name.
    [[nodiscard]] const ProgramPart* find(std::string_view name) const;
};

/// How deep structures may be nested (PM12, check structures).
inline constexpr std::size_t deepest_structures = 16;

/// Errors: `nc.structure` (a word without its partner), `nc.nesting`.
[[nodiscard]] bool buildIndex(const std::vector<std::string>& lines, std::size_t first_line,
                              const std::string& file_name, ProgramIndex& index, base::Diagnostics& report);

}  // namespace cusp::post::reader
