// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CL text posted for a shipped machine and handed to the witness, all in memory.
#pragma once

#include <cusp/post/verify/verify_program.hpp>
#include <cusp/post/writer/post_options.hpp>
#include <cusp/post/writer/program_planner.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace cusp::post::test {

/// Names without ".toml", sorted.
[[nodiscard]] std::vector<std::string> shippedMachineNames();
[[nodiscard]] MachineFile shippedMachine(const std::string& name);

struct Posted {
    std::string program;
    PostSummary summary;
    std::size_t blocks = 0;
    base::Diagnostics report;
};
[[nodiscard]] Posted post(const std::string& cl_text, MachineFile machine, const PostOptions& options);
[[nodiscard]] verify::VerifyReport verify(const std::string& program, const std::string& cl_text,
                                          const MachineFile& machine, const verify::VerifyOptions& options);

/// An operation in NX' words: approach, `points` feed points that wander with tips some millimetres apart and axes some
/// degrees, rapid out. Tilts lie in `least_tilt_deg` to `most_tilt_deg`, azimuths in ±150°.
[[nodiscard]] std::string wanderingPath(std::uint64_t seed, int points, double least_tilt_deg, double most_tilt_deg);

}  // namespace cusp::post::test
