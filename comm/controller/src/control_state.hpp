// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the virtual control remembers, and what happens in a tick.
#pragma once

#include "block_preparation.hpp"
#include "motion_clock.hpp"
#include "program_feed.hpp"

#include <cusp/comm/controller/virtual_control.hpp>
#include <cusp/post/reader/program_reader.hpp>

#include <algorithm>
#include <deque>
#include <memory>
#include <optional>
#include <string>

namespace cusp::comm {

struct VirtualControl::State {
    State(const post::MachineFile& machine_file, const kinematics::Machine& machine_model,
          const ControlOptions& control_options);

    void choose(std::string name);
    bool start();
    void finishReset();
    base::Result<void> search(std::size_t line);
    void tick();
    [[nodiscard]] dynamics::ToolPath toolPath() const {
        return {machine, placement.tool_length_mm, placement.origin_mm};
    }
    /// Nothing moves, and nothing will without somebody doing something.
    [[nodiscard]] bool idle() const;

    const post::MachineFile& file;
    const kinematics::Machine& machine;
    ControlOptions options;
    ControlStatus status;
    std::function<void(const ControlSample&)> sink;
    BlockPreparation preparation;
    ToolPlacement placement;  ///< of what is run now; preparation is ahead
    MotionClock clock;
    ProgramFeed feed;
    std::string text;  ///< of the chosen program, in program memory
    bool single_block = false;
    bool optional_stop = false;
    bool stopping = false;
    bool resetting = false;

private:
    /// Why nothing is prepared until the machine is at rest.
    struct Barrier {
        enum class Kind { Event, SingleBlock, Alarm, Starved };
        Kind kind = Kind::Event;
        RestEvent event;
        Alarm alarm;
    };
    struct BlockInfo {
        std::uint64_t id = 0;
        std::size_t line = 0;
        double planned_override = 1.0;
        bool rapid = false;
    };
    void openProgram();
    void newPlanner();
    void prepare();
    [[nodiscard]] bool readLine();
    void takeItem();
    void addBlock(dynamics::PathBlock block, std::size_t line);
    void fault(Alarm alarm);
    void plan();
    void takePlan();
    void move();
    void follow();
    void pass(const Barrier& barrier);
    void passEvent(const RestEvent& event);
    void interrupt(std::string why);
    void starve();
    void approach();
    [[nodiscard]] bool dry() const;
    [[nodiscard]] double wantedRate() const;
    [[nodiscard]] std::optional<Alarm> readAlarm() const;

    std::unique_ptr<dynamics::MotionPlanner> planner_;
    base::Diagnostics report_;
    std::unique_ptr<post::reader::ProgramRun> run_;
    bool chosen_ = false;
    bool read_out_ = false;  ///< the program has no more lines to run
    bool needs_reset_ = false;
    bool added_since_plan_ = false;
    std::optional<Barrier> barrier_;
    std::optional<std::size_t> searched_;
    std::deque<BlockInfo> blocks_;  ///< added and not yet done
    std::uint64_t next_id_ = 1;
    double next_preparation_s_ = 0.0;
    double dwell_until_s_ = 0.0;
    double contact_from_s_ = 0.0;
    bool in_contact_ = false;
    geometry::Vector3 contact_tip_mm_ = geometry::Vector3::Zero();
};

}  // namespace cusp::comm
