// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Programs, samples and their differences.
#include "control_bench.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <sstream>

namespace cusp::comm::test {

namespace {

ControlOptions placed(ControlOptions options) {
    if (options.wcs_origin_mm.isZero()) options.wcs_origin_mm = {300.0, 0.0, -700.0};
    return options;
}

}  // namespace

post::MachineFile shippedMachine(const std::string& name) {
    const auto file = post::readMachineFile(std::string(CUSP_SOURCE_DIR) + "/machines/" + name + ".toml");
    EXPECT_TRUE(file.has_value()) << base::toText(file.error());
    return *file;
}

Bench::Bench(const std::string& machine_name, const ControlOptions& wanted)
    : file(shippedMachine(machine_name)),
      machine(file.machine),
      options(placed(wanted)),
      control(file, machine, options) {
    control.record([this](const ControlSample& sample) { samples.push_back(sample); });
}

double Bench::limitUse() const {
    const dynamics::AxisLimits limits = dynamics::limitsOf(machine);
    const double t = options.tick_s;
    double most = 0.0;
    for (std::size_t k = 3; k < samples.size(); ++k)
        for (std::size_t i = 0; i < limits.count; ++i) {
            const double q0 = samples[k].axes[i];
            const double q1 = samples[k - 1].axes[i];
            const double q2 = samples[k - 2].axes[i];
            const double q3 = samples[k - 3].axes[i];
            most = std::max({most, std::abs(q0 - q1) / (t * limits.velocity[i]),
                             std::abs(q0 - 2.0 * q1 + q2) / (t * t * limits.acceleration[i]),
                             std::abs(q0 - 3.0 * q1 + 3.0 * q2 - q3) / (t * t * t * limits.jerk[i])});
        }
    return most;
}

dynamics::ToolPlace Bench::toolAt(const ControlSample& sample) const {
    return dynamics::ToolPath(machine, options.tool_length_mm, options.wcs_origin_mm).placeOf(sample.axes);
}

double Bench::missOf(const std::vector<geometry::Vector3>& path, std::size_t first_line, std::size_t last_line) const {
    double worst = 0.0;
    for (const ControlSample& sample : samples) {
        if (sample.line < first_line || sample.line > last_line) continue;
        const geometry::Vector3 tip = toolAt(sample).tip_mm;
        double least = 1e9;
        for (std::size_t k = 1; k < path.size(); ++k) {
            const geometry::Vector3 along = path[k] - path[k - 1];
            const double u = std::clamp((tip - path[k - 1]).dot(along) / along.squaredNorm(), 0.0, 1.0);
            least = std::min(least, (tip - path[k - 1] - u * along).norm());
        }
        worst = std::max(worst, least);
    }
    return worst;
}

FiveAxisProgram fiveAxisProgram(std::size_t blocks, double step_mm) {
    FiveAxisProgram out;
    std::ostringstream text;
    text.setf(std::ios::fixed);
    text.precision(5);
    text << "G40 G17 G710 G94 G90 G60 G601\nTRAFOOF\nSUPA G0 Z0 D0\nT=\"BALL_10\"\nM6\nD1\n"
         << "CYCLE832(0.01,_ORI_FINISH,0.1)\nG54\nS8000 M3\nG0 C20 A15\nTRAORI\nG54\nORIAXES\n"
         << "G0 X0 Y0 C20 A15\nZ50\nG1 Z0 F3000\n";
    std::size_t line = 16;
    out.first_cut_line = line + 1;
    out.tips.emplace_back(0.0, 0.0, 0.0);
    for (std::size_t i = 1; i <= blocks; ++i) {
        const double s = step_mm * static_cast<double>(i);
        const double x = 40.0 * std::sin(s / 40.0);
        const double y = 0.05 * s + 0.4 * std::sin(s / 7.0);
        const double z = 2.0 * std::cos(s / 25.0) - 2.0;
        char block[128];
        std::snprintf(block, sizeof block, "X%.5f Y%.5f Z%.5f C%.5f A%.5f\n", x, y, z, 20.0 + 10.0 * std::sin(s / 60.0),
                      15.0 + 5.0 * std::sin(s / 45.0));
        text << block;
        out.tips.emplace_back(x, y, z);
    }
    text << "G0 Z100\nTRAFOOF\nSUPA G0 Z0 D0\nM30\n";
    out.last_cut_line = line + blocks;
    out.text = text.str();
    return out;
}

}  // namespace cusp::comm::test
