// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Writer, reader, verification and simulation, one after the other, without a file in between.
#include "tilt_proof.hpp"

#include "program_moves.hpp"

#include <cusp/post/writer/post_options.hpp>
#include <cusp/post/writer/program_planner.hpp>
#include <cusp/post/writer/sinumerik_writer.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <fmt/format.h>

#include <sstream>
#include <utility>

namespace cusp::cli {
namespace {

/// Of the chords that stand for blocks whose axes run linearly.
constexpr double chord_mm = 1e-3;

base::Result<toolpath::ToolPath> readBack(const std::string& cl_text) {
    std::istringstream text(cl_text);
    base::Diagnostics report;
    return toolpath::readToolPath(text, "tilted.apt", {}, report);
}

void writeProgram(const toolpath::ToolPath& path, const LoadedMachine& machine, const post::PostOptions& options,
                  PostedProof& proof) {
    base::Diagnostics report;
    post::MachineFile file = machine.file;
    file.control.format = post::sufficientFormat(file, options.form.value_or(file.control.form), report);
    post::SinumerikWriter writer([&](std::string_view text) { proof.program += text; }, file,
                                 {options.program_name, options.work_offset, {"COLLISION-FREE PATH BY CUSP TILT"}}, {});
    post::ProgramPlanner planner(file, machine.model, options, "tilted.apt", writer, report);
    std::size_t next = 0;
    const auto source = [&](toolpath::ClRecord& record) {
        if (next == path.records.size()) return false;
        record = path.records[next++];
        return true;
    };
    proof.excursions = planner.run(source, post::ProgramPlanner::Threads::One).excursions;
    writer.finish();
    if (!report.hasErrors()) return;
    proof.program.clear();
    proof.not_posted = base::toText(report);
}

/// The cutter is all that reading moves needs; the rest of the tool comes from the job.
toolpath::Tool cutterOf(const tilt::TiltTool& tool) {
    toolpath::Tool out;
    out.number = tool.number;
    out.name = tool.name;
    out.shape = toolpath::Tool::Shape::Ball;
    out.diameter_mm = tool.diameter_mm;
    out.cutting_height_mm = tool.cutting_height_mm;
    out.gauge_length_mm = tool.lengthMm();
    return out;
}

}  // namespace

base::Result<PostedProof> provePosted(const std::string& cl_text, const std::string& program_name,
                                      const LoadedMachine& machine, const tilt::TiltCase& problem) {
    const auto path = readBack(cl_text);
    if (!path) return base::fail(path.error());
    const tilt::TiltJob& job = problem.job();
    PostedProof proof;
    post::PostOptions options;
    options.program_name = program_name;
    options.tool_length_mm = job.tool.lengthMm();
    options.wcs_origin_mm = job.origin_mm;
    writeProgram(*path, machine, options, proof);
    if (!proof.not_posted.empty()) return proof;

    post::verify::VerifyOptions verifying;
    verifying.tool_length_mm = options.tool_length_mm;
    verifying.wcs_origin_mm = options.wcs_origin_mm;
    std::istringstream program(proof.program);
    auto verified = post::verify::verifyProgram(program, "tilted.mpf", machine.file, &*path, verifying);
    if (!verified) return base::fail(verified.error());
    proof.verification = *std::move(verified);

    const toolpath::Tool tool = cutterOf(job.tool);
    std::istringstream again(proof.program);
    base::Diagnostics report;
    const auto moves = readProgramMoves(again, "tilted.mpf", machine, {}, &tool, chord_mm, report);
    if (!moves) return base::fail(moves.error());
    auto collisions = problem.collisions(moves->moves, job.search.proof_mm, job.tool.stickOutMm());
    if (!collisions) return base::fail(collisions.error());
    proof.collisions = *std::move(collisions);
    return proof;
}

}  // namespace cusp::cli
