// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One child process for each candidate, with a limit on its time and on what it writes.
#include <cusp/optimizer/finishing/outside_cam.hpp>

#include <cusp/base/child_process.hpp>
#include <cusp/base/json_report.hpp>
#include <cusp/base/units.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <array>
#include <fmt/format.h>
#include <sstream>

namespace cusp::finishing {

namespace {

constexpr double seconds_per_minute = 60.0;

tl::unexpected<base::Diagnostics> failure(const std::string& what, const std::string& request) {
    return base::fail("finishing.outside-cam", fmt::format("the outside CAM {}; it was asked for {}", what, request));
}

/// The last thing it said, for people.
std::string lastLine(const std::string& text) {
    const auto end = text.find_last_not_of("\r\n");
    if (end == std::string::npos) return {};
    const auto before = text.find_last_of('\n', end);
    const auto begin = before == std::string::npos ? 0 : before + 1;
    constexpr std::size_t most = 200;
    return ": " + text.substr(begin, std::min(most, end - begin + 1));
}

base::Result<simulation::CutterPath> readPath(const std::string& text) {
    constexpr double chord_mm = 1e-4;
    const std::string name = "answer of the outside CAM";
    std::istringstream in(text);
    toolpath::ClReader reader(in, name);
    base::Diagnostics report;
    simulation::PathCollector collector(name, chord_mm, report);
    for (toolpath::ClRecord record; reader.next(record);) collector.take(record);
    base::Diagnostics all = reader.report();
    all.append(report);
    if (all.hasErrors()) return base::fail(std::move(all));
    return collector.finish();
}

}  // namespace

std::string requestText(const PaperProblem& problem, const PaperCandidate& candidate) {
    const toolpath::Tool& tool = problem.tools[candidate.tool];
    const base::Json out{{"schema", 1},
                         {"tool", tool.name},
                         {"tool_diameter_mm", tool.diameter_mm},
                         {"tool_corner_radius_mm", tool.cutter().corner_radius_mm},
                         {"step_over_mm", candidate.step_over_mm},
                         {"lead_deg", base::degFromRad(candidate.lead_rad)},
                         {"tilt_deg", base::degFromRad(candidate.tilt_rad)},
                         {"chord_tolerance_mm", candidate.chord_tolerance_mm},
                         {"feed_mm_per_min", problem.options.feed_mm_per_s * seconds_per_minute}};
    return out.dump();
}

base::Result<OutsidePath> outsidePath(const OutsideCam& cam, const geometry::NominalShape& shape,
                                      const PaperProblem& problem, const PaperCandidate& candidate) {
    const std::string request = requestText(problem, candidate);
    base::ProcessLimits limits;
    limits.wall_s = cam.wall_s;
    auto outcome = base::runProcess({"/bin/sh", "-c", cam.command}, limits, request + "\n");
    if (!outcome) return base::fail(outcome.error());
    if (!outcome->succeeded())
        return failure(fmt::format("failed ({}){}", base::outcomeText(*outcome), lastLine(outcome->errors)), request);
    auto path = readPath(outcome->output);
    if (!path) return base::fail(path.error());
    OutsidePath out{std::move(outcome->output), *std::move(path), {}};
    out.contacts = findContacts(out.path, shape);
    if (out.contacts.empty())
        return failure("answered with a path that nowhere touches the part at feed; it must be in the frame of the "
                       "nominal, with the cutter in a CUTTER statement",
                       request);
    return out;
}

optimizer::EvaluateBatch outsideEvaluator(const OutsideCam& cam, const geometry::NominalShape& shape,
                                          const PaperProblem& problem, const optimizer::WeightedObjective& objective) {
    return optimizer::inParallel(
        [cam, &shape, problem, objective](const optimizer::Values& values) -> base::Result<optimizer::Evaluation> {
            const PaperCandidate candidate = candidateOf(problem, values);
            const auto path = outsidePath(cam, shape, problem, candidate);
            if (!path) return base::fail(path.error());
            const PaperCriteria criteria = criteriaOf(path->contacts, problem, candidate);
            return optimizer::Evaluation{{objective.value(std::array{criteria.error_mm, criteria.points})},
                                         {criteria.error_mm, criteria.points}};
        });
}

}  // namespace cusp::finishing
