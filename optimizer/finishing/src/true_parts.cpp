// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Levelling, timing and proof of one path.
#include "true_parts.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::finishing {

LevelOptions levelOptions(const TrueProblem& problem, double grid_mm) {
    constexpr double kept_back = 0.05;
    LevelOptions out;
    out.overcut_mm = out.undercut_mm = problem.tolerance_mm * (1.0 - kept_back);
    out.grid_mm = grid_mm;
    out.rounds = problem.level_rounds;
    return out;
}

PlanOptions adaptiveOptions(const TrueProblem& problem, double depth_mm, double safety) {
    PlanOptions out = problem.options;
    out.passes.placement = PassOptions::Placement::Scallop;
    out.passes.scallop_mm = 2.0 * problem.tolerance_mm;
    out.orientation.adaptive = true;
    out.orientation.curvature_safety = safety;
    out.orientation.depth_offset_mm = depth_mm;
    return out;
}

PlanOptions constantOptions(const TrueProblem& problem, double depth_mm, double lead_rad, double tilt_rad) {
    PlanOptions out = adaptiveOptions(problem, depth_mm, 1.0);
    out.orientation.adaptive = false;
    out.orientation.lead_rad = lead_rad;
    out.orientation.tilt_rad = tilt_rad;
    return out;
}

base::Result<std::int64_t> ridgeCount(const Workpiece& part, const TrueProblem& problem,
                                      const geometry::Cutter& cutter) {
    constexpr double usual_safety = 1.1;
    const auto passes = layOutPasses(part.faces, part.shape, cutter, adaptiveOptions(problem, 0.0, usual_safety));
    if (!passes) return base::fail(passes.error());
    std::int64_t most = 0;
    for (const PassCurve& pass : *passes) most = std::max<std::int64_t>(most, pass.lane() + 1);
    return most;
}

double estimatedTime(const FinishingPath& path) {
    double time = 0.0;
    for (std::size_t i = 1; i < path.moves.size(); ++i)
        if (path.moves[i].kind == toolpath::MotionKind::Feed)
            time += (path.moves[i].location.tip_mm - path.moves[i - 1].location.tip_mm).norm() /
                    path.moves[i].feed_mm_per_s;
    return time;
}

base::Result<MachineTime> timeOf(const FinishingPath& path, const TrueProblem& problem, const toolpath::Tool& tool) {
    MachineSetting setting = problem.setting;
    if (!problem.tool_length_fixed) setting.tool_length_mm = tool.gauge_length_mm;
    return machineTime(timedMoves(path), setting);
}

base::Result<ProvedPath> leveled(const Workpiece& part, const TrueProblem& problem, std::size_t tool,
                                 const PlanOptions& options, std::int64_t count) {
    auto path =
        levelPasses(part, problem.tools[tool].cutter(), options, count, levelOptions(problem, problem.level_grid_mm));
    if (!path) return base::fail(path.error());
    const auto time = timeOf(path->path, problem, problem.tools[tool]);
    if (!time) return base::fail(time.error());
    ProvedPath out;
    out.tool = tool;
    out.levelled = *std::move(path);
    out.time = *time;
    return out;
}

FrontPoint frontPointOf(const ProvedPath& path, const TrueProblem& problem, bool adaptive, double lead_rad) {
    return {path.tool,         path.levelled.path.contacts.passes,
            path.time.total_s, path.levelled.excess * levelOptions(problem, 1.0).overcut_mm,
            adaptive,          lead_rad};
}

base::Result<ProvedPath> prove(const Workpiece& part, const TrueProblem& problem, ProvedPath path, bool insist) {
    constexpr int attempts = 6;
    constexpr double tighter = 0.97;
    double allowed = levelOptions(problem, 1.0).overcut_mm;
    // A finer grid finds up to a twentieth more between the points of this one; what is compared with gets the benefit of that.
    const double limit_mm = insist ? allowed : problem.tolerance_mm;
    for (int attempt = 0; attempt < attempts; ++attempt) {
        constexpr double band_mm = 0.5;
        const auto envelope = simulation::surfaceEnvelope(cutterPath(path.levelled.path), part.faces,
                                                          {.spacing_mm = problem.proof_grid_mm, .band_mm = band_mm});
        if (!envelope) return base::fail(envelope.error());
        path.proof = simulation::summaryOf(*envelope, problem.tolerance_mm);
        path.proved = path.proof.reached == path.proof.points && path.proof.overcut_max_mm <= limit_mm &&
                      path.proof.undercut_max_mm <= limit_mm;
        if (path.proved || !insist) break;
        allowed *= tighter;
        LevelOptions level = levelOptions(problem, problem.level_grid_mm);
        level.overcut_mm = level.undercut_mm = allowed;
        PlanOptions options = path.levelled.path.contacts.options;
        const auto count = static_cast<std::int64_t>(options.passes.places.size()) + (attempt % 2 == 1 ? 1 : 0);
        auto again = levelPasses(part, problem.tools[path.tool].cutter(), options, count, level);
        if (!again) return base::fail(again.error());
        const auto time = timeOf(again->path, problem, problem.tools[path.tool]);
        if (!time) return base::fail(time.error());
        path.levelled = *std::move(again);
        path.time = *time;
    }
    return path;
}

}  // namespace cusp::finishing
