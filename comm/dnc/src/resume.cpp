// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Preamble and rest, put together.
#include <cusp/comm/dnc/resume.hpp>

#include <algorithm>
#include <fmt/format.h>

namespace cusp::comm {

base::Result<Program> resumedProgram(const Program& program, const ResumePreamble& preamble) {
    if (preamble.text.empty())
        return base::fail("dnc.resume", "a program is not resumed without a preamble that rebuilds its modal state");
    if (!preamble.text.ends_with('\n')) return base::fail("dnc.resume", "the preamble's last line has no end");
    const std::size_t from = preamble.from_byte;
    if (from >= program.text.size())
        return base::fail("dnc.resume", fmt::format("nothing is left of {} after byte {}", program.name, from));
    if (from > 0 && program.text[from - 1] != '\n')
        return base::fail("dnc.resume",
                          fmt::format("byte {} of {} is not the beginning of a line", from, program.name));
    Program out = program;
    out.text = preamble.text + program.text.substr(from);
    out.blocks = static_cast<std::uint32_t>(std::count(out.text.begin(), out.text.end(), '\n'));
    out.start_block = preamble.start_block;
    return out;
}

}  // namespace cusp::comm
