// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Chains of stations, linked shortest first along their tangents.
#include "section_order.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace cusp::inspect {
namespace {

using Stations = std::vector<SectionStation>;

constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
/// Nearer than this two stations are one place, and have no direction between them.
constexpr double same_place_mm = 1e-9;
/// Cosine: a chord may lean this far from the tangents at its ends (87°, for sharp corners).
constexpr double least_agreement = 0.05;
constexpr std::size_t links_looked_at = 6;
/// A link this many times longer than 95 of 100 others must be proved by the nominal.
constexpr double long_link = 3.0;
constexpr double usual_share = 0.95;
/// With more chains than this, ends are not joined: the points do not show a curve.
constexpr std::size_t most_chains = 64;

bool leadsTo(const Stations& stations, std::uint32_t from, std::uint32_t to) {
    const Vector3 chord = stations[to].position - stations[from].position;
    const double length = chord.norm();
    if (length <= same_place_mm) return from < to;
    return stations[from].tangent.dot(chord) > least_agreement * length &&
           stations[to].tangent.dot(chord) > least_agreement * length;
}

struct Link {
    double length_mm;
    std::uint32_t from;
    std::uint32_t to;
    bool operator<(const Link& other) const {
        return std::tie(length_mm, from, to) < std::tie(other.length_mm, other.from, other.to);
    }
};

/// For each station the nearest ones ahead, found by a sweep along the longest side of the section.
std::vector<Link> candidateLinks(const Stations& stations) {
    Eigen::AlignedBox3d box;
    for (const SectionStation& s : stations) box.extend(s.position);
    Eigen::Index along = 0;
    box.sizes().maxCoeff(&along);
    std::vector<std::uint32_t> order(stations.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto coordinate = [&](std::uint32_t i) { return stations[i].position[along]; };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return std::pair(coordinate(a), a) < std::pair(coordinate(b), b);
    });
    std::vector<Link> out;
    std::vector<Link> nearest;
    for (std::size_t at = 0; at < order.size(); ++at) {
        nearest.clear();
        const std::uint32_t from = order[at];
        const auto look_at = [&](std::size_t other) {
            const std::uint32_t to = order[other];
            const bool full = nearest.size() == links_looked_at;
            if (full && std::abs(coordinate(to) - coordinate(from)) > nearest.back().length_mm) return false;
            const Link link{(stations[to].position - stations[from].position).norm(), from, to};
            if ((full && !(link < nearest.back())) || !leadsTo(stations, from, to)) return true;
            if (full) nearest.pop_back();
            nearest.insert(std::upper_bound(nearest.begin(), nearest.end(), link), link);
            return true;
        };
        for (std::size_t other = at; other-- > 0;)
            if (!look_at(other)) break;
        for (std::size_t other = at + 1; other < order.size(); ++other)
            if (!look_at(other)) break;
        out.insert(out.end(), nearest.begin(), nearest.end());
    }
    std::sort(out.begin(), out.end());
    return out;
}

/// Chains grow by their ends; both ends know each other, so that no chain closes on itself.
class Chains {
public:
    explicit Chains(std::size_t count) : next_(count, none), previous_(count, none), other_end_(count) {
        std::iota(other_end_.begin(), other_end_.end(), 0U);
    }

    /// Whether `from` ends a chain and `to` begins another.
    [[nodiscard]] bool canJoin(std::uint32_t from, std::uint32_t to) const {
        return next_[from] == none && previous_[to] == none && other_end_[from] != to;
    }

    void join(std::uint32_t from, std::uint32_t to) {
        next_[from] = to;
        previous_[to] = from;
        const std::uint32_t begin = other_end_[from];
        const std::uint32_t end = other_end_[to];
        other_end_[begin] = end;
        other_end_[end] = begin;
    }

    [[nodiscard]] std::vector<std::uint32_t> begins() const {
        std::vector<std::uint32_t> out;
        for (std::uint32_t i = 0; i < previous_.size(); ++i)
            if (previous_[i] == none) out.push_back(i);
        return out;
    }
    [[nodiscard]] std::uint32_t endOf(std::uint32_t begin) const { return other_end_[begin]; }

    [[nodiscard]] std::vector<std::uint32_t> from(std::uint32_t begin) const {
        std::vector<std::uint32_t> out;
        for (std::uint32_t i = begin; i != none; i = next_[i]) out.push_back(i);
        return out;
    }

private:
    std::vector<std::uint32_t> next_;
    std::vector<std::uint32_t> previous_;
    std::vector<std::uint32_t> other_end_;
};

/// Every station's shortest link tells what is usual.
double usualLength(const std::vector<Link>& links, std::size_t stations) {
    std::vector<double> shortest(stations, std::numeric_limits<double>::infinity());
    for (const Link& link : links) shortest[link.from] = std::min(shortest[link.from], link.length_mm);
    std::erase_if(shortest, [](double length) { return !std::isfinite(length); });
    if (shortest.empty()) return 0.0;
    const auto usual =
        shortest.begin() + static_cast<std::ptrdiff_t>(usual_share * static_cast<double>(shortest.size()));
    std::nth_element(shortest.begin(), usual, shortest.end());
    return *usual;
}

/// Ends and beginnings of chains, the nearest first, wherever the nominal leads from one to the other.
void joinEnds(const SectionPlane& plane, const Stations& stations, const geometry::NominalShape& nominal,
              Chains& chains) {
    const std::vector<std::uint32_t> begins = chains.begins();
    if (begins.size() > most_chains) return;
    std::vector<Link> links;
    for (const std::uint32_t first : begins)
        for (const std::uint32_t second : begins) {
            const std::uint32_t end = chains.endOf(first);
            if (first != second)
                links.push_back({(stations[second].position - stations[end].position).norm(), end, second});
        }
    std::sort(links.begin(), links.end());
    for (const Link& link : links)
        if (chains.canJoin(link.from, link.to) && lengthAlong(plane, stations[link.from], stations[link.to], nominal))
            chains.join(link.from, link.to);
}

/// A closed piece begins at its first measured point; every piece runs as it was measured.
void turn(std::vector<std::uint32_t>& piece, bool is_closed) {
    if (is_closed) std::rotate(piece.begin(), std::min_element(piece.begin(), piece.end()), piece.end());
    double agreement = 0.0;
    const double middle = 0.5 * static_cast<double>(piece.size() - 1);
    for (std::size_t k = 0; k < piece.size(); ++k)
        agreement += (static_cast<double>(k) - middle) * static_cast<double>(piece[k]);
    if (agreement >= 0.0) return;
    std::reverse(piece.begin(), piece.end());
    if (is_closed) std::rotate(piece.begin(), std::prev(piece.end()), piece.end());
}

SectionPiece measuredOut(const SectionPlane& plane, const Stations& stations, std::vector<std::uint32_t> order,
                         double usual_mm, const geometry::NominalShape& nominal) {
    SectionPiece out;
    out.step_mm.push_back(0.0);
    for (std::size_t k = 1; k < order.size(); ++k) {
        const SectionStation& from = stations[order[k - 1]];
        const SectionStation& to = stations[order[k]];
        const bool is_long = (to.position - from.position).norm() > long_link * usual_mm;
        const auto length = is_long ? lengthAlong(plane, from, to, nominal) : std::nullopt;
        out.step_mm.push_back(length.value_or(arcLength(from, to)));
    }
    out.stations = std::move(order);
    return out;
}

}  // namespace

std::vector<SectionStation> stationsIn(const SectionPlane& plane, std::vector<Vector3> positions,
                                       std::vector<Vector3> normals, const geometry::NominalShape& nominal) {
    std::vector<geometry::Footpoint> footpoints(positions.size());
    const Vector3 a = Vector3::Unit(plane.axis);
    constexpr int rounds = 4;
    for (int round = 0; round < rounds; ++round) {
        for (std::size_t i = 0; i < positions.size(); ++i) {
            const Vector3 uphill = a - a.dot(normals[i]) * normals[i];
            const double slope = uphill.squaredNorm();
            const double gap = plane.position_mm - positions[i][plane.axis];
            // A surface parallel to the plane has no section with it; then the point stays where it is.
            if (slope > 1e-6) positions[i] += gap / slope * uphill;
        }
        nominal.closest(positions, footpoints, round > 0);
        for (std::size_t i = 0; i < positions.size(); ++i) {
            positions[i] = footpoints[i].position;
            normals[i] = footpoints[i].normal;
        }
    }
    std::vector<SectionStation> out(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Vector3 tangent = a.cross(normals[i]);
        const double length = tangent.norm();
        out[i] = {positions[i], length > 1e-9 ? Vector3(tangent / length) : Vector3::Zero()};
    }
    return out;
}

double arcLength(const SectionStation& from, const SectionStation& to) {
    const double chord = (to.position - from.position).norm();
    const double half_turn = 0.5 * std::atan2(from.tangent.cross(to.tangent).norm(), from.tangent.dot(to.tangent));
    if (half_turn < 1e-6 || half_turn > 0.25 * std::numbers::pi) return chord;
    return chord * half_turn / std::sin(half_turn);
}

std::optional<double> lengthAlong(const SectionPlane& plane, const SectionStation& from, const SectionStation& to,
                                  const geometry::NominalShape& nominal) {
    const double whole_mm = (to.position - from.position).norm();
    if (whole_mm <= same_place_mm) return 0.0;
    // A half circle bulges by its radius; what leads farther away than this does not lead across the gap.
    const Vector3 middle = 0.5 * (from.position + to.position);
    constexpr double finest = 1.0 / 64.0;
    constexpr int most_steps = 400;
    std::vector<std::pair<SectionStation, SectionStation>> open{{from, to}};
    double length_mm = 0.0;
    for (int step = 0; !open.empty(); ++step) {
        if (step == most_steps) return std::nullopt;
        const auto [a, b] = open.back();
        open.pop_back();
        const Vector3 chord = b.position - a.position;
        const double chord_mm = chord.norm();
        if (chord_mm <= finest * whole_mm) {
            const bool leads =
                a.tangent.dot(chord) > least_agreement * chord_mm && b.tangent.dot(chord) > least_agreement * chord_mm;
            if (!leads && chord_mm > same_place_mm) return std::nullopt;
            length_mm += arcLength(a, b);
            continue;
        }
        const geometry::Footpoint foot = nominal.closest(0.5 * (a.position + b.position));
        const SectionStation half = stationsIn(plane, {foot.position}, {foot.normal}, nominal).front();
        // Where the nominal ends, its edge answers, and one half is as long as the whole.
        constexpr double no_progress = 0.95;
        const double longer_mm = std::max((half.position - a.position).norm(), (b.position - half.position).norm());
        if (!(longer_mm < no_progress * chord_mm) || !((half.position - middle).norm() <= whole_mm) ||
            !(std::abs(half.position[plane.axis] - plane.position_mm) < 1e-3 * whole_mm))
            return std::nullopt;
        open.emplace_back(half, b);
        open.emplace_back(a, half);
    }
    return length_mm;
}

std::vector<SectionPiece> orderedPieces(const SectionPlane& plane, const std::vector<SectionStation>& stations,
                                        const geometry::NominalShape& nominal) {
    const std::vector<Link> links = candidateLinks(stations);
    const double usual_mm = usualLength(links, stations.size());
    Chains chains(stations.size());
    for (const Link& link : links) {
        if (!chains.canJoin(link.from, link.to)) continue;
        // Long ones wait: the nominal says which ends belong together.
        if (link.length_mm > long_link * usual_mm) break;
        chains.join(link.from, link.to);
    }
    joinEnds(plane, stations, nominal, chains);
    std::vector<SectionPiece> out;
    for (const std::uint32_t begin : chains.begins()) {
        std::vector<std::uint32_t> piece = chains.from(begin);
        const bool is_closed = piece.size() > 2 &&
                               lengthAlong(plane, stations[piece.back()], stations[piece.front()], nominal).has_value();
        turn(piece, is_closed);
        out.push_back(measuredOut(plane, stations, std::move(piece), usual_mm, nominal));
    }
    std::sort(out.begin(), out.end(), [](const SectionPiece& a, const SectionPiece& b) {
        return *std::min_element(a.stations.begin(), a.stations.end()) <
               *std::min_element(b.stations.begin(), b.stations.end());
    });
    return out;
}

}  // namespace cusp::inspect
