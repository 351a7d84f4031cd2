// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The job file of `cusp pocket`.
#pragma once

#include <cusp/optimizer/pocket/cutting_data.hpp>
#include <cusp/optimizer/pocket/pocket_area.hpp>

#include <cusp/base/toml_schema.hpp>

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::pocket {

enum class ContourKind { Stock, Pocket, Island };

struct ContourJob {
    ContourKind kind = ContourKind::Stock;
    std::vector<std::array<double, 2>> points_mm;
    std::vector<double> bulges;
};

struct DepthJob {
    double top_mm = 0.0;
    double floor_mm = -5.0;
    double allowance_mm = 0.0;
    double clearance_mm = 50.0;
    double approach_mm = 2.0;
    double ramp_rad = 3.0 * 0.017453292519943295;
};

struct EndMillJob {
    std::int64_t number = 1;
    std::string name;
    double diameter_mm = 10.0;
    std::int64_t teeth = 2;
    double cutting_height_mm = 20.0;
    double overhang_mm = 40.0;
};

struct CuttingJob {
    std::string table = "mitic-2023";
    std::string material;
    std::array<double, 2> ae_share{0.05, 0.4};  ///< of the diameter
    std::array<double, 2> ap_share{0.1, 1.0};
    double engagement_limit_rad = 0.0;  ///< 0: of a straight cut at the largest ae, eq. acos(1 − 2 ae / D)
};

struct PocketMachineJob {
    std::string name;
    std::array<double, 3> origin_mm{};
    double max_spindle_rpm = 8000.0;
    double spindle_power_kw = 5.0;
    double rapid_mm_per_s = 20000.0 / 60.0;  ///< for estimates
    double tolerance_mm = 0.05;
};

struct PocketSearchJob {
    std::int64_t seed = 1;
    std::int64_t population = 8;
    std::int64_t iterations = 4;  ///< of the cutting-data search
    std::int64_t path_population = 8;
    std::int64_t path_generations = 4;
};

struct PocketJob {
    std::int64_t schema = 1;
    std::string name;
    std::vector<ContourJob> contours;
    DepthJob depth;
    EndMillJob tool;
    CuttingJob cutting;
    PocketMachineJob machine;
    PocketSearchJob search;

    /// Errors: those of `toPolygon`, with the contour's key.
    [[nodiscard]] base::Result<PocketContours> polygons(const std::string& file_name) const;
    [[nodiscard]] double engagementLimitDeg() const;
    [[nodiscard]] CutterLimits limits() const;
};

[[nodiscard]] const base::Section<PocketJob>& pocketJobSection();
[[nodiscard]] base::Result<PocketJob> readPocketJobFile(const std::string& path);
[[nodiscard]] base::Result<PocketJob> readPocketJob(std::string_view text, const std::string& file_name);

}  // namespace cusp::pocket
