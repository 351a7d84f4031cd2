// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a finishing path is planned by: passes, orientation, steps, links, feed.
#pragma once

#include <cusp/base/diagnostics.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace cusp::finishing {

/// Where the passes lie.
struct PassOptions {
    enum class Family : std::uint8_t {
        ConstantU,  ///< along v
        ConstantV,  ///< along u
        Planes      ///< where parallel planes cut the surface
    };
    enum class Placement : std::uint8_t {
        Even,    ///< equally far apart in the parameter, or planes `step_over_mm` apart
        Arc,     ///< equally far apart along the surface, everywhere
        Scallop  ///< so that the ridge between two passes has the same height everywhere
    };
    enum class Order : std::uint8_t { ZigZag, OneWay };

    Family family = Family::Planes;
    Placement placement = Placement::Even;
    Order order = Order::ZigZag;
    std::array<double, 3> plane_normal{0.0, 1.0, 0.0};  ///< of any length but 0
    /// Even: exactly this apart, as many as fit, centred. Arc: no two neighbours are farther apart anywhere.
    double step_over_mm = 1.0;
    double scallop_mm = 0.01;           ///< Placement::Scallop; `step_over_mm` is then the most two passes may be apart
    std::optional<std::int64_t> count;  ///< that many passes for each face, whatever step-over or scallop ask for
    /// Where each pass lies, 0 … 1 of the whole across a face, ascending; whatever else asks for passes (Arc, Scallop).
    std::vector<double> places;
    /// The first and the last pass lie on the edge of the face instead of half a distance inside (Arc, Scallop).
    bool on_edges = false;
    bool from_last = false;  ///< begins at the other side
    bool reverse = false;    ///< runs the first pass the other way
};

/// How the tool stands on the surface, in the feed frame.
struct OrientationOptions {
    double lead_rad = 0.0;
    double tilt_rad = 0.0;
    /// The lead follows the surface: at each point the smallest with which the cutter is no flatter than the surface is
    /// hollow, times the safety, never below `lead_rad` and never above `lead_max_rad`; smooth along the pass.
    bool adaptive = false;
    double curvature_safety = 1.1;  ///< m: the surface counts as m times as hollow; ≥ 1 never cuts into it
    /// For each pass across a face a factor on the safety; passes beyond the list have 1.
    std::vector<double> pass_safety;
    double lead_max_rad = 0.5;
    double lead_change_rad_per_mm = 0.02;  ///< along the pass; the planner lowers it where the axes are slower
    double smoothing_mm = 4.0;             ///< over this length the lead is averaged
    /// Contact points are moved along the normal by this: below zero the cutter goes deeper, which spends an overcut that is
    /// allowed on a wider step.
    double depth_offset_mm = 0.0;
};

/// How far apart the points of a pass are.
struct StepOptions {
    enum class Method : std::uint8_t {
        Bisection,  ///< halves the parameter until the tolerance holds
        Greedy      ///< each step as long as the tolerance allows
    };
    enum class Measure : std::uint8_t {
        Surface,        ///< sagitta of the curve of contact points
        CutterLocation  ///< sagitta of the curve of tool tips
    };
    Method method = Method::Greedy;
    Measure measure = Measure::Surface;
    double chord_tolerance_mm = 0.01;
    double most_mm = 20.0;       ///< no step is longer
    double most_turn_rad = 0.2;  ///< the tool axis turns by no more in one step
};

/// How the tool comes to a pass, leaves it, and goes to the next.
struct LinkOptions {
    double run_in_mm = 0.0;      ///< straight on before a pass, at the feed
    double run_out_mm = 0.0;     ///< … and beyond its end: beside the contact a wide cutter lags behind it
    double lift_mm = 1.0;        ///< off the surface along the tool axis, before and after a pass
    double clearance_mm = 20.0;  ///< above the highest place of the part, for the first approach and for long links
    std::array<double, 3> up{0.0, 0.0, 1.0};  ///< of any length but 0
    double approach_feed_mm_per_s = 500.0 / 60.0;
};

struct PlanOptions {
    PassOptions passes;
    OrientationOptions orientation;
    StepOptions steps;
    LinkOptions links;
    double feed_mm_per_s = 3000.0 / 60.0;

    /// Errors (`finishing.option`) name the option, its value and what it must be.
    [[nodiscard]] base::Diagnostics check() const;
};

}  // namespace cusp::finishing
