// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a machine definition has wrong, found from measured parts; and what these parts cannot tell.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/closest_point.hpp>
#include <cusp/inspect/measured_points.hpp>
#include <cusp/loop/executed_motion.hpp>
#include <cusp/loop/machine_error.hpp>
#include <cusp/loop/virtual_cmm.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace cusp::loop {

/// A part that was cut and measured. Everything pointed to must outlive the calibration.
struct CalibrationPart {
    std::string name;
    const CutJob* job = nullptr;
    const AxisTrack* track = nullptr;  ///< what the control commanded when it was cut
    const geometry::NominalShape* nominal = nullptr;
    const inspect::MeasuredPoints* points = nullptr;  ///< centres or surface points, in the frame of the nominal
    double probe_radius_mm = 0.0;                     ///< 0 for surface points
    /// The measuring machine's frame is that of the machine's own datums; else the part's pose is unknown and solved for.
    bool fixed_datums = false;
};

/// A value known from elsewhere: a presetter, a ball bar, a laser. In the parameter's unit.
struct KnownValue {
    std::string name;
    double value = 0.0;
    double uncertainty = 0.0;  ///< standard
};

struct CalibrationOptions {
    /// Standard deviation of one measured deviation; 0: from what the fit leaves.
    double noise_mm = 0.0;
    bool drift = true;  ///< the measuring machine may drift evenly from the first point of a part to the last
    bool lobes = true;  ///< its trigger may have three lobes about the stylus
    std::vector<KnownValue> known;
    int rounds = 4;  ///< most times the parts are cut anew with what was found
};

enum class ParameterState {
    Identified,   ///< determined, with a useful interval
    Weak,         ///< determined, but its interval is wider than the errors machines in use have
    Inseparable,  ///< these measurements see it only together with others
};
[[nodiscard]] std::string_view stateName(ParameterState state);

struct FoundParameter {
    ErrorParameter parameter;
    ParameterState state = ParameterState::Inseparable;
    double value = 0.0;  ///< in the parameter's unit; of inseparable ones without meaning
    double standard_uncertainty = 0.0;
    double interval_95 = 0.0;       ///< half its width
    bool significant = false;       ///< zero lies outside of the interval
    bool known = false;             ///< stated, not found
    std::vector<std::string> with;  ///< the others an inseparable one is seen together with
    std::string remedy;             ///< which measurement would separate or sharpen it
};

struct CalibrationResult {
    std::vector<FoundParameter> parameters;  ///< in the order of `errorParameters`
    std::size_t points = 0;
    std::size_t unknowns = 0;  ///< of the machine and of the measurement (poses, drift, lobes)
    std::size_t rank = 0;      ///< of what the points determine
    double condition = 0.0;    ///< of the determined part, columns scaled by typical errors
    double start_rms_mm = 0.0;
    double rms_mm = 0.0;
    double noise_mm = 0.0;  ///< per point: stated, or from what is left
    int rounds = 0;
    bool converged = false;

    /// What may be corrected: identified and significant.
    [[nodiscard]] MachineErrors corrections() const;
};

/// Least squares (Ceres) of all deviations over all errors, poses of parts, drift and lobes at once. The model is the whole
/// chain: each round cuts every part anew on the machine found so far and touches it as the probe did; derivatives follow
/// each contact point through the machine's forward kinematics. Nothing is held back to make a solution unique: an error is
/// identified only if the points determine it with all others free.
/// Errors: `calibrate.no-parts`, `calibrate.points` (too few, or where the tool does not cut), `calibrate.known` (no such
/// parameter), `calibrate.solver`, those of `realMachine`.
[[nodiscard]] base::Result<CalibrationResult> calibrate(const machine::MachineDefinition& nominal,
                                                        const CuttingSetup& setup,
                                                        const std::vector<CalibrationPart>& parts,
                                                        const CalibrationOptions& options);

/// The machine file with the corrections in it. Lengths of tools and lags are not in a machine file.
[[nodiscard]] machine::MachineDefinition correctedMachine(const machine::MachineDefinition& nominal,
                                                          const MachineErrors& corrections);

/// What to enter in a Sinumerik 840D.
struct MachineDatum {
    std::string name;          ///< "MD24550 $MC_TRAFO5_BASE_TOOL_1[2]"
    std::string parameter;     ///< of the error
    double change = 0.0;       ///< to be added, mm or degrees; of directions a component
    double uncertainty = 0.0;  ///< 95 %, half width
    std::string note;
};

/// For heads (transformer type 24, both rotary axes on the tool: SINUMERIK Operate commissioning manual 12/2017, p. 572); of
/// other kinematics only what does not depend on the type. Only identified, significant errors.
[[nodiscard]] std::vector<MachineDatum> machineData(const machine::MachineDefinition& nominal,
                                                    const CalibrationResult& result);

}  // namespace cusp::loop
