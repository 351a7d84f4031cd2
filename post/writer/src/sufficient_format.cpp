// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How many decimals block ends need.
#include <cusp/base/units.hpp>
#include <cusp/geometry/frames.hpp>
#include <cusp/post/writer/program_planner.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace cusp::post {

namespace {

constexpr double end_tolerance_mm = 0.001;
constexpr double end_tolerance_deg = 0.001;
// What the workpiece adds to the lever arms of the machine file.
constexpr double workpiece_mm = 1000.0;

/// So many that `parts` errors of half a unit each stay within `tolerance`; `unit` is what one unit before the point is
/// worth.
std::int64_t decimalsFor(double parts, double unit, double tolerance) {
    return std::max<std::int64_t>(0, static_cast<std::int64_t>(std::ceil(std::log10(0.5 * parts * unit / tolerance))));
}

double leverArm(const machine::MachineDefinition& machine) {
    double arm_mm = workpiece_mm;
    const auto gauge = geometry::toVector(machine.spindle.gauge_point_mm);
    for (const auto& [name, axis] : machine.rotary)
        arm_mm = std::max(arm_mm, (gauge - geometry::toVector(axis.point_mm)).norm());
    return arm_mm;
}

}  // namespace

NumberFormat sufficientFormat(const MachineFile& file, ProgramForm form, base::Diagnostics& report) {
    NumberFormat format = file.control.format;
    const auto raise = [&](std::int64_t& decimals, std::int64_t enough, const char* key) {
        if (decimals >= enough) return;
        report.warning("post.decimals",
                       fmt::format("{} is {} in the machine file; {} are written, so that block ends keep "
                                   "0.001 mm and 0.001°",
                                   key, decimals, enough));
        decimals = enough;
    };
    raise(format.linear_decimals, decimalsFor(std::sqrt(3.0), 1.0, end_tolerance_mm), "linear_decimals");
    std::int64_t rotary = decimalsFor(std::sqrt(2.0), 1.0, end_tolerance_deg);
    if (form == ProgramForm::Machine)
        rotary = std::max(
            rotary, decimalsFor(std::sqrt(2.0), leverArm(file.machine) * base::radFromDeg(1.0), end_tolerance_mm));
    if (!file.machine.rotary.empty()) raise(format.rotary_decimals, rotary, "rotary_decimals");
    if (form == ProgramForm::TraoriVectors)
        raise(format.vector_decimals, decimalsFor(std::sqrt(3.0), base::degFromRad(1.0), end_tolerance_deg),
              "vector_decimals");
    return format;
}

}  // namespace cusp::post
