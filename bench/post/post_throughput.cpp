// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Posting a million five-axis points against the limit program, and the memory of posting ten million.
//
//   bench_post_throughput [points] [points for the memory row]
#include "limit_program.hpp"

#include <cusp/base/child_process.hpp>
#include <cusp/kinematics/machine.hpp>
#include <cusp/post/control/control_definition.hpp>
#include <cusp/post/writer/program_planner.hpp>
#include <cusp/post/writer/sinumerik_writer.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <string>
#include <vector>

namespace {

/// A zig-zag over a bump with a tool axis that leans up to 20° and turns with the surface: nothing repeats.
void writePath(const std::string& file_name, std::uint64_t points) {
    std::FILE* out = std::fopen(file_name.c_str(), "w");
    std::fputs("UNITS/MM\nTOOL PATH/BENCH,TOOL,BALL_6\nTLDATA/MILL,6.0,3.0,50.0,0.0,0.0\n"
               "MSYS/0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0\nSPINDL/RPM,9000,CLW\nFEDRAT/MMPM,3000.0\n",
               out);
    constexpr std::uint64_t per_pass = 2000;
    for (std::uint64_t i = 0; i < points; ++i) {
        const std::uint64_t pass = i / per_pass;
        const double along = static_cast<double>(i % per_pass) / per_pass;
        const double x = 400.0 * (pass % 2 == 0 ? along : 1.0 - along);
        const double y = 0.0371 * static_cast<double>(pass);
        const double lean = 0.2 + 0.15 * std::sin(0.013 * x + 0.05 * y);
        const double turn = 0.9 * std::sin(0.017 * x) + 0.01 * y;
        std::fprintf(out, "GOTO/%.4f,%.4f,%.4f,%.7f,%.7f,%.7f\n", x, y, 20.0 * std::sin(0.01 * x) * std::cos(0.02 * y),
                     std::sin(lean) * std::cos(turn), std::sin(lean) * std::sin(turn), std::cos(lean));
    }
    std::fputs("END-OF-PATH\n", out);
    std::fclose(out);
}

using Threads = cusp::post::ProgramPlanner::Threads;

double secondsOn(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Processor time of the reading thread of the last posting with two.
double reading_s = 0.0;

/// The whole way of `cusp post`, output thrown away.
std::uint64_t post(const std::string& file_name, Threads threads) {
    const auto machine_file =
        cusp::post::readMachineFile(std::string(CUSP_SOURCE_DIR) + "/machines/fooke-endura-ca.toml").value();
    const cusp::kinematics::Machine machine(machine_file.machine);
    std::FILE* sink = std::fopen("/dev/null", "w");
    cusp::post::SinumerikWriter writer(
        [sink](std::string_view text) { std::fwrite(text.data(), 1, text.size(), sink); }, machine_file,
        {"BENCH", "", {}});
    cusp::base::Diagnostics report;
    cusp::post::ProgramPlanner planner(machine_file, machine, {}, file_name, writer, report);
    std::ifstream in(file_name, std::ios::binary);
    cusp::toolpath::ClReader reader(in, file_name);
    const auto source = [&reader](cusp::toolpath::ClRecord& record) {
        const bool more = reader.next(record);
        if (!more) reading_s = secondsOn(CLOCK_THREAD_CPUTIME_ID);
        return more;
    };
    const auto summary = planner.run(source, threads);
    writer.finish();
    std::fclose(sink);
    if (report.hasErrors() || reader.report().hasErrors()) {
        std::fputs(cusp::base::toText(report).c_str(), stderr);
        std::exit(1);
    }
    return summary.cutter_locations;
}

std::uint64_t limit(const std::string& file_name) {
    std::FILE* in = std::fopen(file_name.c_str(), "rb");
    std::FILE* sink = std::fopen("/dev/null", "w");
    const std::uint64_t points = cusp::bench::runLimitProgram(in, sink);
    std::fclose(in);
    std::fclose(sink);
    return points;
}

std::uint64_t postOnOne(const std::string& file_name) { return post(file_name, Threads::One); }
std::uint64_t postOnTwo(const std::string& file_name) { return post(file_name, Threads::Two); }

struct Taken {
    double wall_s = 0.0;
    double processor_s = 0.0;  ///< of all threads
};

Taken timeOf(std::uint64_t (*work)(const std::string&), const std::string& file_name, std::uint64_t expected) {
    const double wall = secondsOn(CLOCK_MONOTONIC);
    const double processor = secondsOn(CLOCK_PROCESS_CPUTIME_ID);
    if (work(file_name) != expected) {
        std::fputs("a program lost points\n", stderr);
        std::exit(1);
    }
    return {secondsOn(CLOCK_MONOTONIC) - wall, secondsOn(CLOCK_PROCESS_CPUTIME_ID) - processor};
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

void printRow(const char* name, const std::vector<double>& wall_s, const std::vector<double>& processor_s,
              const std::vector<double>& limit_wall_s, const std::vector<double>& limit_processor_s) {
    std::printf("%-36s %8.3f s %6.2f %12.3f s %6.2f\n", name, median(wall_s), median(wall_s) / median(limit_wall_s),
                median(processor_s), median(processor_s) / median(limit_processor_s));
}

/// On a busy machine wall times say nothing: processor time is what a thread needs with a core of its own. With two threads
/// that is the busier one's.
void printSpeed(const std::string& file_name, std::uint64_t points) {
    writePath(file_name, points);
    std::array<std::vector<double>, 3> wall_s;
    std::array<std::vector<double>, 3> processor_s;
    // In turns, so that a busy machine is busy for all.
    for (int round = 0; round < 5; ++round) {
        const Taken limited = timeOf(limit, file_name, points);
        const Taken one = timeOf(postOnOne, file_name, points);
        const Taken two = timeOf(postOnTwo, file_name, points);
        const double busier_s = std::max(reading_s, two.processor_s - reading_s);
        const std::array<double, 3> wall{limited.wall_s, one.wall_s, two.wall_s};
        const std::array<double, 3> processor{limited.processor_s, one.processor_s, busier_s};
        for (std::size_t i = 0; i < 3; ++i) {
            wall_s[i].push_back(wall[i]);
            processor_s[i].push_back(processor[i]);
        }
    }
    std::printf("%-36s %10s %6s %14s %6s\n", "", "wall", "ratio", "processor", "ratio");
    const std::array<const char*, 3> names{"limit program (parse, trig, print)", "cusp post, one thread, goal 1.5",
                                           "cusp post, two threads, goal 1.0"};
    for (std::size_t i = 0; i < 3; ++i) printRow(names[i], wall_s[i], processor_s[i], wall_s[0], processor_s[0]);
}

void printMemory(const char* program, const std::string& file_name, std::uint64_t points) {
    writePath(file_name, points);
    const auto outcome = cusp::base::runProcess({program, "--post", file_name});
    if (!outcome || !outcome->succeeded()) {
        std::fputs("posting the long path failed\n", stderr);
        std::exit(1);
    }
    std::printf("peak memory, %llu points %16.1f MB, goal below 64\n", static_cast<unsigned long long>(points),
                static_cast<double>(outcome->peak_memory_bytes) / 1e6);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc == 3 && std::string_view(argv[1]) == "--post") return postOnTwo(argv[2]) > 0 ? 0 : 1;
    const std::uint64_t points = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000000;
    const std::uint64_t long_points = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 10000000;
    std::array<char, 32> name{"/tmp/cusp_bench_XXXXXX"};
    const int descriptor = ::mkstemp(name.data());
    if (descriptor < 0) return 1;
    std::printf("Posting a generated five-axis CL file of %llu points\n", static_cast<unsigned long long>(points));
    printSpeed(name.data(), points);
    printMemory(argv[0], name.data(), long_points);
    return std::remove(name.data());
}
