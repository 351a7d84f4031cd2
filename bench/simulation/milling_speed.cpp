// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a milling simulation costs: a finishing path of 65 000 lines at several resolutions, and the cost against moves,
// resolution and tool.
#include <cusp/simulation/milling.hpp>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string_view>
#include <vector>

namespace {

using namespace cusp;
using namespace cusp::simulation;
using geometry::Vector3;

constexpr double width_mm = 160.0;

/// A mould's cavity without a corner in it, 5 to 31 mm below the top.
double depthAt(double x, double y) {
    return 18.0 + 8.0 * std::sin(x / 17.0) * std::cos(y / 23.0) + 5.0 * std::sin((x + y) / 31.0);
}

/// Zig-zag over the whole mould; `lean_rad` tilts the axis by as much to and fro: simultaneous five-axis motion.
std::vector<ToolMove> finishing(int passes, int lines, double lean_rad, double long_mm = width_mm,
                                double wide_mm = width_mm) {
    std::vector<ToolMove> out;
    toolpath::CutterLocation last;
    for (int p = 0; p < passes; ++p)
        for (int i = 0; i <= lines; ++i) {
            const double x = long_mm * (p % 2 == 0 ? i : lines - i) / lines;
            const double y = wide_mm * (p + 0.5) / passes;
            const Vector3 axis =
                Vector3(lean_rad * std::sin(x / 30.0), lean_rad * std::cos(y / 30.0 + x / 50.0), 1.0).normalized();
            const toolpath::CutterLocation next{Vector3(x, y, -depthAt(x, y)), axis};
            if (p > 0 || i > 0) out.push_back({last, next, toolpath::MotionKind::Feed, 0, 0});
            last = next;
        }
    return out;
}

geometry::Cutter toroid(double diameter_mm, double corner_mm) {
    return {diameter_mm, corner_mm, diameter_mm / 2.0 - corner_mm, corner_mm, 0.0, 0.0, 50.0};
}

struct Measured {
    double wall_s, cpu_s, removed_mm3;
};

const Eigen::AlignedBox3d mould(Vector3(0, 0, -40), Vector3(width_mm, width_mm, 0));

Measured run(const std::vector<ToolMove>& moves, const ToolAssembly& tool, double resolution_mm,
             const Eigen::AlignedBox3d& box = mould) {
    Stock stock = Stock::box(box, {resolution_mm, std::uint64_t{8} << 30U}).value();
    const auto begin = std::chrono::steady_clock::now();
    const std::clock_t cpu = std::clock();
    const MillingReport report = mill(stock, moves, std::span(&tool, 1)).value();
    return {std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(),
            static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC, report.removed_volume_mm3};
}

void line(const char* what, const std::vector<ToolMove>& moves, const ToolAssembly& tool, double resolution_mm) {
    double length = 0.0;
    for (const ToolMove& m : moves) length += (m.to.tip_mm - m.from.tip_mm).norm();
    const Measured m = run(moves, tool, resolution_mm);
    std::printf("%-34s %7zu %8.1f %6.2f %8.2f %8.2f %9.0f %12.0f\n", what, moves.size(), length / 1e3, resolution_mm,
                m.wall_s, m.cpu_s, static_cast<double>(moves.size()) / m.cpu_s, m.removed_mm3);
}

}  // namespace

int main(int count, char** words) {
    const bool fine = count > 1 && std::string_view(words[1]) == "fine";
    std::printf("Milling a block of 160 x 160 x 40 mm; CPU time is that of all threads together\n");
    std::printf("%-34s %7s %8s %6s %8s %8s %9s %12s\n", "path and tool", "lines", "metres", "mm", "wall s", "CPU s",
                "lines/CPUs", "removed mm3");
    const auto ball6 = assemblyOf(toroid(6.0, 3.0)).value();
    const auto ball2 = assemblyOf(toroid(2.0, 1.0)).value();
    const auto torus16 = assemblyOf(toroid(16.0, 3.0)).value();
    const auto three = finishing(200, 324, 0.0);
    line("three-axis, ball D6", three, ball6, 0.5);
    line("five-axis, ball D6", finishing(200, 324, 0.3), ball6, 0.5);
    line("three-axis, ball D2", three, ball2, 0.5);
    line("three-axis, torus D16 r3", three, torus16, 0.5);
    line("three-axis, ball D6, half the path", finishing(100, 324, 0.0), ball6, 0.5);
    line("three-axis, ball D6, short lines", finishing(200, 648, 0.0), ball6, 0.5);
    line("three-axis, ball D6", three, ball6, 0.25);
    if (fine) line("three-axis, ball D6", three, ball6, 0.1);
    constexpr double camotics_moves_per_s = 353.0;
    const auto same = finishing(120, 220, 0.0, 94.5, 103.0);
    const Measured m = run(same, ball6, 0.5, {Vector3(0, 0, -50), Vector3(94.5, 103.0, 0)});
    const double rate = static_cast<double>(same.size()) / m.cpu_s;
    std::printf(
        "94.5 x 103 x 50 mm, ball D6, 0.5 mm: %.0f moves a CPU second; CAMotics, measured before on such a machine "
        "with two threads and another path: %.0f moves/s; ratio at equal threads %.0f\n",
        rate, camotics_moves_per_s, 2.0 * rate / camotics_moves_per_s);
    return 0;
}
