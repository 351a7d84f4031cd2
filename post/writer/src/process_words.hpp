// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Spindle and coolant: what the CL file wants, and what the program has been told.
#pragma once

#include <cusp/post/writer/nc_program.hpp>

#include <cstdint>

namespace cusp::post {

class ProcessWords {
public:
    explicit ProcessWords(NcSink& sink) : sink_(sink) {}

    Spindle spindle;
    toolpath::CoolantCommand::Kind coolant = toolpath::CoolantCommand::Kind::Off;

    /// Nothing when the program has it already.
    void tellSpindle(std::uint32_t line) {
        using Turn = toolpath::SpindleCommand::Turn;
        if (spindle.turn == spindle_told_.turn && spindle.speed_rpm == spindle_told_.speed_rpm) return;
        if (spindle.turn != Turn::Off || spindle_told_.turn != Turn::Off) sink_.step({spindle, line});
        spindle_told_ = spindle;
    }
    void tellCoolant(std::uint32_t line) {
        if (coolant == coolant_told_) return;
        sink_.step({Coolant{coolant}, line});
        coolant_told_ = coolant;
    }
    /// What runs is told again next time, changed or not.
    void forget() {
        spindle_told_ = {};
        coolant_told_ = toolpath::CoolantCommand::Kind::Off;
    }
    void spindleOff(std::uint32_t line) {
        if (spindle_told_.turn != toolpath::SpindleCommand::Turn::Off) sink_.step({Spindle{}, line});
        spindle_told_ = {};
    }
    void coolantOff(std::uint32_t line) {
        if (coolant_told_ != toolpath::CoolantCommand::Kind::Off) sink_.step({Coolant{}, line});
        coolant_told_ = toolpath::CoolantCommand::Kind::Off;
    }

private:
    NcSink& sink_;
    Spindle spindle_told_;
    toolpath::CoolantCommand::Kind coolant_told_ = toolpath::CoolantCommand::Kind::Off;
};

}  // namespace cusp::post
