// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The job file of a calibration.
#pragma once

#include <cusp/base/toml_schema.hpp>
#include <cusp/loop/calibration.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::loop {

/// One part that was cut and measured. Paths are relative to the job file.
struct CalibrationPartJob {
    enum class Datums : std::uint8_t { Free, Fixed };
    std::string cl_file;
    std::string nominal;
    std::string points;  ///< what the measuring machine wrote, any format `cusp inspect` reads
    std::optional<double> probe_radius_mm;
    std::string motion;  ///< record of the control; empty: the axes follow the CL file
    Datums datums = Datums::Free;
};

struct KnownJob {
    std::string name;
    double value = 0.0;
    double uncertainty = 0.0;
};

struct CalibrationJob {
    std::int64_t schema = 1;
    std::string machine;
    double tool_length_mm = 0.0;
    std::array<double, 3> wcs_origin_mm{0.0, 0.0, 0.0};
    double noise_mm = 0.0;
    bool drift = true;
    bool lobes = true;
    std::vector<CalibrationPartJob> parts;
    std::vector<KnownJob> known;
};

/// The field table of a calibration job.
[[nodiscard]] const base::Section<CalibrationJob>& calibrationJobSection();

}  // namespace cusp::loop
