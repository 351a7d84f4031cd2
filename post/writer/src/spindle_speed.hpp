// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Spindle speed from what SPINDL says: a speed, a surface speed, or only "on".
#pragma once

#include <cusp/geometry/cutter.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <numbers>
#include <optional>
#include <string>
#include <tl/expected.hpp>

namespace cusp::post {

/// rev/min; `last_rpm` serves SPINDL/ON. The error is the sentence to report: a surface speed needs the cutter's diameter.
[[nodiscard]] inline tl::expected<double, std::string>
spindleSpeed(const toolpath::SpindleCommand& command, const std::optional<geometry::Cutter>& cutter, double last_rpm) {
    if (!command.speed) return last_rpm;
    if (command.unit == toolpath::SpindleCommand::Unit::Rpm) return *command.speed;
    if (!cutter || cutter->diameter_mm <= 0.0)
        return tl::unexpected<std::string>(
            "a surface speed, but the file gives no cutter diameter to turn it into rev/min");
    return *command.speed * 1000.0 / (std::numbers::pi * cutter->diameter_mm);
}

}  // namespace cusp::post
