// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The field table of a machine file, and the questions a definition can answer by itself.
#include <cusp/machine/machine_definition.hpp>

#include "machine_checks.hpp"
#include "schema_types.hpp"

#include <algorithm>

namespace cusp::machine {
namespace {

using base::FieldRules;
using base::Section;

constexpr std::string_view workpiece = "workpiece";
constexpr std::string_view base_name = "base";
constexpr std::string_view tool = "tool";

// Every winding within the limits is a candidate the planner weighs; more than ten turns either way is a typing mistake.
constexpr FieldRules angle_limit{.min = -3600.0, .max = 3600.0};

Section<LinearAxis> linearSection() {
    Section<LinearAxis> section("A linear axis.");
    section
        .field(
            "direction", &LinearAxis::direction,
            "Direction the tool moves in, relative to the workpiece, when the axis moves positively (ISO 841), in the "
            "machine frame. Normalised on reading.",
            base::required())
        .field("min_mm", &LinearAxis::min_mm, "Lower end of travel.", base::required())
        .field("max_mm", &LinearAxis::max_mm, "Upper end of travel.", base::required())
        .field("home_mm", &LinearAxis::home_mm, "Home position, within the travel.", base::required())
        .field("max_velocity_mm_per_min", &LinearAxis::max_velocity_mm_per_s, "Greatest speed.",
               base::requiredPositive())
        .field("max_acceleration_mm_per_s2", &LinearAxis::max_acceleration_mm_per_s2, "Greatest acceleration.",
               base::requiredPositive())
        .field("max_jerk_mm_per_s3", &LinearAxis::max_jerk_mm_per_s3, "Greatest jerk.", base::requiredPositive())
        .check(checkLinearAxis);
    return section;
}

Section<RotaryAxis> rotarySection() {
    Section<RotaryAxis> section("A rotary axis.");
    section
        .field(
            "direction", &RotaryAxis::direction,
            "Axis about which the tool turns right-handedly, relative to the workpiece, when the axis moves positively "
            "(ISO 841), in the machine frame with all axes at zero. Normalised on reading.",
            base::required())
        .field("point_mm", &RotaryAxis::point_mm, "A point on the axis, machine frame, all axes at zero.",
               base::required())
        .choice("winding", &RotaryAxis::winding,
                {{"limited", RotaryAxis::Winding::Limited}, {"endless", RotaryAxis::Winding::Endless}},
                "Whether the axis has ends of travel or turns on for ever.", base::required())
        .field("min_deg", &RotaryAxis::min_rad, "Lower end of travel; given exactly when winding is \"limited\".",
               angle_limit)
        .field("max_deg", &RotaryAxis::max_rad, "Upper end of travel; given exactly when winding is \"limited\".",
               angle_limit)
        .field("home_deg", &RotaryAxis::home_rad, "Home position, within the travel.", base::required())
        .field("max_velocity_deg_per_s", &RotaryAxis::max_velocity_rad_per_s, "Greatest speed.",
               base::requiredPositive())
        .field("max_acceleration_deg_per_s2", &RotaryAxis::max_acceleration_rad_per_s2, "Greatest acceleration.",
               base::requiredPositive())
        .field("max_jerk_deg_per_s3", &RotaryAxis::max_jerk_rad_per_s3, "Greatest jerk.", base::requiredPositive())
        .check(checkRotaryAxis);
    return section;
}

Section<Spindle> spindleSection() {
    Section<Spindle> section("The spindle.");
    section
        .field("axis", &Spindle::axis,
               "Tool axis from the tip to the spindle, machine frame, all axes at zero. Normalised on reading.",
               base::required())
        .field("gauge_point_mm", &Spindle::gauge_point_mm,
               "Where the tool's gauge length starts, machine frame, all axes at zero.", base::required())
        .field("max_speed_rpm", &Spindle::max_speed_rpm, "Greatest speed.", base::requiredPositive());
    return section;
}

Section<Anchor> anchorSection() {
    Section<Anchor> section(
        "A pose known from outside, such as a line of a real program. It catches a wrong sign or axis, which forward and "
        "inverse kinematics of the same definition cannot.");
    section.field("source", &Anchor::source, "Where the pose comes from.", base::required())
        .field("rotary_deg", &Anchor::rotary_rad, "Rotary axis positions by axis name; axes left out are at zero.",
               base::required())
        .field("tool_axis", &Anchor::tool_axis,
               "Tool axis from the tip to the spindle in the workpiece frame. Normalised on reading.", base::required())
        .field("tolerance_deg", &Anchor::tolerance_rad, "How well the source knows the pose.",
               base::requiredPositive());
    return section;
}

Section<Source> sourceSection() {
    Section<Source> section("Where values come from. Values no source speaks of are assumed.");
    section
        .field("keys", &Source::keys, "Dotted keys this source speaks of; \"rotary.A\" covers everything below it.",
               base::required())
        .field("text", &Source::text, "The source: manual and page, program, measurement.", base::required());
    return section;
}

Section<MachineDefinition> buildMachineSection() {
    Section<MachineDefinition> section("A machine: its axes from the workpiece to the tool, and its spindle.");
    section.field("schema", &MachineDefinition::schema, "Version of this file format; 1.", base::required())
        .field("name", &MachineDefinition::name, "Name of the machine.", base::required())
        .field("description", &MachineDefinition::description, "What kind of machine it is.")
        .field(
            "chain", &MachineDefinition::chain,
            "From workpiece to tool: \"workpiece\", axis names, \"base\" (the standing part) once among them, \"tool\".",
            base::required())
        .named("linear", &MachineDefinition::linear, linearSection(), base::required())
        .named("rotary", &MachineDefinition::rotary, rotarySection())
        .table("spindle", &MachineDefinition::spindle, spindleSection(), base::required())
        .tables("anchor", &MachineDefinition::anchors, anchorSection())
        .tables("source", &MachineDefinition::sources, sourceSection())
        .check(checkMachine)
        .sharesTable();
    return section;
}

}  // namespace

std::vector<std::string> MachineDefinition::axisNames() const {
    std::vector<std::string> names;
    for (const std::string& link : chain)
        if (link != workpiece && link != base_name && link != tool) names.push_back(link);
    return names;
}

bool MachineDefinition::carriesWorkpiece(const std::string& axis) const {
    const auto base_place = std::find(chain.begin(), chain.end(), base_name);
    return std::find(chain.begin(), base_place, axis) != base_place;
}

const base::Section<MachineDefinition>& machineSection() {
    static const Section<MachineDefinition> section = buildMachineSection();
    return section;
}

}  // namespace cusp::machine
