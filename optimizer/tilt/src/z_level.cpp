// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Contours of the surface the tip of the dropped cutter runs on, level by level.
#include "dropped_line.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tbb/parallel_for.h>

namespace cusp::tilt::detail {

using geometry::Vector3;

namespace {

/// How near to the level line a vertex is put, on its free side, as a share of the tolerance.
constexpr double place_share = 0.02;
constexpr int most_halvings = 8;

/// Tip heights at the nodes of a grid.
class TipGrid {
public:
    TipGrid(const DropShape& shape, const ThreeAxisOptions& options) : shape_(shape), options_(options) {
        const Eigen::AlignedBox3d box = shape.bounds();
        for (const int axis : {0, 1}) {
            const auto k = static_cast<std::size_t>(axis);
            double low = options.area.min_mm ? (*options.area.min_mm)[k] : box.min()[axis];
            double high = options.area.max_mm ? (*options.area.max_mm)[k] : box.max()[axis];
            if (options.area.radius_mm) {
                low = std::max(low, options.area.center_mm[k] - *options.area.radius_mm);
                high = std::min(high, options.area.center_mm[k] + *options.area.radius_mm);
            }
            low_[k] = low;
            count_[k] = static_cast<int>(std::ceil(std::max(0.0, high - low) / options.sample_mm)) + 1;
            step_[k] = count_[k] > 1 ? (high - low) / (count_[k] - 1) : 0.0;
        }
        height_.resize(static_cast<std::size_t>(count_[0]) * static_cast<std::size_t>(count_[1]));
        tbb::parallel_for(0, count_[1], [this](int j) {
            for (int i = 0; i < count_[0]; ++i) height_[index(i, j)] = tipAt(x(i), y(j));
        });
    }

    [[nodiscard]] int columns() const { return count_[0]; }
    [[nodiscard]] int rows() const { return count_[1]; }
    [[nodiscard]] double x(int i) const { return low_[0] + i * step_[0]; }
    [[nodiscard]] double y(int j) const { return low_[1] + j * step_[1]; }
    [[nodiscard]] std::size_t index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(count_[0]) + static_cast<std::size_t>(i);
    }
    [[nodiscard]] double height(int i, int j) const { return height_[index(i, j)]; }
    [[nodiscard]] double tipAt(double x_mm, double y_mm) const {
        const auto contact = shape_.drop(x_mm, y_mm);
        return contact ? contact->tip_z_mm : -std::numeric_limits<double>::infinity();
    }
    [[nodiscard]] bool inArea(double x_mm, double y_mm) const { return options_.area.contains(x_mm, y_mm); }
    [[nodiscard]] double sample() const { return options_.sample_mm; }
    [[nodiscard]] double placeTolerance() const { return place_share * options_.tolerance_mm; }
    [[nodiscard]] double tolerance() const { return options_.tolerance_mm; }

private:
    const DropShape& shape_;
    const ThreeAxisOptions& options_;
    std::array<double, 2> low_{};
    std::array<double, 2> step_{};
    std::array<int, 2> count_{};
    std::vector<double> height_;
};

/// One level. A vertex of the contour lies on an edge of the grid: edge 2n goes from node n along X, 2n + 1 along Y.
class Level {
public:
    Level(const TipGrid& grid, double z_mm) : grid_(grid), z_(z_mm) {}

    [[nodiscard]] std::vector<Pass> contours() {
        for (int j = 0; j + 1 < grid_.rows(); ++j)
            for (int i = 0; i + 1 < grid_.columns(); ++i) addCell(i, j);
        std::vector<Pass> out;
        // Open contours first, from their ends: what is left is closed.
        std::vector<Edge> starts;
        for (const auto& [from, to] : next_)
            if (!has_before_.contains(from)) starts.push_back(from);
        for (const Edge start : starts) follow(start, out);
        while (!next_.empty()) follow(next_.begin()->first, out);
        return out;
    }

private:
    using Edge = std::size_t;

    [[nodiscard]] bool blocked(int i, int j) const { return grid_.height(i, j) > z_; }

    /// Walks with the material to the right: climb milling with a spindle that turns clockwise.
    void addCell(int i, int j) {
        const std::array<bool, 4> corner = {blocked(i, j), blocked(i + 1, j), blocked(i + 1, j + 1), blocked(i, j + 1)};
        const std::array<Edge, 4> edge = {2 * grid_.index(i, j), 2 * grid_.index(i + 1, j) + 1,
                                          2 * grid_.index(i, j + 1), 2 * grid_.index(i, j) + 1};
        // Going round the cell counter-clockwise, the contour enters where material begins and leaves where it ends.
        std::vector<std::size_t> begins;
        std::vector<std::size_t> ends;
        for (std::size_t k = 0; k < 4; ++k) {
            const bool here = corner[k];
            const bool there = corner[(k + 1) % 4];
            if (!here && there) begins.push_back(k);
            if (here && !there) ends.push_back(k);
        }
        if (begins.empty()) return;
        if (begins.size() == 2) {
            const double middle = grid_.tipAt((grid_.x(i) + grid_.x(i + 1)) / 2.0, (grid_.y(j) + grid_.y(j + 1)) / 2.0);
            connectSaddle(edge, begins, ends, middle > z_);
            return;
        }
        link(edge[begins[0]], edge[ends[0]]);
    }
    static std::size_t nextOf(std::size_t from, std::size_t to) { return (to + 4 - from) % 4; }
    /// With material in the middle a contour runs from where material begins to where it ended just before, going round; with
    /// none in the middle, to where it ends next.
    void connectSaddle(const std::array<Edge, 4>& edge, const std::vector<std::size_t>& begins,
                       const std::vector<std::size_t>& ends, bool joined) {
        for (const std::size_t begin : begins)
            for (const std::size_t end : ends)
                if (nextOf(begin, end) == (joined ? 3U : 1U)) link(edge[begin], edge[end]);
    }
    void link(Edge from, Edge to) {
        next_[from] = to;
        has_before_.insert(to);
    }

    void follow(Edge start, std::vector<Pass>& out) {
        Pass pass;
        Edge at = start;
        const auto close = [&] {
            if (pass.size() > 1) out.push_back(thinned(refined(pass), grid_.tolerance() / 2.0));
            pass.clear();
        };
        while (true) {
            const Vector3 point = vertex(at);
            if (grid_.inArea(point.x(), point.y()))
                pass.push_back(point);
            else
                close();
            const auto step = next_.find(at);
            if (step == next_.end()) break;
            at = step->second;
            next_.erase(step);
        }
        close();
    }

    /// On the free side of where the grid's edge crosses the level.
    [[nodiscard]] Vector3 vertex(Edge edge) const {
        const auto node = edge / 2;
        const auto columns = static_cast<std::size_t>(grid_.columns());
        const auto i = static_cast<int>(node % columns);
        const auto j = static_cast<int>(node / columns);
        const Vector3 a(grid_.x(i), grid_.y(j), z_);
        const Vector3 b =
            edge % 2 == 0 ? Vector3(grid_.x(i + 1), grid_.y(j), z_) : Vector3(grid_.x(i), grid_.y(j + 1), z_);
        return blocked(i, j) ? crossing(b, a) : crossing(a, b);
    }
    /// By false position, every third step by halving: where a wall makes the height jump only that comes nearer.
    [[nodiscard]] Vector3 crossing(Vector3 free, Vector3 taken) const {
        double below = z_ - grid_.tipAt(free.x(), free.y());
        double above = grid_.tipAt(taken.x(), taken.y()) - z_;
        int steps = 0;
        while ((free - taken).norm() > grid_.placeTolerance()) {
            const bool sound = std::isfinite(below) && below + above > 0.0 && ++steps % 3 != 0;
            double share = sound ? below / (below + above) : 0.5;
            // Never quite to an end, so that both ends move.
            share = std::clamp(share, 0.01, 0.99);
            const Vector3 between = free + share * (taken - free);
            const double excess = grid_.tipAt(between.x(), between.y()) - z_;
            if (excess > 0.0) {
                taken = between;
                above = excess;
            } else {
                free = between;
                below = -excess;
            }
        }
        return free;
    }

    /// With points between, where the level line bends away from the straight way by more than half the tolerance.
    [[nodiscard]] Pass refined(const Pass& pass) const {
        Pass out{pass.front()};
        for (std::size_t i = 1; i < pass.size(); ++i) {
            between(pass[i - 1], pass[i], 0, out);
            out.push_back(pass[i]);
        }
        return out;
    }
    void between(const Vector3& from, const Vector3& to, int depth, Pass& out) const {
        const Vector3 way = to - from;
        const double tolerance = grid_.tolerance() / 2.0;
        if (depth >= most_halvings || way.norm() < tolerance) return;
        const Vector3 left = Vector3(-way.y(), way.x(), 0.0).normalized();
        const Vector3 middle = (from + to) / 2.0;
        const auto taken = [&](double aside) {
            const Vector3 p = middle + aside * left;
            return grid_.tipAt(p.x(), p.y()) > z_;
        };
        // Material is to the right.
        if (!taken(tolerance) && taken(-tolerance)) return;
        double reach = tolerance;
        while (reach < grid_.sample() && !(!taken(reach) && taken(-reach))) reach *= 2.0;
        if (reach >= grid_.sample()) return;
        const Vector3 found = crossing(middle + reach * left, middle - reach * left);
        between(from, found, depth + 1, out);
        out.push_back(found);
        between(found, to, depth + 1, out);
    }

    const TipGrid& grid_;
    double z_;
    std::map<Edge, Edge> next_;
    std::set<Edge> has_before_;
};

}  // namespace

std::vector<Pass> zLevelPasses(const DropShape& shape, const ThreeAxisOptions& options) {
    const TipGrid grid(shape, options);
    const Eigen::AlignedBox3d box = shape.bounds();
    const double highest = options.highest_mm.value_or(box.max().z());
    const double lowest = options.lowest_mm.value_or(box.min().z());
    const auto count =
        highest > lowest ? static_cast<std::size_t>(std::floor((highest - lowest) / options.step_down_mm)) : 0;
    std::vector<std::vector<Pass>> levels(count);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
        levels[k] = Level(grid, highest - static_cast<double>(k + 1) * options.step_down_mm).contours();
    });
    std::vector<Pass> out;
    for (auto& level : levels)
        for (Pass& pass : level) out.push_back(std::move(pass));
    return out;
}

}  // namespace cusp::tilt::detail
