// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What `cusp tilt` tells of a tilted path: as JSON, as text, as files in its folder.
#pragma once

#include "tilt_proof.hpp"

#include <cusp/base/json_report.hpp>
#include <cusp/optimizer/tilt/tilt_search.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cusp::cli {

struct TiltResult {
    std::string job_file;
    std::string folder;
    std::string machine;
    std::vector<std::pair<std::uint64_t, tilt::TiltOutcome>> runs;  ///< with their seeds; empty for tilt points by hand
    std::size_t best_run = 0;
    tilt::TiltPlan plan;
    tilt::TiltFitness fitness;
    tilt::AxisMotion motion;
    std::optional<double> machining_time_s;
    simulation::CollisionVolume start_collisions;  ///< of the path as it came
    simulation::CollisionVolume proof;             ///< of the tilted path
    PostedProof posted;
    std::optional<double> stick_out_mm;
    tilt::ContactReport start_contact;
    tilt::ContactReport contact;
    double center_error_mm = 0.0;
    double seconds = 0.0;

    [[nodiscard]] bool isFree() const { return fitness.range_excess <= 0.0 && proof.volume_mm3 <= 0.0; }
    /// Free, and so is the posted program, which does what the path says.
    [[nodiscard]] bool isProven() const { return isFree() && posted.pass(); }
};

[[nodiscard]] base::Json toJson(const TiltResult& result, const tilt::TiltCase& problem);
[[nodiscard]] std::string toText(const TiltResult& result, const tilt::TiltCase& problem);
/// The tilted path as it is written.
[[nodiscard]] base::Result<std::string> tiltedText(const tilt::TiltCase& problem, const tilt::TiltPlan& plan);
/// start.apt, tilted.apt, tilted.mpf (where it could be posted), convergence.csv, report.json, and report.html, in the folder, which is made where it is not there.
[[nodiscard]] base::Result<void> writeFiles(const TiltResult& result, const tilt::TiltCase& problem);

}  // namespace cusp::cli
