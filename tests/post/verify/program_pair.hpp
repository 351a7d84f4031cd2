// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A CL path and a program for it, both made here from the same closed forms: no part of the writer has a hand in it.
#pragma once

#include <cusp/post/verify/verify_program.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace cusp::post::verify::test {

struct ProgramPair {
    toolpath::ToolPath path;
    std::vector<std::string> program;  ///< one block each
};

/// Two operations with a tool each on the C/A head, `points` cutting points per operation, tilted 5° to 50° and turned
/// through all quadrants; every motion block names all five axes. The CL line of record i is i + 1.
[[nodiscard]] ProgramPair twoOperations(std::uint32_t seed, int points);

/// A three-axis path of the given tips, the first a rapid, and its spindle and feed.
[[nodiscard]] toolpath::ToolPath straightPath(const std::vector<geometry::Vector3>& tips);

[[nodiscard]] std::string joined(const std::vector<std::string>& lines);
[[nodiscard]] MachineFile shippedMachine(const std::string& name);
/// Without a result (the reader refused the program), the report says fail and holds the reader's problems.
[[nodiscard]] VerifyReport verify(const std::string& program, const toolpath::ToolPath& path,
                                  const MachineFile& machine, const VerifyOptions& options = {});
/// The messages of errors, one per line.
[[nodiscard]] std::string errorTexts(const VerifyReport& report);

}  // namespace cusp::post::verify::test
