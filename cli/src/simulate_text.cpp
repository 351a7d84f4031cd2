// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a simulation says: to people, and as JSON.
#include "input.hpp"
#include "simulate_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace cusp::cli {
namespace {

base::Json vectorJson(const geometry::Vector3& v) { return {v.x(), v.y(), v.z()}; }

std::string_view lineKey(const SimulateInput& input) { return input.is_program ? "program_line" : "cl_line"; }

base::Json collisionJson(const SimulateInput& input, const FoundCollision& found) {
    const simulation::Collision& c = found.collision;
    base::Json out{{"with", found.with}, {"part", found.part()}, {"move", c.move}};
    out[std::string(lineKey(input))] = input.path.moves[c.move].line;
    out["position_mm"] = vectorJson(c.position_mm);
    out["depth_mm"] = c.depth_mm;
    out["volume_mm3"] = c.volume_mm3;
    if (!found.file.empty()) out["file"] = found.file;
    return out;
}

base::Json placeJson(const SimulateInput& input, const simulation::StockDeviation& deviation, std::size_t point,
                     double value_mm) {
    if (!(value_mm > 0.0)) return {};
    const simulation::DeviationPoint& at = deviation.points[point];
    base::Json out{{"position_mm", vectorJson(at.position)}, {"move", at.move}};
    out[std::string(lineKey(input))] = input.path.moves[at.move].line;
    return out;
}

std::string placeText(const SimulateInput& input, std::uint32_t move, const geometry::Vector3& at) {
    return fmt::format("at X{:.3f} Y{:.3f} Z{:.3f}, {} line {}", at.x(), at.y(), at.z(),
                       input.is_program ? "program" : "CL", input.path.moves[move].line);
}

}  // namespace

base::Json simulateSummary(const SimulateFlags& flags, const SimulateInput& input, const SimulateResult& done) {
    base::Json out = base::jsonReport("simulate", 1);
    out["file"] = flags.file;
    out["stock"] = flags.stock.empty() ? base::Json() : base::Json(flags.stock);
    out["nominal"] = flags.nominal.empty() ? base::Json() : base::Json(flags.nominal);
    out["moves"] = input.path.moves.size();
    out["cutter_locations"] = input.path.locations;
    out["tools"] = input.path.cutters.size();
    out["resolution_mm"] = flags.resolution_mm;
    out["sweep_tolerance_mm"] = flags.sweep_tolerance_mm;
    out["seconds"] = done.seconds;
    out["removed_volume_mm3"] = done.removed_volume_mm3;
    out["left_volume_mm3"] = done.after.volume();
    double engaged = 0.0;
    std::size_t cutting = 0;
    for (const auto& move : done.milling.moves) {
        if (move.volume_mm3 > 0.0) ++cutting;
        engaged = std::max(engaged, move.radial_mm);
    }
    out["cutting_moves"] = cutting;
    out["radial_engagement_max_mm"] = engaged;
    const auto* sum = done.deviation ? &done.deviation->summary : nullptr;
    const auto value = [&](double simulation::DeviationSummary::* member) {
        return sum != nullptr && sum->points > 0 ? base::Json(sum->*member) : base::Json();
    };
    out["tolerance_mm"] = flags.tolerance_mm;
    out["deviation_points"] = sum != nullptr ? sum->points : 0;
    out["overcut_max_mm"] = value(&simulation::DeviationSummary::overcut_max_mm);
    out["undercut_max_mm"] = value(&simulation::DeviationSummary::undercut_max_mm);
    out["mean_mm"] = value(&simulation::DeviationSummary::mean_mm);
    out["within_tolerance_percent"] = value(&simulation::DeviationSummary::within_tolerance_percent);
    out["uncut_max_mm"] = value(&simulation::DeviationSummary::uncut_max_mm);
    out["overcut_max_at"] =
        sum != nullptr ? placeJson(input, *done.deviation, sum->deepest, sum->overcut_max_mm) : base::Json();
    out["undercut_max_at"] =
        sum != nullptr ? placeJson(input, *done.deviation, sum->highest, sum->undercut_max_mm) : base::Json();
    double volume = 0.0;
    base::Json collisions = base::Json::array();
    for (const FoundCollision& found : done.collisions) {
        volume += found.collision.volume_mm3;
        collisions.push_back(collisionJson(input, found));
    }
    out["collision_volume_mm3"] = volume;
    out["collisions"] = std::move(collisions);
    out["nominal_resolution_mm"] =
        done.nominal_resolution_mm > 0.0 ? base::Json(done.nominal_resolution_mm) : base::Json();
    out["machine"] = input.machine ? base::Json(input.machine->file.machine.name) : base::Json();
    out["machine_range_violations"] = input.machine ? base::Json(done.violation_count) : base::Json();
    out["linear_travel"] = input.machine && flags.wcs_origin_mm.size() == 3 ? "checked" : "not checked";
    base::Json violations = base::Json::array();
    for (const RangeViolation& violation : done.violations) {
        base::Json item{{"move", violation.move}};
        item[std::string(lineKey(input))] = input.path.moves[violation.move].line;
        item["reason"] = violation.reason;
        violations.push_back(std::move(item));
    }
    out["machine_range"] = std::move(violations);
    return out;
}

std::string simulateText(const SimulateFlags& flags, const SimulateInput& input, const SimulateResult& done) {
    std::string out = fmt::format("{}: {} moves, {} tools; rays {} mm apart\n", fileNameOf(flags.file),
                                  input.path.moves.size(), input.path.cutters.size(), flags.resolution_mm);
    out += fmt::format("  removed            {:12.1f} mm³\n", done.removed_volume_mm3);
    if (done.removed_volume_mm3 == 0.0) out += "  the tool passes the stock by: another frame, or another unit?\n";
    if (done.deviation && done.deviation->summary.points > 0) {
        const auto& sum = done.deviation->summary;
        const auto& points = done.deviation->points;
        out += fmt::format("  within ±{:<8} mm {:12.2f} % of what was cut\n", flags.tolerance_mm,
                           sum.within_tolerance_percent);
        if (sum.overcut_max_mm > 0.0)
            out += fmt::format("  deepest overcut    {:12.4f} mm {}\n", sum.overcut_max_mm,
                               placeText(input, points[sum.deepest].move, points[sum.deepest].position));
        if (sum.undercut_max_mm > 0.0)
            out += fmt::format("  most material left {:12.4f} mm {}\n", sum.undercut_max_mm,
                               placeText(input, points[sum.highest].move, points[sum.highest].position));
    } else if (done.deviation) {
        out += "  nothing of the nominal was cut: another frame, or another unit?\n";
    }
    constexpr std::size_t most_lines = 10;
    for (std::size_t i = 0; i < std::min(most_lines, done.collisions.size()); ++i) {
        const FoundCollision& found = done.collisions[i];
        const std::string into = found.with == "rapid" ? "through the stock in a rapid move" : "into the " + found.with;
        out += fmt::format("  COLLISION: {} {}, {:.3f} mm deep, {:.2f} mm³, {}\n", found.part(), into,
                           found.collision.depth_mm, found.collision.volume_mm3,
                           placeText(input, found.collision.move, found.collision.position_mm));
    }
    if (done.collisions.size() > most_lines)
        out += fmt::format("  … and {} more collisions (--json lists them all)\n", done.collisions.size() - most_lines);
    if (done.collisions.empty()) out += "  no collision\n";
    if (done.violation_count > 0)
        out += fmt::format("  OUT OF RANGE on {}: {} moves; the first, {} line {}: {}\n",
                           input.machine->file.machine.name, done.violation_count, input.is_program ? "program" : "CL",
                           input.path.moves[done.violations.front().move].line, done.violations.front().reason);
    out += fmt::format("  simulated in {:.2f} s\n", done.seconds);
    return out;
}

}  // namespace cusp::cli
