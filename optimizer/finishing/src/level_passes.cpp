// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Feedback from the exact envelope to the places and leads of passes.
#include <cusp/optimizer/finishing/level_passes.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace cusp::finishing {

namespace {

using simulation::SurfaceEnvelope;

/// Counts as left standing where the tool comes nowhere near.
constexpr double band_mm = 0.2;

/// What each lane cuts too deep, and what stands between it and the next: strip 0 is before lane 0, strip k + 1 behind lane k.
struct LaneReport {
    std::vector<double> overcut_mm;
    std::vector<double> left_mm;
};

std::size_t laneCount(const ContactPath& contacts) {
    std::uint32_t most = 0;
    for (const ContactPoint& point : contacts.points) most = std::max(most, point.lane);
    return static_cast<std::size_t>(most) + 1;
}

/// For each move of the path the contact that stands for it: the one it ends on, else the last before it, else the first.
std::vector<std::uint32_t> contactOfMoves(const FinishingPath& path) {
    std::vector<std::uint32_t> out(path.moves.size(), PathMove::no_contact);
    std::uint32_t last = 0;
    for (std::size_t i = 0; i < path.moves.size(); ++i) {
        if (path.moves[i].contact != PathMove::no_contact) last = path.moves[i].contact;
        out[i] = last;
    }
    return out;
}

/// +1 where the left of the feed is the side of the next lane, else −1; for each pass.
std::vector<double> sidesOf(const ContactPath& contacts) {
    std::vector<Vector3> middles;
    std::vector<const ContactPoint*> points;
    for (std::uint32_t k = 0; k < contacts.passes; ++k) {
        const auto pass = contacts.pass(k);
        points.push_back(&pass[pass.size() / 2]);
    }
    std::vector<double> out(points.size(), 1.0);
    for (std::size_t k = 0; k < points.size(); ++k) {
        // The nearest pass of the same face on another lane.
        double best = std::numeric_limits<double>::infinity();
        for (const ContactPoint* other : points) {
            if (other->face != points[k]->face || other->lane == points[k]->lane) continue;
            const Vector3 way = other->position - points[k]->position;
            if (way.norm() >= best) continue;
            best = way.norm();
            const bool left = way.dot(points[k]->frame.left) > 0.0;
            out[k] = left == (other->lane > points[k]->lane) ? 1.0 : -1.0;
        }
    }
    return out;
}

LaneReport reportOf(const FinishingPath& path, const SurfaceEnvelope& envelope) {
    const ContactPath& contacts = path.contacts;
    const auto of_move = contactOfMoves(path);
    const auto sides = sidesOf(contacts);
    LaneReport out;
    out.overcut_mm.assign(laneCount(contacts), 0.0);
    out.left_mm.assign(out.overcut_mm.size() + 1, -band_mm);
    for (std::size_t i = 0; i < envelope.points.size(); ++i) {
        const auto& point = envelope.points[i];
        if (!point.reached()) continue;  // its neighbours tell where it is
        const ContactPoint& contact = contacts.points[of_move[point.move + 1]];
        const Vector3 away = envelope.grid.points[i].position - contact.position;
        const bool ahead = away.dot(contact.frame.left) * sides[contact.pass] > 0.0;
        out.overcut_mm[contact.lane] = std::max(out.overcut_mm[contact.lane], -point.deviation_mm);
        double& left = out.left_mm[contact.lane + (ahead ? 1 : 0)];
        left = std::max(left, point.deviation_mm);
    }
    return out;
}

/// Widths of the strips change against the height of their ridges: as its fourth root where the lead matches the surface, its
/// square root elsewhere. A third of a power converges for both.
void spread(std::vector<double>& places, const LaneReport& seen, double base_mm, double allowed_mm) {
    constexpr double power = 0.33;
    const std::size_t lanes = places.size();
    std::vector<double> widths(lanes + 1);
    double total = 0.0;
    for (std::size_t k = 0; k <= lanes; ++k) {
        widths[k] = (k < lanes ? places[k] : 1.0) - (k > 0 ? places[k - 1] : 0.0);
        const double ridge = std::max(seen.left_mm[k] - base_mm, 1e-4);
        widths[k] *= std::clamp(std::pow((allowed_mm - base_mm) / ridge, power), 0.7, 1.4);
        total += widths[k];
    }
    double at = 0.0;
    for (std::size_t k = 0; k < lanes; ++k) {
        at += widths[k] / total;
        places[k] = std::min(at, 1.0);
    }
}

void lean(std::vector<double>& factors, const LaneReport& seen, double allowed_mm, int round) {
    constexpr double most_a_round = 0.15;
    constexpr double gain_per_mm = 60.0;
    const double relax = 0.05 * std::pow(0.75, round);
    for (std::size_t k = 0; k < factors.size(); ++k) {
        const double beyond = seen.overcut_mm[k] - allowed_mm;
        factors[k] *= beyond > 0.0 ? 1.0 + std::min(most_a_round, gain_per_mm * beyond) : 1.0 - relax;
    }
}

struct Look {
    LevelledPath answer;
    LaneReport seen;
};

base::Result<Look> look(const Workpiece& part, const geometry::Cutter& cutter, const PlanOptions& options,
                        const LevelOptions& level) {
    auto contacts = planContacts(part, cutter, options);
    if (!contacts) return base::fail(contacts.error());
    Look out;
    out.answer.path = joinPasses(*std::move(contacts), part);
    const auto envelope = simulation::surfaceEnvelope(cutterPath(out.answer.path), part.faces,
                                                      {.spacing_mm = level.grid_mm, .band_mm = band_mm});
    if (!envelope) return base::fail(envelope.error());
    out.answer.left = simulation::summaryOf(*envelope, std::min(level.overcut_mm, level.undercut_mm));
    const auto& left = out.answer.left;
    out.answer.whole = left.reached == left.points;
    out.answer.excess = std::max(left.overcut_max_mm / level.overcut_mm,
                                 (out.answer.whole ? left.undercut_max_mm : std::max(left.undercut_max_mm, band_mm)) /
                                     level.undercut_mm);
    out.seen = reportOf(out.answer.path, *envelope);
    return out;
}

}  // namespace

base::Result<LevelledPath> lookAtPath(const Workpiece& part, const geometry::Cutter& cutter, const PlanOptions& options,
                                      const LevelOptions& level) {
    auto seen = look(part, cutter, options, level);
    if (!seen) return base::fail(seen.error());
    return std::move(seen->answer);
}

base::Result<LevelledPath> levelPasses(const Workpiece& part, const geometry::Cutter& cutter,
                                       const PlanOptions& options, std::int64_t count, const LevelOptions& level,
                                       bool first_in_order) {
    PlanOptions now = options;
    now.passes.count = count;
    if (now.passes.places.size() != static_cast<std::size_t>(count)) {
        now.passes.places.clear();
        for (std::int64_t k = 0; k < count; ++k)
            now.passes.places.push_back((static_cast<double>(k) + 0.5) / static_cast<double>(count));
    }
    now.orientation.pass_safety.resize(static_cast<std::size_t>(count), 1.0);
    std::optional<LevelledPath> best;
    for (int round = 0; round < level.rounds; ++round) {
        auto seen = look(part, cutter, now, level);
        if (!seen) return base::fail(seen.error());
        seen->answer.rounds = round + 1;
        if (!best || seen->answer.excess < best->excess) best = std::move(seen->answer);
        best->rounds = round + 1;
        if (first_in_order && best->excess <= 1.0) break;
        // On trimmed faces a lane may have no contact at all; then nothing is seen of it and it stays.
        seen->seen.overcut_mm.resize(now.passes.places.size(), 0.0);
        seen->seen.left_mm.resize(now.passes.places.size() + 1, level.undercut_mm);
        spread(now.passes.places, seen->seen, now.orientation.depth_offset_mm, level.undercut_mm);
        if (now.orientation.adaptive) lean(now.orientation.pass_safety, seen->seen, level.overcut_mm, round);
    }
    return *std::move(best);
}

}  // namespace cusp::finishing
