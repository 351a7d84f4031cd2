// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A path on its way through a shop: posted, sent over a real link to the virtual control, run, cut, measured, inspected.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/inspect/inspection.hpp>
#include <cusp/loop/executed_motion.hpp>
#include <cusp/loop/virtual_cmm.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <cstddef>
#include <string>
#include <vector>

namespace cusp::loop {

struct PostedProgram {
    std::string name;
    std::string text;
    std::size_t blocks = 0;
};

/// As `cusp post` does it, in the machine file's form, without a setup. Errors: those of the planner.
[[nodiscard]] base::Result<PostedProgram> postPath(const toolpath::ToolPath& path, const post::MachineFile& file,
                                                   const kinematics::Machine& machine, const std::string& name,
                                                   base::Diagnostics& warnings);

/// How the program came to the control.
struct DeliveryRecord {
    std::string link;  ///< the address that was used, "modbus-tcp://127.0.0.1:40123"; empty: handed over directly
    std::size_t bytes = 0;
    std::size_t chunks = 0;
    std::size_t chunks_repeated = 0;
    double seconds = 0.0;   ///< of the transfer
    bool compared = false;  ///< read back from the control and found the same
};

struct ExecutedProgram {
    AxisTrack track;  ///< one sample every 2 ms
    DeliveryRecord delivery;
    double run_s = 0.0;        ///< machine time
    double off_path_mm = 0.0;  ///< the most by which the control's smoothing takes the tip off the programmed path
};

/// Listens at `link` (port 0 takes a free one) as the virtual control, sends the program there from this thread, has it read
/// back, armed and started, and runs it in virtual time. An empty `link` hands the program over without one.
/// Errors: those of the link, `shop.transfer` (not delivered, with the reason), `shop.alarm` (the control stopped, with its
/// alarms and the program's line).
[[nodiscard]] base::Result<ExecutedProgram> runProgram(const PostedProgram& program, const post::MachineFile& file,
                                                       const kinematics::Machine& machine, const CuttingSetup& setup,
                                                       const std::string& link);

/// A part cut and looked at.
struct MeasuredPart {
    CmmRun measurement;
    inspect::InspectionReport report;
    double true_max_abs_mm = 0.0;  ///< of the part itself, at the targets

    /// In the fixed datums, as measured.
    [[nodiscard]] double maxAbsInDatum() const;
    [[nodiscard]] double maxAbsBestFit() const;
};

struct InspectionTask {
    const geometry::NominalShape* nominal = nullptr;
    std::string nominal_file;
    CmmPlan plan;
    CmmOptions cmm;
    inspect::InspectionOptions inspection;
};

/// Cuts with the real machine, measures, inspects. Errors: those of `measurePart` and `inspectPoints`.
[[nodiscard]] base::Result<MeasuredPart> cutAndMeasure(const AxisTrack& track, const CutJob& job,
                                                       const RealMachine& real, const InspectionTask& task);

}  // namespace cusp::loop
