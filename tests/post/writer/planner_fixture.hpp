// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CL text planned for a gantry with a C-then-A head of round numbers, and the steps as text.
#pragma once

#include <cusp/post/writer/program_planner.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <gtest/gtest.h>
#include <sstream>
#include <string>
#include <vector>

namespace cusp::post {

class Collector : public NcSink {
public:
    explicit Collector(std::vector<std::string> rotary_names) : names(std::move(rotary_names)) {}
    void step(const NcStep& step) override { text += toText(step, names) + "\n"; }

    std::vector<std::string> names;
    std::string text;
};

class Planner : public ::testing::Test {
protected:
    Planner() : file(parseMachineFile(machine_text, "head.toml").value()) {}

    std::string plan(const std::string& cl_text, PostOptions options = {}) {
        const kinematics::Machine machine(file.machine);
        Collector collector(machine.rotaryNames());
        ProgramPlanner planner(file, machine, std::move(options), "part.cls", collector, report);
        // A file that does not say where it ends is not whole.
        const bool ends = cl_text.ends_with("END-OF-PATH\n") || cl_text.ends_with("FINI\n");
        std::istringstream in(ends ? cl_text : cl_text + "FINI\n");
        toolpath::ClReader reader(in, "part.cls");
        for (toolpath::ClRecord record; reader.next(record);) planner.take(record);
        summary = planner.finish();
        EXPECT_FALSE(reader.report().hasErrors()) << base::toText(reader.report());
        return collector.text;
    }

    static constexpr const char* machine_text = R"(
schema = 1
name = "head"
chain = ["workpiece", "base", "X", "Y", "Z", "C", "A", "tool"]
[linear.X]
direction = [1, 0, 0]
min_mm = -1000
max_mm = 1000
home_mm = 0
max_velocity_mm_per_min = 30000
max_acceleration_mm_per_s2 = 3000
max_jerk_mm_per_s3 = 30000
[linear.Y]
direction = [0, 1, 0]
min_mm = -1000
max_mm = 1000
home_mm = 0
max_velocity_mm_per_min = 30000
max_acceleration_mm_per_s2 = 3000
max_jerk_mm_per_s3 = 30000
[linear.Z]
direction = [0, 0, 1]
min_mm = -1000
max_mm = 1000
home_mm = 900
max_velocity_mm_per_min = 30000
max_acceleration_mm_per_s2 = 3000
max_jerk_mm_per_s3 = 30000
[rotary.C]
direction = [0, 0, 1]
point_mm = [0, 0, 0]
winding = "limited"
min_deg = -200
max_deg = 200
home_deg = 0
max_velocity_deg_per_s = 90
max_acceleration_deg_per_s2 = 300
max_jerk_deg_per_s3 = 3000
[rotary.A]
direction = [1, 0, 0]
point_mm = [0, 0, 200]
winding = "limited"
min_deg = -95
max_deg = 95
home_deg = 0
max_velocity_deg_per_s = 90
max_acceleration_deg_per_s2 = 300
max_jerk_deg_per_s3 = 3000
[spindle]
axis = [0, 0, 1]
gauge_point_mm = [0, 0, 0]
max_speed_rpm = 12000
[control]
kind = "sinumerik-840d"
)";
    static constexpr const char* head = "TOOL PATH/OP1,TOOL,BALL_6\n"
                                        "TLDATA/MILL,6.0,3.0,50.0,0.0,0.0\n"
                                        "MSYS/0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0\n";

    MachineFile file;
    base::Diagnostics report;
    PostSummary summary;
};

}  // namespace cusp::post
