// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The way around, step by step.
#include <cusp/loop/closed_loop.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cusp::loop {

MachineErrors drawErrors(const kinematics::Machine& machine, base::Random& random) {
    MachineErrors out;
    for (const ErrorParameter& parameter : errorParameters(machine))
        out[parameter.name] = parameter.kind == ErrorParameter::Kind::Lag ? random.uniform(0.0, 2.0 * parameter.typical)
                                                                          : random.normal(0.0, parameter.typical);
    return out;
}

MachineErrors scaled(const MachineErrors& errors, double factor) {
    MachineErrors out = errors;
    for (auto& [name, value] : out) value *= factor;
    return out;
}

base::Result<FirstPart> firstPartOut(const LoopTask& task, const AxisTrack& track, const CutJob& job,
                                     const MachineErrors& drawn, double out_mm) {
    constexpr int most_steps = 40;
    constexpr double least_step = 1.05;
    constexpr double most_step = 3.0;
    double factor = 0.1;
    for (int i = 0; i < most_steps; ++i) {
        MachineErrors hidden = scaled(drawn, factor);
        const auto real = realMachine(task.file->machine, hidden, task.setup);
        if (!real) return base::fail(real.error());
        auto part = cutAndMeasure(track, job, *real, task.inspection);
        if (!part) return base::fail(part.error());
        if (part->maxAbsInDatum() > out_mm)
            return FirstPart{.hidden = std::move(hidden), .factor = factor, .part = *std::move(part)};
        // The deviation grows about as the errors do, on top of what the path leaves: not quite all of the way at once.
        constexpr double careful = 0.95;
        factor *= std::clamp(careful * out_mm / part->maxAbsInDatum(), least_step, most_step);
    }
    return base::fail("loop.harmless",
                      fmt::format("errors {:.0f} times as large as usual leave the part within {} mm", factor, out_mm));
}

base::Result<SecondPart> secondPart(const LoopTask& task, const MachineErrors& hidden, const MeasuredPart& first,
                                    std::uint64_t cmm_seed) {
    if (!first.report.datum.field)
        return base::fail("loop.no-field", "the inspection gives no deviation field: " + first.report.no_field);
    const geometry::DeviationField& field = *first.report.datum.field;
    auto corrected = toolpath::compensate(*task.path, *task.nominal, field, task.compensation);
    if (!corrected) return base::fail(corrected.error());
    const auto check = checkCorrection(*task.path, corrected->path, *task.nominal, field, task.compensation);
    if (!check) return base::fail(check.error());
    if (!check->holds())
        return base::fail(
            "loop.gouge",
            fmt::format("the corrected path cuts {:.4f} mm deeper than meant at X{:.2f} Y{:.2f} Z{:.2f}; {} mm are "
                        "allowed",
                        check->gouge_mm, check->gouge_at_mm.x(), check->gouge_at_mm.y(), check->gouge_at_mm.z(),
                        check->allowed_mm));
    base::Diagnostics warnings;
    auto program = postPath(corrected->path, *task.file, *task.machine, "CORRECTED", warnings);
    if (!program) return base::fail(program.error());
    auto run = runProgram(*program, *task.file, *task.machine, task.setup, task.link);
    if (!run) return base::fail(run.error());
    const auto real = realMachine(task.file->machine, hidden, task.setup);
    if (!real) return base::fail(real.error());
    const auto job = cutJob(corrected->path);
    if (!job) return base::fail(job.error());
    InspectionTask again = task.inspection;
    again.cmm.seed = cmm_seed;
    auto part = cutAndMeasure(run->track, *job, *real, again);
    if (!part) return base::fail(part.error());
    return SecondPart{.corrected = *std::move(corrected),
                      .check = *check,
                      .program = *std::move(program),
                      .run = *std::move(run),
                      .part = *std::move(part)};
}

}  // namespace cusp::loop
