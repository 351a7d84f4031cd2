// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How a job is set up in the machine, as data: where the workpiece lies, how long the tools are, what else stands there.
// The post's writer and its independent reader share this and the machine file.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/base/toml_schema.hpp>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::machine {

/// One line of the control's offset table.
struct WorkOffset {
    /// Origin of the workpiece frame in the machine frame, all axes at zero. What an 840D shows for the offset plus the
    /// spindle's gauge point.
    std::array<double, 3> origin_mm{};
};

/// How long a tool is on this machine. `name` and `number` are those the program calls it by.
struct SetupTool {
    std::optional<std::int64_t> number;
    std::string name;
    double length_mm = 0.0;  ///< gauge point to tip
};

/// Something that stands in the machine: a box, or a mesh by its file name. The post lists it and says that the path is not checked
/// against it.
struct Fixture {
    std::string name;
    std::string work_offset;  ///< frame it is given in; empty: the machine frame, all axes at zero
    std::optional<std::array<double, 3>> min_mm;
    std::optional<std::array<double, 3>> max_mm;
    std::string stl;
};

struct SetupDefinition {
    std::int64_t schema = 1;
    std::string name;
    std::string description;
    std::string tool_library;  ///< path, relative to the setup file; whoever opens files adds its tools
    std::map<std::string, WorkOffset> work_offsets;
    std::vector<SetupTool> tools;
    std::vector<Fixture> fixtures;

    /// Null when the setup does not say where this offset lies.
    [[nodiscard]] const WorkOffset* findOffset(const std::string& offset) const;
    /// By what a program calls: the name where it gives one, else the number. Absent when the setup has no such tool.
    [[nodiscard]] std::optional<double> toolLength(std::optional<std::int64_t> number, std::string_view tool) const;
};

/// The field table of a setup file, with its checks: `setup.*` errors at the key they speak of.
[[nodiscard]] const base::Section<SetupDefinition>& setupSection();

/// Errors: those of `TomlDocument`, `toml.*` of the field table, `setup.*`; all of them at once.
[[nodiscard]] base::Result<SetupDefinition> readSetupFile(const std::string& path);
/// The same from a text; `file_name` is for messages.
[[nodiscard]] base::Result<SetupDefinition> readSetup(std::string_view text, const std::string& file_name);

}  // namespace cusp::machine
