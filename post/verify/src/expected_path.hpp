// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The CL file as the verifier needs it: points in order, each with the process state it is reached in.
#pragma once

#include <cusp/post/reader/executed_program.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::post::verify {

struct ExpectedProcess {
    std::optional<toolpath::FeedRate> feed;
    toolpath::SpindleCommand::Turn turn = toolpath::SpindleCommand::Turn::Off;
    std::optional<double> rpm;  ///< absent when the CL file gives none, or a cutting speed
    std::optional<toolpath::CoolantCommand::Kind> coolant;
    std::optional<std::int64_t> tool_number;
    std::string tool_name;
};

struct ExpectedPoint {
    reader::ToolPose pose;
    std::uint32_t line = 0;
    std::uint32_t process = 0;  ///< index into `ExpectedPath::processes`
    bool rapid = false;
    bool opens = false;  ///< first of an operation or after a tool call or stop: the program may link before it
};

struct ExpectedPath {
    std::vector<ExpectedPoint> points;
    std::vector<ExpectedProcess> processes;
};

/// What the verifier cannot judge so far becomes the error `verify.unsupported` in `report`.
[[nodiscard]] ExpectedPath expectedPath(const toolpath::ToolPath& path, base::Diagnostics& report);

}  // namespace cusp::post::verify
