// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Positions between two of the path where all axes, running linearly without TRAORI, would take the tip off its line.
#pragma once

#include "machine_axes.hpp"

#include <cusp/kinematics/machine.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace cusp::post {

/// One block end of a program without TRAORI.
struct MachineStop {
    MachineAxes::Position at;                              ///< as printed
    geometry::Vector3 tip_mm = geometry::Vector3::Zero();  ///< there
    geometry::Vector3 axis = geometry::Vector3::UnitZ();
};

struct LineariserOptions {
    double tolerance_mm = 0.005;
    /// Of the tool axis from the great circle between the ends, on moves that nobody refined before (rapids).
    double orientation_tolerance_rad = 0.001;
    std::size_t max_inserted = 10000;
};

/// Halves a move until `MachineAxes::chordError` of each part keeps the tolerance: tips on the line, axes on the great
/// circle, rotary positions on the side where the ends lie. Linear positions are solved for the rotary ones as printed.
class TipLineariser {
public:
    struct Pose {
        geometry::Vector3 tip_mm;
        kinematics::RotaryValues rotary_rad;
    };

    TipLineariser(const kinematics::Machine& machine, const MachineAxes& axes, LineariserOptions options);

    /// Where the move begins.
    [[nodiscard]] bool startAt(const Pose& pose);
    /// The stops on the way and the end itself; valid until the next call. Empty when the linear axes cannot get there.
    /// `refined`: the rotary axes, running linearly, keep the tool axis on its way already.
    [[nodiscard]] const std::vector<MachineStop>& advance(const Pose& to, bool refined);

    /// Where the last move ended.
    [[nodiscard]] const MachineStop& last() const { return from_.stop; }
    /// Of the last move: the bound that was reached. Beyond the tolerance when `max_inserted` did not do.
    [[nodiscard]] double errorBound() const { return worst_mm_; }
    [[nodiscard]] std::size_t inserted() const { return inserted_; }

private:
    struct Node {
        double fraction = 0.0;
        geometry::Vector3 tip_mm = geometry::Vector3::Zero();  ///< not printed, like the rotary positions
        kinematics::RotaryValues rotary_rad{};
        MachineStop stop;
    };
    [[nodiscard]] bool place(Node& node) const;
    [[nodiscard]] bool follows(const kinematics::RotaryValues& from, const kinematics::RotaryValues& to) const;
    [[nodiscard]] kinematics::RotaryValues between(const Node& from, const Node& to) const;
    [[nodiscard]] bool linearTurnKeepsAxis(const Node& from, const Node& to) const;
    void divide(const Node& from, const Node& to, int depth);

    const kinematics::Machine& machine_;
    const MachineAxes& axes_;
    LineariserOptions options_;
    Node from_;
    std::vector<MachineStop> out_;
    // The move being divided.
    geometry::Vector3 from_axis_ = geometry::Vector3::UnitZ();
    geometry::Vector3 to_axis_ = geometry::Vector3::UnitZ();
    bool refined_ = true;
    bool follows_ = true;
    bool failed_ = false;
    double worst_mm_ = 0.0;
    std::size_t inserted_ = 0;
};

}  // namespace cusp::post
