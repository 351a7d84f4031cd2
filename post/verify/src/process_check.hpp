// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Feed, spindle, tool, coolant, tool length and work offset of a cutting block against the CL file.
#pragma once

#include "expected_path.hpp"
#include "findings.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace cusp::post::verify {

struct ProcessLimits {
    double feed_tolerance = 0.0;
    double speed_tolerance_rpm = 0.0;
    int cutting_edge = 1;
    std::string_view plane;  ///< perpendicular to the spindle; empty: not checked
    /// Of the programming frames in the order they come in; those behind the last are the next settable frames. Empty: not
    /// checked.
    std::vector<std::string> work_offsets;
};

/// For feed motions: rapids may run before the spindle is up.
void checkProcess(const reader::ExecutedMotion& motion, const ExpectedProcess& expected, std::size_t cl_line,
                  const ProcessLimits& limits, Findings& findings);

}  // namespace cusp::post::verify
