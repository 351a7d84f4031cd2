// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What of a ray parallel to an axis one convex body sweeps in one move, or in a part of one whose axis turns little.
#pragma once

#include "upright_ball.hpp"

#include <cusp/simulation/cutter_body.hpp>
#include <cusp/simulation/tool_move.hpp>

#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace cusp::simulation {

class BodySweep {
public:
    /// A ray seen from the tool.
    struct Ray {
        std::array<double, 3> at;         ///< from the tip at the start to the ray's point at 0, in the tool's frame
        std::array<double, 3> direction;  ///< of the ray, likewise
    };
    using Pieces = std::vector<std::pair<double, double>>;

    /// Splits a move so that each part sweeps what it should within `tolerance_mm` (head comment of the source file). `tag` is
    /// for the caller.
    static void split(const ToolMove& move, const CutterBody& body, double tolerance_mm, std::uint32_t tag,
                      std::vector<BodySweep>& out);

    [[nodiscard]] const Eigen::AlignedBox3d& box() const { return box_; }
    [[nodiscard]] std::uint32_t tag() const { return tag_; }
    [[nodiscard]] const CutterBody& body() const { return *body_; }
    /// Halfway through the part.
    [[nodiscard]] geometry::Vector3 middleTip() const { return tip_ + 0.5 * way_; }
    [[nodiscard]] geometry::Vector3 middleAxis() const { return frame_.row(2); }
    [[nodiscard]] double halfLength() const { return 0.5 * way_.norm(); }
    [[nodiscard]] double halfTurn() const { return 0.5 * turn_rad_; }

    [[nodiscard]] Ray rayAlong(int axis, const geometry::Vector3& origin) const {
        const geometry::Vector3 at = frame_ * (origin - tip_);
        return {{at[0], at[1], at[2]}, {frame_(0, axis), frame_(1, axis), frame_(2, axis)}};
    }
    /// Appends what is swept of the ray between `low` and `high`.
    void cut(const Ray& ray, double low, double high, Pieces& out) const {
        if (by_ball_ && cutByBall(ray, low, high, out)) return;
        cut(ray, low, high, 0.0, 1.0, 0, out);
    }
    /// The sweep as eight rays at a time take it; false where the tool is no ball on a long shaft, turns, or is not upright
    /// in the stock.
    [[nodiscard]] bool asUprightBall(UprightBall& out) const;
    /// How deep inside the sweep a point of the ray lies; negative outside.
    [[nodiscard]] double depth(const Ray& ray, double s) const;

private:
    struct Probe {
        double value, by_s, by_t;
    };
    class TimeSearch;
    /// What a shifting ball sweeps of a ray, by the closed form.
    struct Capsule {
        bool hit = false;
        double entry = 0.0, exit = 0.0;
        double entry_time = 0.0, exit_time = 0.0;
    };
    [[nodiscard]] Capsule capsule(const Ray& ray) const;
    /// False where the answer is not on the ball's lower half.
    [[nodiscard]] bool cutByBall(const Ray& ray, double low, double high, Pieces& out) const;

    [[nodiscard]] Probe probe(const Ray& ray, double s, double t) const;
    void cut(const Ray& ray, double low, double high, double from, double to, int level, Pieces& out) const;
    [[nodiscard]] bool enter(const Ray& ray, double low, double high, double from, double to, double& s,
                             double& t) const;

    const CutterBody* body_ = nullptr;
    std::uint32_t tag_ = 0;
    geometry::Vector3 tip_;
    geometry::Vector3 way_;
    geometry::Matrix3 frame_;  ///< rows: the way the axis turns, across it, the axis halfway
    std::array<double, 3> local_way_{};
    double turn_rad_ = 0.0;
    double bend_mm_ = 0.0;  ///< K
    double tolerance_mm_ = 0.0;
    bool by_ball_ = false;
    Eigen::AlignedBox3d box_;
};

}  // namespace cusp::simulation
