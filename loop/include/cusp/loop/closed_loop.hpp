// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Once around: a part that a wrong machine cuts, its correction, and the second part.
#pragma once

#include <cusp/base/random.hpp>
#include <cusp/base/result.hpp>
#include <cusp/loop/correction.hpp>
#include <cusp/loop/virtual_shop.hpp>

#include <cstdint>
#include <string>

namespace cusp::loop {

/// What a machine in use may have, drawn: lengths and angles normal with the typical size, lags even from 0 to twice it.
[[nodiscard]] MachineErrors drawErrors(const kinematics::Machine& machine, base::Random& random);

/// All of them times `factor`.
[[nodiscard]] MachineErrors scaled(const MachineErrors& errors, double factor);

/// A job as the shop knows it.
struct LoopTask {
    const post::MachineFile* file = nullptr;
    const kinematics::Machine* machine = nullptr;
    CuttingSetup setup{};
    const toolpath::ToolPath* path = nullptr;
    const geometry::ParametricSurface* nominal = nullptr;
    InspectionTask inspection{};
    toolpath::CompensationOptions compensation{};
    std::string link{};  ///< as of `runProgram`
};

struct FirstPart {
    MachineErrors hidden;
    double factor = 1.0;
    MeasuredPart part;
};

/// Makes `drawn` larger, at least a twentieth at a time, until the first part, measured in the fixed datums, is out by more than `out_mm`.
/// Errors: `loop.harmless` (errors as large as machines may have do not show on this part), those of the chain.
[[nodiscard]] base::Result<FirstPart> firstPartOut(const LoopTask& task, const AxisTrack& track, const CutJob& job,
                                                   const MachineErrors& drawn, double out_mm);

/// The path corrected by the field of a measured part, proved, posted and run; the second part measured with `cmm_seed`.
struct SecondPart {
    toolpath::CompensatedPath corrected;
    CorrectionCheck check;
    PostedProgram program;
    ExecutedProgram run;
    MeasuredPart part;
};
/// Errors: `loop.no-field` (with the inspection's reason), `loop.gouge`, those of the chain.
[[nodiscard]] base::Result<SecondPart> secondPart(const LoopTask& task, const MachineErrors& hidden,
                                                  const MeasuredPart& first, std::uint64_t cmm_seed);

}  // namespace cusp::loop
