// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Cutting data: catalogue tables, what a set of data means, and what tool and machine can bear (Mitić 2023 eq. 2–4).
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/base/toml_schema.hpp>

#include <array>
#include <string>
#include <vector>

namespace cusp::pocket {

struct MaterialData {
    std::string number;
    std::string name;
    std::array<double, 2> vc_mm_per_s{};
    std::vector<double> fz_min_mm;  ///< one for each span of diameters
    std::vector<double> fz_max_mm;
    double kc_n_per_mm2 = 2000.0;  ///< specific cutting force, for power and load
};

/// One file of machines/cutting.
struct CuttingTable {
    std::vector<double> diameters_mm;  ///< ends of the spans, ascending: one more than there are spans
    std::vector<MaterialData> materials;
};

/// Errors: those of TOML; `pocket.table` where spans, ranges or numbers do not fit together, with the material.
[[nodiscard]] base::Result<CuttingTable> readCuttingTableFile(const std::string& path);
[[nodiscard]] const base::Section<CuttingTable>& cuttingTableSection();

/// The ranges a search may move in.
struct CuttingRange {
    std::array<double, 2> ap_mm{};
    std::array<double, 2> ae_mm{};
    std::array<double, 2> spindle_rpm{};  ///< eq. 2
    std::array<double, 2> fz_mm{};
    double kc_n_per_mm2 = 0.0;
};

/// Errors: `pocket.no-material` (with the numbers there are), `pocket.diameter` (outside the table).
[[nodiscard]] base::Result<CuttingRange> rangeFor(const CuttingTable& table, const std::string& material,
                                                  double diameter_mm);

struct CuttingData {
    double ap_mm = 0.0;
    double ae_mm = 0.0;
    double spindle_rpm = 0.0;
    double fz_mm = 0.0;
};

struct CutterLimits {
    double diameter_mm = 0.0;
    int teeth = 2;
    double overhang_mm = 0.0;
    double max_spindle_rpm = 0.0;
    double spindle_power_kw = 0.0;
    double efficiency = 0.8;
    double bending_n_per_mm2 = 1000.0;  ///< allowed, cemented carbide
    double deflection_mm = 0.05;        ///< allowed at the tip
    double modulus_n_per_mm2 = 600000.0;
    double engagement_deg = 0.0;
};

struct CuttingLoad {
    double feed_mm_per_min = 0.0;
    double mrr_mm3_per_min = 0.0;  ///< eq. 4
    double power_kw = 0.0;
    double force_n = 0.0;  ///< tangential, largest chip of the straight cut times the teeth in it
    double bending_n_per_mm2 = 0.0;
    double deflection_mm = 0.0;
    double engagement_deg = 0.0;  ///< of a straight cut, acos(1 − 2 ae / D)
};

[[nodiscard]] CuttingLoad loadOf(const CuttingData& data, const CutterLimits& limits, double kc_n_per_mm2);
/// Empty where every limit is kept, else the first that is not, in words.
[[nodiscard]] std::string infeasibility(const CuttingData& data, const CutterLimits& limits, double kc_n_per_mm2);

}  // namespace cusp::pocket
