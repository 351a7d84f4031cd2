// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The parameters of a machine's errors, and the definition they change.
#include <cusp/loop/machine_error.hpp>

#include <cusp/base/number_text.hpp>
#include <cusp/base/toml_node.hpp>
#include <cusp/base/toml_schema.hpp>
#include <cusp/base/units.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace cusp::loop {
namespace {

using Kind = ErrorParameter::Kind;

constexpr double typical_length_mm = 0.03;
constexpr double typical_radius_mm = 0.01;
constexpr double typical_angle_deg = 0.005;
constexpr double typical_lag_ms = 1.0;
constexpr std::array<char, 3> letters{'x', 'y', 'z'};

Vector3 unit(std::size_t axis) { return Vector3::Unit(static_cast<Eigen::Index>(axis)); }

/// The machine's own directions that lie most across `axis`, without the one most across `also` where that is given.
std::vector<std::size_t> across(const Vector3& axis, const Vector3* also = nullptr) {
    std::vector<std::size_t> out;
    Eigen::Index along = 0;
    axis.cwiseAbs().maxCoeff(&along);
    Eigen::Index left_out = -1;
    if (also != nullptr) {
        Vector3 rest = also->cwiseAbs();
        rest[along] = -1.0;
        rest.maxCoeff(&left_out);
    }
    for (std::size_t i = 0; i < 3; ++i)
        if (std::cmp_not_equal(i, along) && std::cmp_not_equal(i, left_out)) out.push_back(i);
    return out;
}

void addTool(const kinematics::Machine& machine, std::vector<ErrorParameter>& out) {
    const auto& definition = machine.definition();
    if (machine.rotaryCount() > 0 && !definition.carriesWorkpiece(machine.rotaryNames().back()))
        out.push_back({.name = "pivot_length_mm",
                       .kind = Kind::PivotLength,
                       .typical = typical_length_mm,
                       .meaning = fmt::format("from the {} axis to the gauge point, along the spindle",
                                              machine.rotaryNames().back())});
    out.push_back({.name = "tool_length_mm",
                   .kind = Kind::ToolLength,
                   .typical = typical_length_mm,
                   .meaning = "gauge point to tip: the tool is longer than the control has it"});
    out.push_back({.name = "tool_radius_mm",
                   .kind = Kind::ToolRadius,
                   .typical = typical_radius_mm,
                   .meaning = "the cutter is larger than the path was made for"});
}

void addRotary(const kinematics::Machine& machine, std::size_t i, std::vector<ErrorParameter>& out) {
    const std::string& name = machine.rotaryNames()[i];
    const Vector3& direction = machine.rotaryDirection(i);
    const auto& definition = machine.definition();
    const bool last_on_tool = i + 1 == machine.rotaryCount() && !definition.carriesWorkpiece(name);
    const Vector3 spindle(definition.spindle.axis[0], definition.spindle.axis[1], definition.spindle.axis[2]);
    for (const std::size_t c : across(direction, last_on_tool ? &spindle : nullptr))
        out.push_back({.name = fmt::format("axis_{}_{}_mm", name, letters.at(c)),
                       .kind = Kind::AxisPoint,
                       .axis = i,
                       .direction = unit(c),
                       .typical = typical_length_mm,
                       .meaning = fmt::format("place of the {} axis, along machine {}", name, letters.at(c))});
    const Vector3* first = i == 1 ? &machine.rotaryDirection(0) : nullptr;
    for (const std::size_t c : across(direction, first))
        out.push_back(
            {.name = fmt::format("axis_{}_about_{}_deg", name, letters.at(c)),
             .kind = Kind::AxisTilt,
             .axis = i,
             .direction = unit(c),
             .typical = typical_angle_deg,
             .meaning = fmt::format("direction of the {} axis, turned about machine {}", name, letters.at(c))});
    out.push_back({.name = fmt::format("zero_{}_deg", name),
                   .kind = Kind::AxisZero,
                   .axis = i,
                   .typical = typical_angle_deg,
                   .meaning = fmt::format("zero of the {} axis", name)});
}

void addLinear(const kinematics::Machine& machine, std::vector<ErrorParameter>& out) {
    const auto& names = machine.linearNames();
    std::array<std::size_t, 3> order{0, 1, 2};
    std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return names.at(a) < names.at(b); });
    for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}}) {
        const std::size_t towards = order.at(static_cast<std::size_t>(a));
        const std::size_t leans = order.at(static_cast<std::size_t>(b));
        out.push_back(
            {.name = fmt::format("square_{}{}_deg", names.at(towards), names.at(leans)),
             .kind = Kind::Squareness,
             .axis = leans,
             .other = towards,
             .typical = typical_angle_deg,
             .meaning = fmt::format("{} leans from the square towards {}", names.at(leans), names.at(towards))});
    }
}

void addLags(const kinematics::Machine& machine, std::vector<ErrorParameter>& out) {
    for (std::size_t i = 0; i < 3 + machine.rotaryCount(); ++i) {
        const std::string& name = i < 3 ? machine.linearNames().at(i) : machine.rotaryNames()[i - 3];
        out.push_back({.name = fmt::format("lag_{}_ms", name),
                       .kind = Kind::Lag,
                       .axis = i,
                       .typical = typical_lag_ms,
                       .meaning = fmt::format("servo lag of {}: time by which it follows late", name)});
    }
}

void turn(machine::Direction& direction, const Vector3& about, double angle_deg) {
    const Vector3 turned = Eigen::AngleAxisd(base::radFromDeg(angle_deg), about) *
                           Vector3(direction[0], direction[1], direction[2]).normalized();
    for (std::size_t i = 0; i < 3; ++i) direction.at(i) = turned[static_cast<Eigen::Index>(i)];
}

void shift(std::array<double, 3>& point, const Vector3& by) {
    for (std::size_t i = 0; i < 3; ++i) point.at(i) += by[static_cast<Eigen::Index>(i)];
}

/// What of the errors is in the definition; the zeros of rotary axes are not: they go into `zeros_rad`.
void change(machine::MachineDefinition& definition, const kinematics::Machine& nominal, const ErrorParameter& parameter,
            double value) {
    switch (parameter.kind) {
        case Kind::PivotLength:
            shift(definition.spindle.gauge_point_mm,
                  -value * Vector3(definition.spindle.axis[0], definition.spindle.axis[1], definition.spindle.axis[2]));
            break;
        case Kind::AxisPoint:
            shift(definition.rotary.at(nominal.rotaryNames()[parameter.axis]).point_mm, value * parameter.direction);
            break;
        case Kind::AxisTilt:
            turn(definition.rotary.at(nominal.rotaryNames()[parameter.axis]).direction, parameter.direction, value);
            break;
        case Kind::Squareness: {
            auto& leaning = definition.linear.at(nominal.linearNames().at(parameter.axis)).direction;
            const auto& towards = nominal.definition().linear.at(nominal.linearNames().at(parameter.other)).direction;
            // The scale of the leaning axis stays: only its direction is wrong.
            Vector3 to(leaning[0], leaning[1], leaning[2]);
            to += std::tan(base::radFromDeg(value)) * Vector3(towards[0], towards[1], towards[2]);
            to.normalize();
            for (std::size_t i = 0; i < 3; ++i) leaning.at(i) = to[static_cast<Eigen::Index>(i)];
            break;
        }
        default: break;
    }
}

bool inRange(const ErrorParameter& parameter, double value) {
    constexpr double most_mm = 5.0;
    constexpr double most_deg = 2.0;
    constexpr double most_ms = 100.0;
    if (!std::isfinite(value)) return false;
    if (parameter.kind == Kind::Lag) return value >= 0.0 && value <= most_ms;
    return std::abs(value) <= (parameter.name.ends_with("_deg") ? most_deg : most_mm);
}

std::string namesOf(const std::vector<ErrorParameter>& parameters) {
    std::string out;
    for (const ErrorParameter& parameter : parameters) out += (out.empty() ? "" : ", ") + parameter.name;
    return out;
}

base::Result<void> check(const MachineErrors& errors, const std::vector<ErrorParameter>& parameters,
                         const base::TomlNode* table) {
    base::Diagnostics report;
    for (const auto& [name, value] : errors) {
        const base::Location where = table != nullptr ? table->whereKey(name) : base::Location{};
        const auto found = std::ranges::find(parameters, name, &ErrorParameter::name);
        if (found == parameters.end())
            report.error("machine-error.unknown",
                         fmt::format("this machine has no error '{}'; it has {}", name, namesOf(parameters)), where);
        else if (!inRange(*found, value))
            report.error(
                "machine-error.range",
                fmt::format("{} = {}: no working machine is that wrong (lengths to 5 mm, angles to 2 deg, lags "
                            "0 to 100 ms)",
                            name, value),
                where);
    }
    if (report.hasErrors()) return base::fail(std::move(report));
    return {};
}

struct ErrorFile {
    std::int64_t schema = 1;
    MachineErrors error;
};

const base::Section<ErrorFile>& errorFileSection() {
    static const auto section =
        base::Section<ErrorFile>("What a machine really has wrong.")
            .field("schema", &ErrorFile::schema, "Version of this file's form.", {.required = true, .min = 1, .max = 1})
            .field("error", &ErrorFile::error, "Errors by name; each name ends in its unit.", base::required());
    return section;
}

base::Result<MachineErrors> errorsOf(const base::TomlDocument& document, const kinematics::Machine& machine) {
    base::Diagnostics report;
    ErrorFile file = errorFileSection().read(document.root(), report);
    if (report.hasErrors()) return base::fail(std::move(report));
    const auto table = document.root().at("error");
    if (const auto ok = check(file.error, errorParameters(machine), table ? &*table : nullptr); !ok)
        return base::fail(ok.error());
    return std::move(file.error);
}

}  // namespace

std::vector<ErrorParameter> errorParameters(const kinematics::Machine& machine) {
    std::vector<ErrorParameter> out;
    addTool(machine, out);
    for (std::size_t i = 0; i < machine.rotaryCount(); ++i) addRotary(machine, i, out);
    addLinear(machine, out);
    addLags(machine, out);
    return out;
}

base::Result<MachineErrors> readMachineErrors(const std::string& path, const kinematics::Machine& machine) {
    return base::TomlDocument::readFile(path).and_then(
        [&](const base::TomlDocument& document) { return errorsOf(document, machine); });
}

base::Result<MachineErrors> parseMachineErrors(std::string_view text, const std::string& file_name,
                                               const kinematics::Machine& machine) {
    return base::TomlDocument::parse(text, file_name).and_then([&](const base::TomlDocument& document) {
        return errorsOf(document, machine);
    });
}

std::string toToml(const MachineErrors& errors) {
    std::string out = "schema = 1\n\n[error]\n";
    for (const auto& [name, value] : errors) out += fmt::format("{} = {}\n", name, base::formatShortest(value));
    return out;
}

geometry::RigidTransform RealMachine::wcsFromTool(const dynamics::AxisVector& axes) const {
    const kinematics::AxisValues values{.linear_mm = {axes[0], axes[1], axes[2]},
                                        .rotary_rad = {axes[3] + zero_rad[0], axes[4] + zero_rad[1]}};
    geometry::RigidTransform out = model.workpieceFromTool(values, tool_length_mm);
    out.translation() -= origin_mm;
    return out;
}

toolpath::CutterLocation RealMachine::place(const dynamics::AxisVector& axes) const {
    const geometry::RigidTransform at = wcsFromTool(axes);
    const auto& spindle = model.definition().spindle.axis;
    return {.tip_mm = at.translation(), .axis = at.linear() * Vector3(spindle[0], spindle[1], spindle[2])};
}

machine::MachineDefinition withErrors(const machine::MachineDefinition& nominal, const MachineErrors& errors) {
    const kinematics::Machine believed(nominal);
    machine::MachineDefinition out = nominal;
    for (const ErrorParameter& parameter : errorParameters(believed))
        if (const auto found = errors.find(parameter.name); found != errors.end())
            change(out, believed, parameter, found->second);
    return out;
}

geometry::Cutter RealMachine::cutter(const geometry::Cutter& nominal) const {
    geometry::Cutter out = nominal;
    out.diameter_mm += 2.0 * tool_radius_error_mm;
    // A ball stays a ball; any other cutter keeps its corner.
    if (nominal.corner_radius_mm >= 0.5 * nominal.diameter_mm - 1e-9) {
        out.corner_radius_mm += tool_radius_error_mm;
        out.corner_f_mm += tool_radius_error_mm;
    } else {
        out.corner_e_mm += tool_radius_error_mm;
    }
    return out;
}

base::Result<RealMachine> realMachine(const machine::MachineDefinition& nominal, const MachineErrors& errors,
                                      const CuttingSetup& setup) {
    return realMachineBehind(nominal, setup, errors, nominal, setup, {});
}

base::Result<RealMachine> realMachineBehind(const machine::MachineDefinition& nominal,
                                            const CuttingSetup& nominal_setup, const MachineErrors& errors,
                                            const machine::MachineDefinition& believed,
                                            const CuttingSetup& believed_setup,
                                            const kinematics::RotaryValues& believed_zero_rad) {
    const kinematics::Machine counted_from(nominal);
    const auto parameters = errorParameters(counted_from);
    if (const auto ok = check(errors, parameters, nullptr); !ok) return base::fail(ok.error());
    RealMachine out{.model = counted_from, .tool_length_mm = nominal_setup.tool_length_mm};
    for (const ErrorParameter& parameter : parameters) {
        const auto found = errors.find(parameter.name);
        if (found == errors.end()) continue;
        if (parameter.kind == Kind::ToolLength) out.tool_length_mm += found->second;
        if (parameter.kind == Kind::ToolRadius) out.tool_radius_error_mm = found->second;
        if (parameter.kind == Kind::AxisZero) out.zero_rad.at(parameter.axis) = base::radFromDeg(found->second);
        if (parameter.kind == Kind::Lag) out.lag_s.at(parameter.axis) = found->second / 1000.0;
    }
    out.model = kinematics::Machine(withErrors(nominal, errors));
    const auto touch = kinematics::Machine(believed).solveLinear(believed_setup.wcs_origin_mm, {0.0, 0.0},
                                                                 believed_setup.tool_length_mm);
    if (!touch)
        return base::fail("machine-error.datum", "with its rotary axes at zero this machine cannot reach the datum");
    // A control that knows the zeros commands less by them.
    out.origin_mm = out.place(dynamics::axisVector(
                                  {.linear_mm = *touch, .rotary_rad = {-believed_zero_rad[0], -believed_zero_rad[1]}}))
                        .tip_mm;
    return out;
}

}  // namespace cusp::loop
