// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where a straight line first enters the body that a cutter sweeps in one move, all of the motion included.
#pragma once

#include <cusp/simulation/cutter_body.hpp>
#include <cusp/simulation/tool_move.hpp>

#include <vector>

namespace cusp::simulation {

/// A line p + s·n; only −band < s < band counts.
struct NormalLine {
    geometry::Vector3 origin;
    geometry::Vector3 direction;  ///< unit
};

/// A cutter somewhere near a pose: everything within a distance of the tip and an angle of the axis.
class SweptHull {
public:
    SweptHull() = default;
    SweptHull(const CutterBody& body, const toolpath::CutterLocation& pose, double tip_spread_mm,
              double turn_spread_rad)
        : body_(&body), pose_(pose), tip_spread_mm_(tip_spread_mm), turn_spread_rad_(turn_spread_rad) {}

    /// Holds what the other holds as well; both are of the same cutter.
    void extend(const SweptHull& other);
    /// Lower bound of the distance between a point and the cutter, wherever in the hull it stands.
    [[nodiscard]] double clearance(const geometry::Vector3& point) const;
    [[nodiscard]] const CutterBody& body() const { return *body_; }

private:
    const CutterBody* body_ = nullptr;
    toolpath::CutterLocation pose_;
    double tip_spread_mm_ = 0.0;
    double turn_spread_rad_ = 0.0;
};

/// A move, or a part of one whose axis turns little, ready for many lines.
class SweptMove {
public:
    /// Splits a move so that the axis turns by at most 0.1 rad in each part.
    static void split(const ToolMove& move, std::uint32_t index, const CutterBody& body, std::vector<SweptMove>& out);

    /// About the middle of the move.
    [[nodiscard]] SweptHull hull() const;
    [[nodiscard]] const CutterBody& body() const { return *body_; }

    /// What is near a point: a plane below the distance from the tool, whenever in the move, and the time it is closest.
    struct Nearness {
        double distance_mm = 0.0;  ///< a lower bound at the point
        geometry::Vector3 gradient = geometry::Vector3::Zero();
        double bend =
            0.0;  ///< the plane falls by so much per mm more than the gradient says, for the turning of the tool
        double time = 0.5;

        /// Lower bound of the distance a way from the point, `around_mm` of `nearness` at most.
        [[nodiscard]] double boundAt(const geometry::Vector3& way) const {
            return distance_mm + gradient.dot(way) - (bend > 0.0 ? bend * way.norm() : 0.0);
        }
    };
    [[nodiscard]] Nearness nearness(const geometry::Vector3& point, double around_mm) const;

    /// Lowers `entry_mm` to the first s at which the line is in the body at some time of the move, if that is less by more
    /// than `search_tolerance_mm`. True when it did. `floor_mm`: the search begins there; an entry before it is `floor_mm`.
    /// `time`: where to look first, and where the entry was found.
    bool lowerEntry(const NormalLine& line, double floor_mm, double& entry_mm, double& time) const;

    [[nodiscard]] std::uint32_t move() const { return move_; }

    /// What the answer of `lowerEntry` can be too high by: the search in time stops where no gain above it is left.
    static constexpr double search_tolerance_mm = 1e-6;

private:
    struct Sample {
        double distance = 0.0;
        double by_time = 0.0;  ///< derivative by the time of the move, 0 to 1
        geometry::Vector3 gradient = geometry::Vector3::Zero();
    };
    /// A stretch of the move's time, and where in it the search looks next.
    struct Stretch;
    [[nodiscard]] Sample sample(const geometry::Vector3& x, double time) const;
    /// The least distance on the line from the floor to s, which the body may have come to and left again before s.
    [[nodiscard]] Sample nearest(const NormalLine& line, double time, double floor_mm, double& s_mm) const;
    /// How fast the body's surface moves at most, per time of the move, where the line is.
    [[nodiscard]] double speed(const geometry::Vector3& x) const {
        return length_mm_ + turn_rad_ * ((x - tip_).norm() + length_mm_);
    }
    /// |y''| ≤ K of the head comment in the source file, for points within `around_mm` of x.
    [[nodiscard]] double bend(const geometry::Vector3& x, double around_mm) const {
        return turn_rad_ * (turn_rad_ * ((x - tip_).norm() + length_mm_ + around_mm) + 2.0 * length_mm_);
    }
    [[nodiscard]] double entryAt(const NormalLine& line, double time, double floor_mm, double inside_mm) const;

    const CutterBody* body_ = nullptr;
    std::uint32_t move_ = 0;
    geometry::Vector3 tip_;
    geometry::Vector3 tip_way_;
    geometry::Vector3 axis_;
    geometry::Vector3 axis_side_;  ///< unit, across the axis in the plane it turns in
    double turn_rad_ = 0.0;
    double length_mm_ = 0.0;
};

}  // namespace cusp::simulation
