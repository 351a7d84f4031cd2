// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The virtual control against the clock: time of the machine over processor time, for a five-axis program of 65 000 blocks.
#include <cusp/comm/controller/virtual_control.hpp>

#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>

namespace {

constexpr int blocks = 65'000;

std::string program(double step_mm) {
    std::string text = "G40 G17 G710 G94 G90 G60 G601\nTRAFOOF\nSUPA G0 Z0 D0\nT=\"BALL_10\"\nM6\nD1\n"
                       "CYCLE832(0.01,_ORI_FINISH,0.1)\nG54\nS8000 M3\nG0 C20 A15\nTRAORI\nG54\nORIAXES\n"
                       "G0 X0 Y0 C20 A15\nZ50\nG1 Z0 F3000\n";
    for (int i = 1; i <= blocks; ++i) {
        const double s = step_mm * i;
        char block[160];
        std::snprintf(block, sizeof block, "X%.5f Y%.5f Z%.5f C%.5f A%.5f\n", 150.0 * std::sin(s / 150.0),
                      150.0 * std::cos(s / 150.0) - 150.0, 2.0 * std::cos(s / 25.0) - 2.0,
                      20.0 + 10.0 * std::sin(s / 60.0), 15.0 + 5.0 * std::sin(s / 45.0));
        text += block;
    }
    return text + "G0 Z100\nTRAFOOF\nSUPA G0 Z0 D0\nM30\n";
}

}  // namespace

int main() {
    const auto file = cusp::post::readMachineFile(CUSP_SOURCE_DIR "/machines/fooke-endura-ca.toml");
    if (!file) return 1;
    const cusp::kinematics::Machine machine(file->machine);
    cusp::comm::ControlOptions options;
    options.wcs_origin_mm = {3000.0, 0.0, -700.0};
    std::printf("five-axis program of %d blocks, sampled every %g ms\n", blocks, options.tick_s * 1e3);
    for (const double step_mm : {0.2, 0.5, 1.0}) {
        cusp::comm::VirtualControl control(*file, machine, options);
        if (!control.select("P.MPF", program(step_mm)) || !control.start()) return 1;
        const std::clock_t begin = std::clock();
        control.runToRest(1e6);
        const double cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        const auto& status = control.status();
        std::printf("%.1f mm a block: %s, %.1f s on the machine in %.2f s: %.0f times real time\n", step_mm,
                    status.finished ? "finished" : "NOT FINISHED", status.time_s, cpu_s, status.time_s / cpu_s);
    }
    return 0;
}
