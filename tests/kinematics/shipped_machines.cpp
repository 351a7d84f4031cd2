// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Machines for the tests.
#include "shipped_machines.hpp"

#include <cusp/base/units.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace cusp::kinematics::test {

using base::radFromDeg;

std::vector<std::string> shippedMachineNames() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/machines"))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

machine::MachineDefinition shippedMachine(const std::string& name) {
    auto file = post::readMachineFile(CUSP_SOURCE_DIR "/machines/" + name + ".toml");
    if (!file) throw std::runtime_error(base::toText(file.error()));
    return file->machine;
}

machine::MachineDefinition plainMachine(std::vector<std::string> chain) {
    machine::MachineDefinition machine;
    machine.chain = std::move(chain);
    machine.linear["X"].direction = {{1.0, 0.0, 0.0}};
    machine.linear["Y"].direction = {{0.0, 1.0, 0.0}};
    machine.linear["Z"].direction = {{0.0, 0.0, 1.0}};
    for (auto& [axis_name, axis] : machine.linear) {
        axis.min_mm = -1000.0;
        axis.max_mm = 1000.0;
        axis.max_velocity_mm_per_s = 500.0;
        axis.max_acceleration_mm_per_s2 = 3000.0;
        axis.max_jerk_mm_per_s3 = 30000.0;
    }
    machine.spindle.max_speed_rpm = 10000.0;
    return machine;
}

machine::RotaryAxis endlessAxis(const Vector3& direction) {
    const Vector3 unit = direction.normalized();
    machine::RotaryAxis axis;
    axis.direction = {{unit[0], unit[1], unit[2]}};
    axis.winding = machine::RotaryAxis::Winding::Endless;
    axis.max_velocity_rad_per_s = 1.0;
    axis.max_acceleration_rad_per_s2 = 10.0;
    axis.max_jerk_rad_per_s3 = 100.0;
    return axis;
}

machine::RotaryAxis limitedAxis(const Vector3& direction, double min_deg, double max_deg) {
    machine::RotaryAxis axis = endlessAxis(direction);
    axis.winding = machine::RotaryAxis::Winding::Limited;
    axis.min_rad = radFromDeg(min_deg);
    axis.max_rad = radFromDeg(max_deg);
    return axis;
}

}  // namespace cusp::kinematics::test
