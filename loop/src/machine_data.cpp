// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What was found, as a machine file and as machine data of a Sinumerik 840D.
#include <cusp/loop/calibration.hpp>

#include <cusp/base/units.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cusp::loop {
namespace {

using Kind = ErrorParameter::Kind;

/// Type 24: both rotary axes move the tool.
bool isHead(const kinematics::Machine& machine) {
    if (machine.rotaryCount() != 2) return false;
    return !machine.definition().carriesWorkpiece(machine.rotaryNames()[0]) &&
           !machine.definition().carriesWorkpiece(machine.rotaryNames()[1]);
}

std::size_t componentOf(const Vector3& direction) {
    Eigen::Index out = 0;
    direction.cwiseAbs().maxCoeff(&out);
    return static_cast<std::size_t>(out);
}

class DataList {
public:
    DataList(const kinematics::Machine& machine, const machine::MachineDefinition& corrected)
        : machine_(machine), corrected_(corrected), head_(isHead(machine)) {}

    void take(const FoundParameter& found) {
        switch (found.parameter.kind) {
            case Kind::PivotLength: return pivot(found);
            case Kind::ToolLength: return add(found, "$TC_DP3", found.value, "tool length 1 of this tool");
            case Kind::ToolRadius: return add(found, "$TC_DP6", found.value, "tool radius of this tool");
            case Kind::AxisPoint: return point(found);
            case Kind::AxisTilt: return tilt(found);
            case Kind::AxisZero:
                return add(found, fmt::format("MD24510 $MC_TRAFO5_ROT_AX_OFFSET_1[{}]", found.parameter.axis),
                           found.value, "the axis stands so much further than it shows");
            case Kind::Squareness:
                return add(found, "$AN_CEC (MD32710 $MA_CEC_ENABLE)", found.value,
                           fmt::format("cross error compensation: {} mm per m of {} along {}",
                                       std::round(1e6 * std::tan(base::radFromDeg(found.value))) / 1e3,
                                       machine_.linearNames().at(found.parameter.axis),
                                       machine_.linearNames().at(found.parameter.other)));
            case Kind::Lag:
                return add(
                    found, fmt::format("MD32200 $MA_POSCTRL_GAIN of {}", found.parameter.name), found.value,
                    "servo lag in ms against the other axes: match the gains or the feed-forward, do not enter it");
        }
    }
    std::vector<MachineDatum> finish() { return std::move(out_); }

private:
    void add(const FoundParameter& found, std::string name, double change, std::string note) {
        out_.push_back({.name = std::move(name),
                        .parameter = found.parameter.name,
                        .change = change,
                        .uncertainty = found.interval_95,
                        .note = std::move(note)});
    }
    void pivot(const FoundParameter& found) {
        if (!head_) return;
        const auto& spindle = corrected_.spindle.axis;
        const std::size_t along = componentOf(Vector3(spindle[0], spindle[1], spindle[2]));
        add(found, fmt::format("MD24550 $MC_TRAFO5_BASE_TOOL_1[{}]", along), found.value,
            "in size: the vector from the second rotary axis to the spindle's gauge point grows by so much; "
            "MD24500 closes the chain");
    }
    void point(const FoundParameter& found) {
        if (!head_) return;
        const std::size_t c = componentOf(found.parameter.direction);
        // I1 + I2 + I3 = 0 from the reference point over both axes and back: moving the first axis changes I1 and I2,
        // moving the second I2 and I3.
        const double joint = found.parameter.axis == 0 ? -found.value : found.value;
        add(found, fmt::format("MD24560 $MC_TRAFO5_JOINT_OFFSET_1[{}]", c), joint,
            "vector from the first rotary axis to the second, machine directions");
        if (found.parameter.axis == 0)
            add(found, fmt::format("MD24500 $MC_TRAFO5_PART_OFFSET_1[{}]", c), found.value,
                "vector from the machine's reference to the first rotary axis");
        else
            add(found, fmt::format("MD24550 $MC_TRAFO5_BASE_TOOL_1[{}]", c), -found.value,
                "vector from the second rotary axis to the gauge point");
    }
    void tilt(const FoundParameter& found) {
        const std::string& name = machine_.rotaryNames()[found.parameter.axis];
        const auto& before = machine_.definition().rotary.at(name).direction;
        const auto& after = corrected_.rotary.at(name).direction;
        const char* datum = found.parameter.axis == 0 ? "MD24570 $MC_TRAFO5_AXIS1_1" : "MD24572 $MC_TRAFO5_AXIS2_1";
        for (std::size_t c = 0; c < 3; ++c) {
            const double change = after.at(c) - before.at(c);
            std::string entry = fmt::format("{}[{}]", datum, c);
            // Both tilts of an axis change the same vector: it is entered once.
            const bool there = std::ranges::find(out_, entry, &MachineDatum::name) != out_.end();
            if (std::abs(change) < 1e-7 || there) continue;
            out_.push_back({.name = std::move(entry),
                            .parameter = found.parameter.name,
                            .change = change,
                            .uncertainty = base::radFromDeg(found.interval_95),
                            .note = fmt::format("component of the direction of {}, with all its errors found", name)});
        }
    }

    const kinematics::Machine& machine_;
    const machine::MachineDefinition& corrected_;
    bool head_;
    std::vector<MachineDatum> out_;
};

}  // namespace

machine::MachineDefinition correctedMachine(const machine::MachineDefinition& nominal,
                                            const MachineErrors& corrections) {
    return withErrors(nominal, corrections);
}

std::vector<MachineDatum> machineData(const machine::MachineDefinition& nominal, const CalibrationResult& result) {
    const kinematics::Machine machine(nominal);
    const machine::MachineDefinition corrected = correctedMachine(nominal, result.corrections());
    DataList list(machine, corrected);
    for (const FoundParameter& found : result.parameters)
        if (found.significant) list.take(found);
    return list.finish();
}

}  // namespace cusp::loop
