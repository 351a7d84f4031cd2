// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The last word on a tilted path: it is posted, the program is read back and compared, and what it really does is simulated.
#pragma once

#include "machine_lookup.hpp"

#include <cusp/base/result.hpp>
#include <cusp/optimizer/tilt/tilt_case.hpp>
#include <cusp/post/verify/verify_program.hpp>
#include <cusp/simulation/collision_field.hpp>

#include <optional>
#include <string>

namespace cusp::cli {

struct PostedProof {
    std::string program;         ///< the text of the 840D program
    std::string not_posted;      ///< why there is no program; empty when there is one
    std::size_t excursions = 0;  ///< times the tool leaves the part to unwind
    std::optional<post::verify::VerifyReport> verification;
    /// Of the moves the program makes, those of its own included, with the finished part.
    std::optional<simulation::CollisionVolume> collisions;

    [[nodiscard]] bool pass() const {
        return verification && verification->pass && collisions && collisions->volume_mm3 <= 0.0;
    }
};

/// `cl_text`: the tilted path as it is written; `program_name` for the head of the program. Posted with the work offset at the
/// job's origin and the tool's length, read back by the reader that shares nothing with the writer.
/// Errors: a CL text or program that cannot be read; `simulation.*`.
[[nodiscard]] base::Result<PostedProof> provePosted(const std::string& cl_text, const std::string& program_name,
                                                    const LoadedMachine& machine, const tilt::TiltCase& problem);

}  // namespace cusp::cli
