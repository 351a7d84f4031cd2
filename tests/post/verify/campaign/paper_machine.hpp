// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a machine does with a drawn program, harmed or not, worked out beside the reader: the judge of the campaign.
#pragma once

#include "drawn_program.hpp"

#include <vector>

namespace cusp::post::verify::test {

/// What holds during a motion; of a rapid only tool, tool length and work offset count.
struct TraceState {
    bool rapid = false;
    bool placed = true;  ///< the program says where the tip is
    double feed_mm_per_min = 0.0;
    int spindle = 0;  ///< 3, 4 or 5 as the M functions
    double rpm = 0.0;
    double tool = 0.0;
    double cutting_edge = 0.0;
    double work_offset = 0.0;
    double plane = 17.0;
    bool mist = false;
    bool flood = false;
    double dwell_s = 0.0;  ///< no motion but a stop, at its place
};

struct TracePose {
    Vector3d tip_mm = Vector3d::Zero();
    Vector3d axis = Vector3d::UnitZ();
};

struct TraceMotion {
    TraceState state;
    std::vector<TracePose> poses;  ///< along the motion, close enough for 0.2 µm and 0.1°; the last is its end
    double rotary_travel_deg = 0.0;
};

/// Links are left out, and the way from a link to the first pose after it.
[[nodiscard]] std::vector<TraceMotion> trace(const DrawnProgram& program);

/// Whether the second does something else on the way of the first: a place in another state; the tip more than 2 µm off,
/// or a way back and forth; the tool axis more than 0.002° off at the ends of blocks, 3° between them; rotary axes that go
/// another way round (60° more or less altogether in cuts).
[[nodiscard]] bool differ(const std::vector<TraceMotion>& first, const std::vector<TraceMotion>& second);

}  // namespace cusp::post::verify::test
