// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The virtual control against the clock: time of the machine over processor time, for a five-axis program of 65 000 blocks.
#include <cusp/comm/controller/virtual_control.hpp>

#include <algorithm>
#include <array>
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

/// The largest share of any axis' velocity, acceleration and jerk in any sample.
class LimitUse {
public:
    LimitUse(const cusp::dynamics::AxisLimits& limits, double tick_s) : limits_(limits), t_(tick_s) {}

    void take(const cusp::comm::ControlSample& sample) {
        ++samples_;
        last_ = {sample.axes, last_[0], last_[1], last_[2]};
        if (samples_ < last_.size()) return;
        const auto& [q0, q1, q2, q3] = last_;
        for (std::size_t i = 0; i < limits_.count; ++i)
            most_ = std::max({most_, std::abs(q0[i] - q1[i]) / (t_ * limits_.velocity[i]),
                              std::abs(q0[i] - 2.0 * q1[i] + q2[i]) / (t_ * t_ * limits_.acceleration[i]),
                              std::abs(q0[i] - 3.0 * q1[i] + 3.0 * q2[i] - q3[i]) / (t_ * t_ * t_ * limits_.jerk[i])});
    }
    [[nodiscard]] std::size_t samples() const { return samples_; }
    [[nodiscard]] double most() const { return most_; }

private:
    cusp::dynamics::AxisLimits limits_;
    double t_;
    std::array<cusp::dynamics::AxisVector, 4> last_{};
    std::size_t samples_ = 0;
    double most_ = 0.0;
};

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
        LimitUse use(cusp::dynamics::limitsOf(machine), options.tick_s);
        control.record([&use](const cusp::comm::ControlSample& sample) { use.take(sample); });
        if (!control.select("P.MPF", program(step_mm)) || !control.start()) return 1;
        const std::clock_t begin = std::clock();
        control.runToRest(1e6);
        const double cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
        const auto& status = control.status();
        std::printf("%.1f mm a block: %s, %.1f s on the machine in %.2f s: %.0f times real time; "
                    "at most %.3f of any limit in %zu samples\n",
                    step_mm, status.finished ? "finished" : "NOT FINISHED", status.time_s, cpu_s, status.time_s / cpu_s,
                    use.most(), use.samples());
    }
    return 0;
}
