// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a tool has swept so far: discs drawn along segments, found by place.
#pragma once

#include <cusp/optimizer/pocket/region.hpp>

#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cusp::pocket {

class SweptIndex {
public:
    explicit SweptIndex(double radius_mm) : radius_mm_(radius_mm), cell_mm_(radius_mm) {}

    void add(const Point& a, const Point& b) {
        segments_.emplace_back(a, b);
        const auto index = static_cast<std::uint32_t>(segments_.size() - 1);
        const auto [x0, x1] = std::minmax(a.x_mm, b.x_mm);
        const auto [y0, y1] = std::minmax(a.y_mm, b.y_mm);
        for (std::int64_t x = cell(x0 - radius_mm_); x <= cell(x1 + radius_mm_); ++x)
            for (std::int64_t y = cell(y0 - radius_mm_); y <= cell(y1 + radius_mm_); ++y) {
                const Point middle{(static_cast<double>(x) + 0.5) * cell_mm_,
                                   (static_cast<double>(y) + 0.5) * cell_mm_};
                if (distanceToSegment(middle, a, b) <= radius_mm_ + 0.7072 * cell_mm_)
                    cells_[key(x, y)].push_back(index);
            }
    }

    /// Whether p lies within the sweep, or nearer than `slack_mm` to it.
    [[nodiscard]] bool covers(const Point& p, double slack_mm) const {
        const auto found = cells_.find(key(cell(p.x_mm), cell(p.y_mm)));
        if (found == cells_.end()) return false;
        // The latest sweeps are the likeliest to cover what lies beside the tool.
        for (auto i = found->second.rbegin(); i != found->second.rend(); ++i)
            if (distanceToSegment(p, segments_[*i].first, segments_[*i].second) < radius_mm_ + slack_mm) return true;
        return false;
    }

private:
    [[nodiscard]] std::int64_t cell(double mm) const { return static_cast<std::int64_t>(std::floor(mm / cell_mm_)); }
    [[nodiscard]] static std::uint64_t key(std::int64_t x, std::int64_t y) {
        return (static_cast<std::uint64_t>(x) << 32U) ^ (static_cast<std::uint64_t>(y) & 0xffffffffU);
    }

    double radius_mm_;
    double cell_mm_;
    std::vector<std::pair<Point, Point>> segments_;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace cusp::pocket
