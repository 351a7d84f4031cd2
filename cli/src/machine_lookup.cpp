// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Looks for machine files as a path first, then among those that ship.
#include "machine_lookup.hpp"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

namespace cusp::cli {

namespace fs = std::filesystem;

namespace {

fs::path shippedMachines() {
    std::error_code ignored;
    const fs::path command = fs::read_symlink("/proc/self/exe", ignored);
    return command.parent_path().parent_path() / "share/cusp/machines";
}

std::string shippedNames(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (it->path().extension() == ".toml") names.push_back(it->path().stem().string());
    std::sort(names.begin(), names.end());
    std::string out;
    for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
    return out;
}

}  // namespace

base::Result<std::string> findMachineFile(const std::string& path_or_name) {
    std::error_code ignored;
    if (fs::exists(path_or_name, ignored)) return path_or_name;
    const fs::path folder = shippedMachines();
    // A name, not a path: what ships is never reached through "../".
    if (path_or_name.find('/') == std::string::npos) {
        const fs::path shipped = folder / (path_or_name + ".toml");
        if (fs::exists(shipped, ignored)) return shipped.string();
    }
    const std::string names = shippedNames(folder);
    return base::fail("cli.no-machine",
                      "no machine file \"" + path_or_name + "\"" +
                          (names.empty() ? std::string() : "; machines that ship with cusp: " + names));
}

base::Result<LoadedMachine> loadMachine(const std::string& path_or_name) {
    auto path = findMachineFile(path_or_name);
    if (!path) return base::fail(std::move(path).error());
    auto file = post::readMachineFile(*path);
    if (!file) return base::fail(std::move(file).error());
    kinematics::Machine model(file->machine);
    return LoadedMachine{*std::move(path), *std::move(file), std::move(model)};
}

}  // namespace cusp::cli
