// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Prepares parts and works out columns by differences of the machine's forward kinematics.
#include "calibration_columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace cusp::loop {
namespace {

/// Of poses, drifts and lobes: what measurements have.
constexpr double shift_scale_mm = 0.03;
constexpr double turn_scale_rad = 3e-4;
constexpr double drift_scale_mm = 0.001;
constexpr double lobe_scale_mm = 0.0005;
/// An error of the usual size that moves no point by more is not seen: what is left is the rounding of records and contacts.
constexpr double unseen_mm = 1e-5;
/// Points not cut, of all, that are still an accident.
constexpr double most_missing = 0.2;

std::vector<CmmTarget> targetsOf(const CalibrationPart& part, std::vector<double>& measured_mm) {
    std::vector<geometry::Footpoint> feet(part.points->size());
    part.nominal->closest(part.points->positions, feet, false);
    std::vector<CmmTarget> out;
    for (const geometry::Footpoint& foot : feet) {
        if (foot.on_boundary || !foot.position.allFinite()) continue;
        out.push_back({.position = foot.position, .normal = foot.normal});
        measured_mm.push_back(foot.distance_mm - part.probe_radius_mm);
    }
    return out;
}

Vector3 centreOf(const std::vector<CmmTarget>& targets) {
    Vector3 sum = Vector3::Zero();
    for (const CmmTarget& target : targets) sum += target.position;
    return sum / static_cast<double>(std::max<std::size_t>(targets.size(), 1));
}

std::size_t rowsOf(const std::vector<PreparedPart>& parts) {
    std::size_t rows = 0;
    for (const PreparedPart& part : parts) rows += part.measured_mm.size();
    return rows;
}

/// Poses, drifts, lobes: what the measurement itself may have.
void fillMeasurement(const std::vector<PreparedPart>& parts, const CalibrationOptions& options, Eigen::Index column,
                     Eigen::MatrixXd& out) {
    Eigen::Index row = 0;
    const Eigen::Index lobes = out.cols() - 2;
    for (const PreparedPart& prepared : parts) {
        const Eigen::Index pose = column;
        if (!prepared.part->fixed_datums) column += 6;
        const Eigen::Index drift = column;
        if (options.drift) column += 3;
        const Vector3 centre = centreOf(prepared.plan.targets);
        for (std::size_t i = 0; i < prepared.measured_mm.size(); ++i, ++row) {
            const Vector3& n = prepared.plan.targets[i].normal;
            if (!prepared.part->fixed_datums) {
                out.block<1, 3>(row, pose) = shift_scale_mm * n.transpose();
                out.block<1, 3>(row, pose + 3) =
                    turn_scale_rad * (prepared.plan.targets[i].position - centre).cross(n).transpose();
            }
            if (options.drift) out.block<1, 3>(row, drift) = drift_scale_mm * prepared.order[i] * n.transpose();
            if (options.lobes) {
                const double around = 3.0 * std::atan2(-n.y(), -n.x());
                const double sideways = lobe_scale_mm * std::hypot(n.x(), n.y());
                out(row, lobes) = sideways * std::cos(around);
                out(row, lobes + 1) = sideways * std::sin(around);
            }
        }
    }
}

}  // namespace

base::Result<PreparedPart> preparePart(const CalibrationPart& part, const RealMachine& exact) {
    PreparedPart out{.part = &part, .plan = {}, .contacts = {}, .measured_mm = {}, .order = {}};
    std::vector<double> measured_mm;
    const std::vector<CmmTarget> targets = targetsOf(part, measured_mm);
    const auto traces = traceContacts(*part.track, *part.job, exact, targets);
    if (!traces) return base::fail(traces.error());
    const double last = std::max(1.0, static_cast<double>(targets.size()) - 1.0);
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const auto& trace = (*traces)[i];
        if (!trace) continue;
        out.plan.targets.push_back(targets[i]);
        out.contacts.push_back(*trace);
        out.measured_mm.push_back(measured_mm[i]);
        out.order.push_back(static_cast<double>(i) / last - 0.5);
    }
    const std::size_t all = part.points->size();
    if (static_cast<double>(all - out.measured_mm.size()) > most_missing * static_cast<double>(all))
        return base::fail(
            "calibrate.points",
            fmt::format("{}: {} of {} points lie at edges or where the tool does not cut: another frame, or "
                        "another part?",
                        part.name, all - out.measured_mm.size(), all));
    return out;
}

base::Result<std::vector<double>> predict(const PreparedPart& prepared, const RealMachine& real) {
    const CalibrationPart& part = *prepared.part;
    const auto cut = realPath(*part.track, real, part.job->cutter(), part.job->part_from_wcs);
    CmmOptions exact{.noise_mm = 0.0, .form_mm = 0.0, .drift_mm = 0.0};
    // Surface points were compensated by somebody; a small ball stands for what touched them.
    exact.probe_radius_mm = part.probe_radius_mm > 0.0 ? part.probe_radius_mm : 0.5;
    const auto run = measurePart(cut, prepared.plan, *part.nominal, exact);
    if (!run) return base::fail(run.error());
    if (run->not_cut > 0)
        return base::fail(
            "calibrate.points",
            fmt::format("{}: with the errors found the tool leaves {} of the points uncut", part.name, run->not_cut));
    std::vector<geometry::Footpoint> feet(run->points.size());
    part.nominal->closest(run->points.positions, feet, false);
    std::vector<double> out;
    for (const geometry::Footpoint& foot : feet) out.push_back(foot.distance_mm - exact.probe_radius_mm);
    return out;
}

std::vector<Unknown> unknownsOf(const std::vector<ErrorParameter>& parameters, const std::vector<PreparedPart>& parts,
                                const CalibrationOptions& options) {
    std::vector<Unknown> out;
    for (const ErrorParameter& parameter : parameters) out.push_back({parameter.name, parameter.typical});
    for (const PreparedPart& prepared : parts) {
        if (!prepared.part->fixed_datums)
            for (const char* name : {"x", "y", "z", "about x", "about y", "about z"})
                out.push_back({fmt::format("pose of {} ({})", prepared.part->name, name),
                               std::string_view(name).size() == 1 ? shift_scale_mm : turn_scale_rad});
        if (options.drift)
            for (const char* name : {"x", "y", "z"})
                out.push_back({fmt::format("drift over {} ({})", prepared.part->name, name), drift_scale_mm});
    }
    if (options.lobes)
        for (const char* name : {"cosine", "sine"})
            out.push_back({fmt::format("lobes of the probe ({})", name), lobe_scale_mm});
    return out;
}

base::Result<Eigen::MatrixXd> columnsOf(const machine::MachineDefinition& nominal, const CuttingSetup& setup,
                                        const std::vector<ErrorParameter>& parameters, const MachineErrors& at,
                                        const std::vector<PreparedPart>& parts, const CalibrationOptions& options) {
    const auto exact = realMachine(nominal, {}, setup);
    if (!exact) return base::fail(exact.error());
    Eigen::MatrixXd out =
        Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(rowsOf(parts)),
                              static_cast<Eigen::Index>(unknownsOf(parameters, parts, options).size()));
    for (std::size_t j = 0; j < parameters.size(); ++j) {
        const ErrorParameter& parameter = parameters[j];
        // Lags do not go below zero: the difference is taken forward.
        const bool forward = parameter.kind == ErrorParameter::Kind::Lag;
        const double step = 0.1 * parameter.typical;
        std::array<std::optional<RealMachine>, 2> machines;
        for (std::size_t side = 0; side < 2; ++side) {
            MachineErrors moved = at;
            moved[parameter.name] += side == 1 ? step : (forward ? 0.0 : -step);
            auto real = realMachine(nominal, moved, setup);
            if (!real) return base::fail(real.error());
            machines.at(side) = *std::move(real);
        }
        const double width = (forward ? 1.0 : 2.0) * step / parameter.typical;
        Eigen::Index row = 0;
        const auto column = static_cast<Eigen::Index>(j);
        for (const PreparedPart& part : parts)
            for (const ContactTrace& contact : part.contacts)
                out(row++, column) =
                    (contactShift(contact, *machines[1], *exact) - contactShift(contact, *machines[0], *exact)) / width;
        if (out.col(column).cwiseAbs().maxCoeff() < unseen_mm) out.col(column).setZero();
    }
    fillMeasurement(parts, options, static_cast<Eigen::Index>(parameters.size()), out);
    return out;
}

}  // namespace cusp::loop
