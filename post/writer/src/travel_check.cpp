// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What each step of a program does to the axes.
#include <cusp/post/writer/travel_check.hpp>

#include "machine_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

namespace cusp::post {

using geometry::Vector3;
using kinematics::AxisValues;
using kinematics::LinearTravel;

namespace {

kinematics::TravelOptions travelOptions(const std::string& cl_file) {
    kinematics::TravelOptions options;
    options.file_name = cl_file;
    return options;
}

AxisValues homeOf(const kinematics::Machine& machine) {
    AxisValues home;
    for (std::size_t i = 0; i < 3; ++i)
        home.linear_mm[static_cast<Eigen::Index>(i)] = machine.definition().linear.at(machine.linearNames()[i]).home_mm;
    home.rotary_rad = machine.rotaryHome();
    return home;
}

std::string toolText(const ChangeTool& tool) {
    return tool.name.empty() ? fmt::format("tool {}", tool.number.value_or(0))
                             : fmt::format("tool named \"{}\"", tool.name);
}

std::string namesOf(const machine::SetupDefinition& setup) {
    std::string names;
    for (const auto& [name, offset] : setup.work_offsets) names += (names.empty() ? "" : ", ") + name;
    return names;
}

}  // namespace

struct TravelCheck::State {
    State(const kinematics::Machine& machine_model, const machine::SetupDefinition& setup_definition,
          const std::string& work_offset, std::string file, NcSink& sink)
        : machine(machine_model),
          setup(setup_definition),
          cl_file(std::move(file)),
          next(sink),
          travel(machine_model, travelOptions(cl_file)),
          offset_name(work_offset) {
        if (const machine::WorkOffset* offset = setup.findOffset(work_offset))
            travel.setOrigin(geometry::toVector(offset->origin_mm));
        else
            report.error("post.setup-offset", fmt::format("the setup does not place work offset {}; it places {}",
                                                          work_offset, namesOf(setup)));
        placed = !report.hasErrors();
    }

    const kinematics::Machine& machine;
    const machine::SetupDefinition& setup;
    std::string cl_file;
    NcSink& next;
    LinearTravel travel;
    std::string offset_name;
    base::Diagnostics report;
    bool placed = false;
    bool tool_known = false;
    bool tool_spoken_of = false;
    std::uint32_t line = 0;
    Vector3 at = Vector3::Zero();  ///< as programmed
    RotaryValues rotary_rad{};
    double retract_z_mm = 0.0;
    double bottom_z_mm = 0.0;
    std::optional<MachineAxes> axes;                               ///< points are positions of the axes
    std::optional<geometry::RigidTransform> workpiece_from_plane;  ///< points are in a tilted plane

    [[nodiscard]] bool follows() const { return placed && tool_known; }

    /// The tip for a programmed point.
    [[nodiscard]] Vector3 tipOf(const Vector3& point_mm, const RotaryValues& rotary) const {
        if (workpiece_from_plane) return *workpiece_from_plane * point_mm;
        const auto frame = axes ? axes->programmedFromWorkpiece(rotary) : std::nullopt;
        return frame ? Vector3(frame->inverse() * point_mm) : point_mm;
    }
    void go(const Vector3& point_mm, const RotaryValues& rotary) {
        if (follows()) travel.moveTo(tipOf(point_mm, rotary), rotary, line);
        at = point_mm;
        rotary_rad = rotary;
    }

    void see(const GoHome&) {
        const AxisValues home = homeOf(machine);
        travel.standAt(home);
        rotary_rad = home.rotary_rad;
    }
    void see(const ChangeTool& tool) {
        const auto length_mm = setup.toolLength(tool.number, tool.name);
        tool_known = length_mm.has_value();
        tool_spoken_of = true;
        if (tool_known) return travel.setToolLength(*length_mm);
        report.error("post.setup-tool", fmt::format("the setup does not say how long the {} is", toolText(tool)),
                     {cl_file, line, 0, {}});
    }
    void see(const PositionRotary& item) {
        travel.turnTo(item.rotary_rad);
        rotary_rad = item.rotary_rad;
    }
    void see(const TipProgramming& item) {
        axes.reset();
        workpiece_from_plane.reset();
        if (item.on) begin();
    }
    void see(const TiltedPlane& item) {
        axes.reset();
        see(PositionRotary{item.rotary_rad});
        workpiece_from_plane = item.workpieceFromPlane();
        begin();
    }
    void see(const PlaneOff&) { workpiece_from_plane.reset(); }
    void see(const SelectWorkOffset& item) {
        if (item.name == offset_name) return;
        offset_name = item.name;
        const machine::WorkOffset* offset = setup.findOffset(item.name);
        placed = offset != nullptr;
        if (placed) return travel.setOrigin(geometry::toVector(offset->origin_mm));
        report.error("post.setup-offset",
                     fmt::format("the setup does not place work offset {}; it places {}", item.name, namesOf(setup)));
    }
    void see(const AxisProgramming& item) {
        axes.emplace(machine, NumberFormat());
        axes->setUp(item.tool_length_mm, item.wcs_origin_mm);
        begin();
    }
    void begin() {
        if (!std::exchange(tool_spoken_of, true))
            report.error("post.setup-tool",
                         "no tool is called, so the setup cannot say how long it is and linear travel is unknown",
                         {cl_file, line, 0, {}});
        const auto tip = travel.tip();
        if (!tip) return;
        if (workpiece_from_plane) {
            at = workpiece_from_plane->inverse() * *tip;
            return;
        }
        const auto frame = axes ? axes->programmedFromWorkpiece(rotary_rad) : std::nullopt;
        at = frame ? Vector3(*frame * *tip) : *tip;
    }
    /// In the plane first, at the height the tip has at home.
    void see(const Approach& item) {
        go({item.point_mm.x(), item.point_mm.y(), at.z()}, item.rotary_rad);
        go(item.point_mm, item.rotary_rad);
    }
    void see(const Move& item) { go(item.point_mm, item.rotary_rad); }

    /// The rotary axes stand still, so that chords within the bound of the arc are within the bound of the axes' ways.
    void see(const ArcMove& item) {
        const Vector3 start = at;
        const Vector3 center = start + item.center_from_start_mm;
        const double from = std::atan2(start.y() - center.y(), start.x() - center.x());
        const double to = std::atan2(item.end_mm.y() - center.y(), item.end_mm.x() - center.x());
        constexpr double full_turn = 2.0 * std::numbers::pi;
        constexpr double least_sweep_rad = 1e-12;
        double sweep = item.clockwise ? from - to : to - from;
        sweep -= full_turn * std::floor(sweep / full_turn);
        if (sweep <= least_sweep_rad) sweep = full_turn;
        const double radius = std::hypot(item.center_from_start_mm.x(), item.center_from_start_mm.y());
        const double cosine =
            std::clamp(1.0 - kinematics::TravelOptions().bound_mm / std::max(radius, 1e-9), -1.0, 1.0);
        const double count = std::max(1.0, std::ceil(sweep / (2.0 * std::acos(cosine))));
        for (std::int64_t chord = 1; chord < static_cast<std::int64_t>(count); ++chord) {
            const double share = static_cast<double>(chord) / count;
            const double angle = from + (item.clockwise ? -1.0 : 1.0) * sweep * share;
            go({center.x() + radius * std::cos(angle), center.y() + radius * std::sin(angle),
                std::lerp(start.z(), item.end_mm.z(), share)},
               item.rotary_rad);
        }
        go(item.end_mm, item.rotary_rad);
    }
    void see(const HoleCycle& item) {
        retract_z_mm = item.retract_z_mm;
        bottom_z_mm = item.surface_z_mm - item.depth_mm;
    }
    void see(const HolePosition& item) {
        go({item.x_mm, item.y_mm, at.z()}, item.rotary_rad);
        go({item.x_mm, item.y_mm, bottom_z_mm}, item.rotary_rad);
        go({item.x_mm, item.y_mm, retract_z_mm}, item.rotary_rad);
    }

    // Nothing of the axes; each named, so that a new kind of step cannot go unseen.
    void see(const Comment&) {}
    void see(const ModalStart&) {}
    void see(const Smoothing&) {}
    void see(const ScreenMessage&) {}
    void see(const Literal&) {}
    void see(const RadiusCompensation&) {}
    void see(const Spindle&) {}
    void see(const Coolant&) {}
    void see(const HoleCycleOff&) {}
    void see(const Pause&) {}
    void see(const Stop&) {}
};

TravelCheck::TravelCheck(const kinematics::Machine& machine, const machine::SetupDefinition& setup,
                         const std::string& work_offset, std::string cl_file, NcSink& next)
    : state_(std::make_unique<State>(machine, setup, work_offset, std::move(cl_file), next)) {}

TravelCheck::~TravelCheck() = default;

void TravelCheck::step(const NcStep& step) {
    state_->line = step.cl_line;
    std::visit([this](const auto& item) { state_->see(item); }, step.item);
    state_->next.step(step);
}

void TravelCheck::finish() { state_->travel.finish(); }

base::Diagnostics TravelCheck::report() const {
    base::Diagnostics report = state_->report;
    report.append(state_->travel.report());
    return report;
}

const kinematics::TravelSummary& TravelCheck::summary() const { return state_->travel.summary(); }

}  // namespace cusp::post
