// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Tables of errors and machine data.
#include "calibration_output.hpp"

#include <fmt/format.h>

namespace cusp::cli {

namespace {

std::string unitOf(const std::string& name) { return name.substr(name.rfind('_') + 1); }

std::string listOf(const std::vector<std::string>& names) {
    std::string out;
    for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
    return out;
}

}  // namespace

base::Json calibrationJson(const std::string& job, const machine::MachineDefinition& nominal,
                           const loop::CalibrationResult& result) {
    base::Json out = base::jsonReport("calibrate", 1);
    out["job"] = job;
    out["machine"] = nominal.name;
    out["points"] = result.points;
    out["unknowns"] = result.unknowns;
    out["rank"] = result.rank;
    out["condition"] = result.condition;
    out["rounds"] = result.rounds;
    out["converged"] = result.converged;
    out["start_rms_mm"] = result.start_rms_mm;
    out["rms_mm"] = result.rms_mm;
    out["noise_mm"] = result.noise_mm;
    out["parameters"] = base::Json::array();
    for (const loop::FoundParameter& found : result.parameters) {
        base::Json entry;
        entry["name"] = found.parameter.name;
        entry["meaning"] = found.parameter.meaning;
        entry["state"] = std::string(stateName(found.state));
        entry["known"] = found.known;
        const bool says = found.state != loop::ParameterState::Inseparable;
        entry["value"] = says ? base::Json(found.value) : base::Json();
        entry["standard_uncertainty"] = says ? base::Json(found.standard_uncertainty) : base::Json();
        entry["interval_95"] = says ? base::Json(found.interval_95) : base::Json();
        entry["significant"] = found.significant;
        entry["with"] = found.with;
        entry["remedy"] = found.state == loop::ParameterState::Identified ? base::Json() : base::Json(found.remedy);
        out["parameters"].push_back(std::move(entry));
    }
    out["machine_data"] = base::Json::array();
    for (const loop::MachineDatum& datum : machineData(nominal, result))
        out["machine_data"].push_back({{"name", datum.name},
                                       {"parameter", datum.parameter},
                                       {"change", datum.change},
                                       {"uncertainty_95", datum.uncertainty},
                                       {"note", datum.note}});
    return out;
}

std::string calibrationText(const machine::MachineDefinition& nominal, const loop::CalibrationResult& result) {
    std::string out =
        fmt::format("{}: {} points, {} unknowns, rank {}; {:.2f} µm before, {:.2f} µm left\n", nominal.name,
                    result.points, result.unknowns, result.rank, result.start_rms_mm * 1e3, result.rms_mm * 1e3);
    if (!result.converged) out += "  NOT CONVERGED: the rounds ended before the parts cut anew fitted\n";
    for (const loop::FoundParameter& found : result.parameters) {
        const std::string& name = found.parameter.name;
        if (found.state == loop::ParameterState::Inseparable) {
            out += found.with.empty()
                       ? fmt::format("  {:22} not seen by these measurements\n{:25}{}\n", name, "", found.remedy)
                       : fmt::format("  {:22} not to be separated from {}\n{:25}{}\n", name, listOf(found.with), "",
                                     found.remedy);
            continue;
        }
        out += fmt::format("  {:22} {:+9.5f} ± {:.5f} {:3} {}\n", name, found.value, found.interval_95, unitOf(name),
                           found.known                                 ? "as stated, and as the points bear it out"
                           : found.state == loop::ParameterState::Weak ? "too uncertain to correct"
                           : found.significant                         ? "CORRECTED"
                                                                       : "nothing found");
        if (found.state == loop::ParameterState::Weak && !found.known)
            out += fmt::format("{:25}{}\n", "", found.remedy);
    }
    const auto data = machineData(nominal, result);
    if (!data.empty()) out += "to enter in the control (840D), as changes:\n";
    for (const loop::MachineDatum& datum : data)
        out += fmt::format("  {:38} {:+10.6f} ± {:.6f}  {}\n", datum.name, datum.change, datum.uncertainty, datum.note);
    return out;
}

}  // namespace cusp::cli
