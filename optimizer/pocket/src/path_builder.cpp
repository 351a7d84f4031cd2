// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The walk over the point map.
#include <cusp/optimizer/pocket/path_builder.hpp>

#include "material_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <tuple>
#include <utility>

namespace cusp::pocket {

struct PathBuilder::Ground {
    const PocketArea& area;
    const PointMap& map;
    BuildOptions options;
    MaterialRaster material;
    RegionIndex allowed;
};

PathBuilder::PathBuilder(const PocketArea& area, const PointMap& map, const BuildOptions& options) {
    BuildOptions used = options;
    if (!(used.cell_mm > 0.0)) used.cell_mm = std::min(map.spacing_mm / 5.0, area.radius_mm / 25.0);
    ground_ = std::make_unique<Ground>(
        Ground{area, map, used, MaterialRaster(area, used.cell_mm), RegionIndex(area.allowed)});
}

PathBuilder::~PathBuilder() = default;

namespace {

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

/// A step that could be taken: from a place the tool may stand at to a point with material left.
struct Choice {
    std::uint32_t from = nowhere;
    std::uint32_t to = nowhere;
    double engagement_deg = 1e9;
};

}  // namespace

namespace {

class Walk {
public:
    Walk(const PointMap& map, const BuildOptions& options, const RegionIndex& allowed, MaterialRaster material,
         double radius_mm, const std::vector<double>& preference)
        : map_(map),
          options_(options),
          allowed_(allowed),
          material_(std::move(material)),
          radius_mm_(radius_mm),
          preference_(preference),
          done_(map.points.size()),
          order_(map.points.size()) {
        for (std::size_t i = 0; i < done_.size(); ++i) done_[i] = map.peripheral[i];
        std::iota(order_.begin(), order_.end(), 0U);
        std::stable_sort(order_.begin(), order_.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return preference[a] < preference[b]; });
    }

    FlatPath run(const std::string& name) {
        path_.name = name;
        while (true) {
            if (const std::uint32_t next = bestNeighbour(); next != nowhere) {
                cut(next, false);
                continue;
            }
            if (!isAnythingLeft()) break;
            jump();
        }
        finishWalls();
        return std::move(path_);
    }

private:
    [[nodiscard]] const Point& at(std::uint32_t i) const { return map_.points[i]; }

    /// Whether point i has to be visited still; what was cleared in passing is noted.
    bool isLeft(std::uint32_t i) {
        if (done_[i]) return false;
        if (!material_.isClear(at(i), at(i), 0.25)) return true;
        done_[i] = true;
        return false;
    }

    /// Whether the tool may be lowered at p.
    [[nodiscard]] bool isStand(const Point& p) const { return material_.isClear(p, p, 1.0); }

    double turnTo(std::uint32_t j) const {
        const double dx = at(j).x_mm - at(here_).x_mm;
        const double dy = at(j).y_mm - at(here_).y_mm;
        const double scale = std::hypot(dx, dy) * std::hypot(heading_x_, heading_y_);
        return scale > 0.0 ? 1.0 - (dx * heading_x_ + dy * heading_y_) / scale : 0.0;
    }

    std::uint32_t bestNeighbour() {
        if (here_ == nowhere) return nowhere;
        struct Ranked {
            double preference, turn, distance;
            std::uint32_t index;
            bool operator<(const Ranked& o) const {
                return std::tie(preference, turn, distance, index) <
                       std::tie(o.preference, o.turn, o.distance, o.index);
            }
        };
        std::vector<Ranked> ranked;
        for (const std::uint32_t j : map_.neighbours[here_])
            if (!done_[j])
                ranked.push_back({preference_[j], turnTo(j),
                                  std::hypot(at(j).x_mm - at(here_).x_mm, at(j).y_mm - at(here_).y_mm), j});
        std::sort(ranked.begin(), ranked.end());
        for (const Ranked& r : ranked)
            if (isLeft(r.index) && material_.engagementDeg(at(here_), at(r.index)) <= options_.limit_deg)
                return r.index;
        return nowhere;
    }

    bool isAnythingLeft() {
        while (first_ < order_.size() && !isLeft(order_[first_])) ++first_;
        return first_ < order_.size();
    }

    void cut(std::uint32_t to, bool over_limit) {
        cutTo(at(to), over_limit);
        done_[to] = true;
        here_ = to;
    }

    void cutTo(const Point& to, bool over_limit) {
        heading_x_ = to.x_mm - place_.x_mm;
        heading_y_ = to.y_mm - place_.y_mm;
        material_.sweep(place_, to);
        path_.steps.push_back({to, StepKind::Cut, 0.0, over_limit});
        place_ = to;
        here_ = nowhere;
    }

    void goTo(std::uint32_t i) {
        if (i == here_) return;
        goTo(at(i));
        here_ = i;
    }

    void goTo(const Point& to) {
        if (!placed_) {
            path_.start = to;
            placed_ = true;
        } else if (!(to == place_)) {
            const double way = std::hypot(to.x_mm - place_.x_mm, to.y_mm - place_.y_mm);
            const bool link = way < options_.link_mm && material_.isClear(place_, to, 1.0) && isAllowedWay(place_, to);
            path_.steps.push_back({to, link ? StepKind::Link : StepKind::Rapid, 0.0, false});
            heading_x_ = link ? to.x_mm - place_.x_mm : 0.0;
            heading_y_ = link ? to.y_mm - place_.y_mm : 0.0;
            // What lies within a cell of the rim goes with the link.
            if (link) material_.sweep(place_, to);
        }
        place_ = to;
        here_ = nowhere;
    }

    bool isAllowedWay(const Point& a, const Point& b) const {
        const auto parts = std::max(1, static_cast<int>(std::ceil(std::hypot(b.x_mm - a.x_mm, b.y_mm - a.y_mm) / 0.4)));
        for (int i = 1; i < parts; ++i) {
            const double t = static_cast<double>(i) / parts;
            const Point p{a.x_mm + t * (b.x_mm - a.x_mm), a.y_mm + t * (b.y_mm - a.y_mm)};
            if (!isAllowed(p)) return false;
        }
        return true;
    }

    /// The best way to cut point j from a place the tool may stand at.
    Choice choiceFor(std::uint32_t j) {
        Choice best;
        for (const std::uint32_t i : map_.neighbours[j]) {
            if (!done_[i] || !isStand(at(i))) continue;
            const double engagement = material_.engagementDeg(at(i), at(j));
            if (engagement < best.engagement_deg) best = {i, j, engagement};
            if (engagement <= options_.limit_deg) return {i, j, engagement};
        }
        return best;
    }

    void jump() {
        Choice least;
        for (std::size_t k = first_; k < order_.size(); ++k) {
            if (!isLeft(order_[k])) continue;
            const Choice choice = choiceFor(order_[k]);
            if (choice.engagement_deg <= options_.limit_deg) {
                goTo(choice.from);
                return cut(choice.to, false);
            }
            if (choice.engagement_deg < least.engagement_deg) least = choice;
        }
        for (std::size_t k = first_; k < order_.size(); ++k)
            if (isLeft(order_[k]) && shave(at(order_[k]))) return;
        if (openByHelix()) return;
        if (least.from == nowhere) {
            done_[order_[first_]] = true;  // no way leads there; what stays is told as uncleared
            return;
        }
        goTo(least.from);
        cut(least.to, true);
    }

    /// A short cut near p, between places that are no points of the map: of those that keep the limit, the one that clears most.
    /// Tips and slivers that every step of the map meets head-on are taken from their sides.
    bool shave(const Point& p) {
        constexpr int directions = 12;
        const auto around = [](const Point& c, int k, double way) {
            const double angle = 2.0 * std::numbers::pi * k / directions;
            return Point{c.x_mm + way * std::cos(angle), c.y_mm + way * std::sin(angle)};
        };
        Point best_from;
        Point best_to;
        std::size_t most = 3;
        for (const double way : {0.6, 1.2, 2.2})
            for (int k = 0; k < directions; ++k) {
                const Point from = around(p, k, way * map_.spacing_mm);
                if (!isAllowed(from) || !isStand(from)) continue;
                for (int h = 0; h < directions; ++h) {
                    const Point to = around(from, h, 0.7 * map_.spacing_mm);
                    // Rims first: they are the cheaper question.
                    const double engagement = material_.engagementDeg(from, to);
                    if (engagement <= 0.0 || engagement > options_.limit_deg || !isAllowed(to)) continue;
                    const std::size_t removal = material_.removal(from, to);
                    if (removal <= most || !isAllowedWay(from, to)) continue;
                    most = removal;
                    best_from = from;
                    best_to = to;
                }
            }
        if (most <= 3) return false;
        goTo(best_from);
        cutTo(best_to, false);
        return true;
    }

    [[nodiscard]] bool isAllowed(const Point& p) const {
        return allowed_.contains(p) || allowed_.distanceToEdge(p) < 0.003;
    }

    /// At the point left that is farthest from walls; not where there is too little room for one.
    bool openByHelix() {
        std::uint32_t place = nowhere;
        for (const std::uint32_t i : order_)
            if (!done_[i] && (place == nowhere || map_.wall_mm[i] > map_.wall_mm[place]) && isLeft(i)) place = i;
        const double radius = std::min(0.8 * radius_mm_, map_.wall_mm[place]);
        if (radius < 0.3 * radius_mm_) return false;
        if (!placed_) path_.start = at(place);
        placed_ = true;
        path_.steps.push_back({at(place), StepKind::Helix, radius, false});
        material_.sweepRing(at(place), radius);
        done_[place] = true;
        place_ = at(place);
        here_ = place;
        heading_x_ = heading_y_ = 0.0;
        return true;
    }

    /// Along every wall that has material before it, so that no cusp between two points stays.
    void finishWalls() {
        for (const Polygon& polygon : allowed_.region()) {
            for (std::size_t i = 0; i < polygon.size(); ++i) {
                const Point& a = polygon[i];
                const Point& b = polygon[(i + 1) % polygon.size()];
                if (material_.isClear(a, b, 0.0)) continue;
                if (!(place_ == a) || !placed_) goTo(a);
                cutTo(b, false);
            }
        }
    }

    const PointMap& map_;
    const BuildOptions& options_;
    const RegionIndex& allowed_;
    MaterialRaster material_;
    double radius_mm_;
    const std::vector<double>& preference_;
    std::vector<bool> done_;
    std::vector<std::uint32_t> order_;
    std::size_t first_ = 0;
    std::uint32_t here_ = nowhere;
    double heading_x_ = 0.0;
    double heading_y_ = 0.0;
    Point place_;
    bool placed_ = false;
    FlatPath path_;
};

}  // namespace

FlatPath PathBuilder::build(const std::vector<double>& preference, const std::string& name) const {
    return Walk(ground_->map, ground_->options, ground_->allowed, ground_->material, ground_->area.radius_mm,
                preference)
        .run(name);
}

}  // namespace cusp::pocket
