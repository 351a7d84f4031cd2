// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Samples where the shape asks for them, then drops those that say nothing.
#include "dropped_line.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cusp::tilt::detail {

using geometry::Vector3;

namespace {

/// Half of the tolerance is for finding the points, half for leaving points out.
constexpr double share = 0.5;
constexpr int most_halvings = 14;

class Line {
public:
    Line(const DropShape& shape, PlanePoint from, PlanePoint to, double tolerance_mm)
        : shape_(shape), from_(from), to_(to), tolerance_mm_(tolerance_mm) {}

    struct Sample {
        double t = 0.0;
        bool meets = false;
        Vector3 tip = Vector3::Zero();
    };

    [[nodiscard]] Sample at(double t) {
        const double x = from_.x + t * (to_.x - from_.x);
        const double y = from_.y + t * (to_.y - from_.y);
        const auto contact = shape_.drop(x, y, hint_);
        if (!contact) return {t, false, Vector3::Zero()};
        hint_ = contact->place;
        return {t, true, Vector3(x, y, contact->tip_z_mm)};
    }
    void between(const Sample& a, const Sample& b, int depth, std::vector<Sample>& out) {
        if (depth >= most_halvings) return;
        const Sample middle = at((a.t + b.t) / 2.0);
        const bool all_meet = a.meets && b.meets && middle.meets;
        const bool none_meets = !a.meets && !b.meets && !middle.meets;
        if (none_meets) return;
        const double length = std::hypot(to_.x - from_.x, to_.y - from_.y) * (b.t - a.t);
        if (all_meet && std::abs(middle.tip.z() - (a.tip.z() + b.tip.z()) / 2.0) <= share * tolerance_mm_) {
            out.push_back(middle);
            return;
        }
        if (length <= tolerance_mm_) return;
        between(a, middle, depth + 1, out);
        out.push_back(middle);
        between(middle, b, depth + 1, out);
    }

private:
    const DropShape& shape_;
    PlanePoint from_;
    PlanePoint to_;
    double tolerance_mm_;
    std::uint32_t hint_ = DropContact::no_place;
};

double distanceToChord(const Vector3& point, const Vector3& from, const Vector3& to) {
    const Vector3 way = to - from;
    const double squared = way.squaredNorm();
    const double t = squared > 0.0 ? std::clamp((point - from).dot(way) / squared, 0.0, 1.0) : 0.0;
    return (point - from - t * way).norm();
}

}  // namespace

std::vector<Pass> droppedLine(const DropShape& shape, PlanePoint from, PlanePoint to, const ThreeAxisOptions& options) {
    Line line(shape, from, to, options.tolerance_mm);
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const auto parts = std::max(1, static_cast<int>(std::ceil(length / options.sample_mm)));
    std::vector<Line::Sample> samples{line.at(0.0)};
    for (int k = 1; k <= parts; ++k) {
        const Line::Sample before = samples.back();
        const Line::Sample next = line.at(static_cast<double>(k) / parts);
        line.between(before, next, 0, samples);
        samples.push_back(next);
    }
    std::vector<Pass> passes;
    Pass pass;
    const auto close = [&] {
        if (pass.size() > 1) passes.push_back(thinned(pass, share * options.tolerance_mm));
        pass.clear();
    };
    for (const Line::Sample& sample : samples) {
        if (sample.meets)
            pass.push_back(sample.tip);
        else
            close();
    }
    close();
    return passes;
}

Pass thinned(const Pass& pass, double tolerance_mm) {
    if (pass.size() < 3) return pass;
    std::vector<char> stays(pass.size(), 0);
    stays.front() = stays.back() = 1;
    std::vector<std::pair<std::size_t, std::size_t>> open{{0, pass.size() - 1}};
    while (!open.empty()) {
        const auto [first, last] = open.back();
        open.pop_back();
        double worst = tolerance_mm;
        std::size_t at = 0;
        for (std::size_t i = first + 1; i < last; ++i) {
            const double distance = distanceToChord(pass[i], pass[first], pass[last]);
            if (distance > worst) {
                worst = distance;
                at = i;
            }
        }
        if (at == 0) continue;
        stays[at] = 1;
        open.emplace_back(first, at);
        open.emplace_back(at, last);
    }
    Pass out;
    for (std::size_t i = 0; i < pass.size(); ++i)
        if (stays[i] != 0) out.push_back(pass[i]);
    return out;
}

}  // namespace cusp::tilt::detail
