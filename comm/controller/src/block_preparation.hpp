// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From lines of a program to what the interpolator runs: blocks in axis space, and what happens between them.
#pragma once

#include <cusp/comm/controller/virtual_control.hpp>

#include <cusp/dynamics/motion_planner.hpp>
#include <cusp/dynamics/tool_path.hpp>
#include <cusp/kinematics/machine.hpp>
#include <cusp/post/reader/executed_program.hpp>
#include <cusp/post/reader/forward_chain.hpp>

#include <deque>
#include <optional>
#include <string>
#include <variant>

namespace cusp::comm {

/// How long the tool is, and where the origin of the work offset lies.
struct ToolPlacement {
    double tool_length_mm = 0.0;
    geometry::Vector3 origin_mm = geometry::Vector3::Zero();

    [[nodiscard]] bool operator==(const ToolPlacement& other) const {
        return tool_length_mm == other.tool_length_mm && origin_mm == other.origin_mm;
    }
};

/// Something the machine comes to rest for.
struct RestEvent {
    enum class Kind { Dwell, Stop, OptionalStop, Placement, End };
    Kind kind = Kind::Dwell;
    std::size_t line = 0;
    double seconds = 0.0;     ///< of a dwell
    ToolPlacement placement;  ///< from here on
};

using PreparedItem = std::variant<dynamics::PathBlock, RestEvent>;

/// Knows where the axes will be at the end of what is prepared, and so also what the program leaves open.
class BlockPreparation : public post::reader::ProgramSink {
public:
    BlockPreparation(const post::MachineFile& file, const kinematics::Machine& machine, const ControlOptions& options);

    void motion(const post::reader::ExecutedMotion& motion) override;
    void event(const post::reader::BlockPlace& place, const post::reader::ExecutedEvent& event) override;

    /// A program begins here.
    void begin(const dynamics::AxisVector& axes);
    [[nodiscard]] std::deque<PreparedItem>& items() { return items_; }
    [[nodiscard]] const std::deque<PreparedItem>& items() const { return items_; }
    [[nodiscard]] const dynamics::AxisVector& axes() const { return axes_; }
    /// Set by a block that cannot be run; nothing is prepared after it.
    [[nodiscard]] const std::optional<Alarm>& alarm() const { return alarm_; }
    void setOverride(double override_share) { override_ = override_share; }
    [[nodiscard]] dynamics::ToolPath toolPath() const;
    [[nodiscard]] const ToolPlacement& placement() const { return placement_; }

private:
    [[nodiscard]] std::optional<dynamics::PathBlock> path(const post::reader::ExecutedMotion& motion);
    [[nodiscard]] std::optional<dynamics::PathBlock> tipPath(const post::reader::ExecutedMotion& motion);
    [[nodiscard]] dynamics::PathBlock axisPath(const post::reader::ExecutedMotion& motion);
    [[nodiscard]] std::optional<kinematics::RotaryValues> rotaryFor(const post::reader::Vector3& axis,
                                                                    const kinematics::RotaryValues& near) const;
    [[nodiscard]] kinematics::RotaryValues programmedRotary(const post::reader::ExecutedMotion& motion) const;
    [[nodiscard]] double feedOf(const post::reader::ExecutedMotion& motion, const dynamics::PathBlock& block) const;
    /// False, with the alarm set, where the setup does not say it.
    [[nodiscard]] bool place(const post::reader::ExecutedMotion& motion);
    [[nodiscard]] bool withinTravel(const dynamics::PathBlock& block, std::size_t line);
    void refuse(int number, std::size_t line, std::string text);

    const post::MachineFile& file_;
    const kinematics::Machine& machine_;
    const ControlOptions& options_;
    post::reader::ForwardChain chain_;
    std::deque<PreparedItem> items_;
    dynamics::AxisVector axes_{};
    ToolPlacement placement_;
    std::optional<Alarm> alarm_;
    double override_ = 1.0;
    bool smoothing_ = false;  ///< CYCLE832
    double tolerance_mm_ = 0.01;
    double orientation_tolerance_rad_ = 0.0;
};

}  // namespace cusp::comm
