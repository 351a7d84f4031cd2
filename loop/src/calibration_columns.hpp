// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The linear problem of a calibration round: what every unknown does to every measured deviation.
#pragma once

#include "contact_trace.hpp"

#include <cusp/loop/calibration.hpp>

#include <Eigen/Core>

#include <string>
#include <vector>

namespace cusp::loop {

/// A part's points that count, with what stays the same in every round.
struct PreparedPart {
    const CalibrationPart* part = nullptr;
    CmmPlan plan;                        ///< targets: the feet of the measured points
    std::vector<ContactTrace> contacts;  ///< of each target
    std::vector<double> measured_mm;     ///< deviations
    std::vector<double> order;           ///< −½ … ½ over the measurement, for drift
};

/// An unknown by name, and the size it is scaled by.
struct Unknown {
    std::string name;
    double scale = 1.0;
};

/// Deviations, measured. Errors: `calibrate.points`.
[[nodiscard]] base::Result<PreparedPart> preparePart(const CalibrationPart& part, const RealMachine& exact);

/// What the probe would find on the part that `real` cuts. Errors: `calibrate.points`, `simulation.*`.
[[nodiscard]] base::Result<std::vector<double>> predict(const PreparedPart& prepared, const RealMachine& real);

/// Machine parameters first, then poses, drifts, lobes.
[[nodiscard]] std::vector<Unknown> unknownsOf(const std::vector<ErrorParameter>& parameters,
                                              const std::vector<PreparedPart>& parts,
                                              const CalibrationOptions& options);

/// One row a point, one column an unknown, scaled. Errors: those of `realMachine`.
[[nodiscard]] base::Result<Eigen::MatrixXd> columnsOf(const machine::MachineDefinition& nominal,
                                                      const CuttingSetup& setup,
                                                      const std::vector<ErrorParameter>& parameters,
                                                      const MachineErrors& at, const std::vector<PreparedPart>& parts,
                                                      const CalibrationOptions& options);

}  // namespace cusp::loop
