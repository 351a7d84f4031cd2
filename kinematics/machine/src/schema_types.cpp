// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reading and printing of directions and rotary poses.
#include "schema_types.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace cusp::machine {

void readValue(const base::TomlNode& node, const base::FieldInfo& info, Direction& out, base::Diagnostics& report) {
    std::array<double, 3> v{};
    const std::size_t errors_before = report.errorCount();
    base::readValue(node, info, v, report);
    if (report.errorCount() != errors_before) return;
    const double length = std::hypot(v[0], v[1], v[2]);
    // Below this the direction is noise, and its square would underflow.
    if (!(length > 1e-9) || !std::isfinite(length)) {
        report.error("machine.zero-direction", "a direction must not be zero", node.where());
        return;
    }
    // A printed direction must read back to the same bits, so one that is already unit is left alone.
    const bool is_unit = std::abs(length - 1.0) <= 2.0 * std::numeric_limits<double>::epsilon();
    for (std::size_t i = 0; i < 3; ++i) out[i] = is_unit ? v[i] : v[i] / length;
}

std::string printValue(const Direction& value, const base::FieldInfo& info) {
    const std::array<double, 3>& components = value;
    return base::printValue(components, info);
}

void readValue(const base::TomlNode& node, const base::FieldInfo& info, RotaryPose& out, base::Diagnostics& report) {
    if (!node.isTable()) return base::reportWrongType(node, info, report);
    RotaryPose pose;
    for (const std::string& name : node.keys())
        if (const auto angle = node.at(name)) base::readValue(*angle, info, pose[name], report);
    out = std::move(pose);
}

std::string printValue(const RotaryPose& value, const base::FieldInfo& info) {
    if (value.empty()) return "{}";
    std::string out = "{";
    for (const auto& [name, angle] : value)
        out += (out.size() > 1 ? ", " : " ") + name + " = " + base::printValue(angle, info);
    return out + " }";
}

}  // namespace cusp::machine
