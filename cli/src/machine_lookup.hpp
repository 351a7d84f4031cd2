// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Finds a machine file by path or by the name of one that ships with cusp.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/kinematics/machine.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <string>

namespace cusp::cli {

/// "my/machine.toml", or "fooke-endura-ca" for machines/fooke-endura-ca.toml beside the command (bin/../share/cusp).
/// Error `cli.no-machine` lists the names that ship.
[[nodiscard]] base::Result<std::string> findMachineFile(const std::string& path_or_name);

/// A machine file and the model made of it.
struct LoadedMachine {
    std::string path;
    post::MachineFile file;
    kinematics::Machine model;

    /// No pose of it is known from outside cusp, so that no check sees a wrong sign in its file. A machine that turns nothing
    /// has nothing to anchor.
    [[nodiscard]] bool unanchored() const { return file.machine.anchors.empty() && model.rotaryCount() > 0; }
};

/// Said whenever an unanchored machine is used.
inline constexpr const char* unanchored_text =
    "  this machine is unanchored: no pose of it is known from outside, and a wrong sign in its file would not be seen\n";

[[nodiscard]] base::Result<LoadedMachine> loadMachine(const std::string& path_or_name);

}  // namespace cusp::cli
