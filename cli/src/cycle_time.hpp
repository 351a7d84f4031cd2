// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How long a program takes: every step of it run through the look-ahead, on its way to the writer.
#pragma once

#include <cusp/dynamics/motion_planner.hpp>
#include <cusp/machine/setup_definition.hpp>
#include <cusp/post/control/control_definition.hpp>
#include <cusp/post/writer/nc_program.hpp>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace cusp::cli {

struct CycleTimeOptions {
    const machine::SetupDefinition* setup = nullptr;
    std::string work_offset;
    /// Of tools the setup does not know.
    double tool_length_mm = 100.0;
    std::size_t most_moves = 0;  ///< gives up beyond; 0: never
};

struct CycleTime {
    double motion_s = 0.0;
    double dwell_s = 0.0;
    bool from_setup = false;  ///< lengths and origin are the setup's; else assumed
    dynamics::PlanSummary planning;

    [[nodiscard]] double total() const { return motion_s + dwell_s; }
};

/// Passes every step on as it is. Tool changes, spindle run-up and stops for the operator take no time: nobody says how
/// long they are.
class CycleTimeEstimate : public post::NcSink {
public:
    /// All references must outlive the estimate.
    CycleTimeEstimate(const post::MachineFile& file, const kinematics::Machine& machine, CycleTimeOptions options,
                      post::NcSink& next);
    ~CycleTimeEstimate() override;

    void step(const post::NcStep& step) override;
    /// After the last step. Empty where the estimate gave up: too many moves, or a place the axes cannot follow to.
    [[nodiscard]] std::optional<CycleTime> finish();
    [[nodiscard]] bool tooManyMoves() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace cusp::cli
