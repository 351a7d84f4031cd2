// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// First come, first placed.
#include "work_offsets.hpp"

#include <algorithm>
#include <charconv>

namespace cusp::post {

namespace {

// Frames of one CL file that agree to its last decimals are one frame.
constexpr double same_frame = 1e-6;

}  // namespace

std::string nextSettableFrame(const std::string& name) {
    int number = 0;
    std::from_chars(name.data() + 1, name.data() + name.size(), number);
    if (number == 57) return "G505";
    const bool has_next = (number >= 54 && number < 57) || (number >= 505 && number < 599);
    return has_next ? "G" + std::to_string(number + 1) : std::string();
}

std::string WorkOffsets::take(const geometry::RigidTransform& part_from_programming, std::uint32_t line) {
    const auto known = std::find_if(used_.begin(), used_.end(), [&](const UsedWorkOffset& offset) {
        return (offset.part_from_programming.matrix() - part_from_programming.matrix()).cwiseAbs().maxCoeff() <
               same_frame;
    });
    if (known != used_.end()) return known->name;
    std::string name = used_.size() < names_.size() ? names_[used_.size()] : nextSettableFrame(used_.back().name);
    // A name given for an earlier frame, or none left.
    const bool taken = std::any_of(used_.begin(), used_.end(), [&](const auto& offset) { return offset.name == name; });
    if (name.empty() || taken) return {};
    used_.push_back({name, part_from_programming, line});
    return name;
}

}  // namespace cusp::post
