// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Whether the linear axes keep their travel over a whole path, between block ends too, to a stated bound.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/kinematics/machine.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace cusp::kinematics {

struct TravelOptions {
    /// What a linear axis may do between two looks without being seen: no position goes further than this beyond those
    /// looked at, while they keep their limits.
    double bound_mm = 0.01;
    /// Name of the CL file, for messages.
    std::string file_name;

    /// Errors (`kinematics.option`) name the option, its value and what it must be.
    [[nodiscard]] base::Diagnostics check() const;
};

struct TravelSummary {
    static constexpr double infinity = std::numeric_limits<double>::infinity();
    static constexpr std::pair<double, double> no_range{infinity, -infinity};
    /// Smallest and largest position of each linear axis, in chain order, within the bound, or within a thousandth of how far
    /// they lie beyond a limit; meaningless without moves.
    std::array<std::pair<double, double>, 3> range_mm = {no_range, no_range, no_range};
    std::uint64_t moves = 0;
    std::uint64_t looks = 0;       ///< poses solved for
    std::uint64_t violations = 0;  ///< CL lines, counted once per axis
};

/// Follows the machine through a path. Between two block ends the tip runs on a line and the rotary axes turn linearly,
/// as under TRAORI; the linear axes then take curved ways. How far such a way leaves the straight one between its ends is
/// bounded in closed form (README.md, "Linear travel"), and a part is halved only where that leaves a question open.
///
/// Problems, one for each axis and CL line: `kinematics.linear-limit` (error; not for the way back from a place already
/// reported), `kinematics.linear-singular` (error: a
/// rotary axis has turned the linear ones into one plane).
class LinearTravel {
public:
    /// `machine` must outlive this. Options must pass their check.
    LinearTravel(const Machine& machine, TravelOptions options);

    /// Origin of the workpiece frame in the machine frame, all axes at zero; the machine stands still. Nothing is known of
    /// the tip until a tool is set as well.
    void setOrigin(const Vector3& origin_mm);
    /// Gauge point to tip.
    void setToolLength(double length_mm);

    /// The axes stand here, whatever they did before.
    void standAt(const AxisValues& values);
    /// Rotary axes alone; the linear ones stand still.
    void turnTo(const RotaryValues& rotary_rad);
    /// Where the tip is, in the workpiece frame; absent until origin, tool and position are known.
    [[nodiscard]] std::optional<Vector3> tip() const;
    /// The tip goes straight to `tip_mm` (workpiece frame), the rotary axes turn linearly.
    void moveTo(const Vector3& tip_mm, const RotaryValues& rotary_rad, std::uint32_t cl_line);

    /// No more moves: reports what is still held back.
    void finish();
    [[nodiscard]] const base::Diagnostics& report() const { return report_; }
    [[nodiscard]] const TravelSummary& summary() const { return summary_; }

    /// How far each linear axis may leave the straight line between the positions it has at the two ends of a move, at
    /// equal fractions; infinite where no bound is known and the move must be halved. For tests and for the curious.
    [[nodiscard]] double bulge(const AxisValues& from, const AxisValues& to, double tip_way_mm) const;

private:
    struct Pose {
        Vector3 tip_mm = Vector3::Zero();
        AxisValues values;
    };
    /// The worst of the CL line at hand.
    struct Held {
        std::uint32_t line = 0;
        double start_excess_mm = 0.0;  ///< where the line before ended
        double end_excess_mm = 0.0;    ///< where its last move ended
        double excess_mm = 0.0;
        double position_mm = 0.0;
        bool at_end = false;  ///< the worst of the line is where its last move ended
    };

    void prepareLevers();
    void look(const Pose& from, const Pose& to, std::uint32_t cl_line, int depth);
    [[nodiscard]] bool isOpen(const AxisValues& from, const AxisValues& to, double bulge_mm,
                              std::uint32_t cl_line) const;
    [[nodiscard]] std::optional<Pose> solve(const Vector3& tip_mm, const RotaryValues& rotary_rad,
                                            std::uint32_t cl_line);
    void note(const AxisValues& values, std::uint32_t cl_line, bool at_end);
    void tell(std::size_t axis);
    [[nodiscard]] double inverseNorm(const RotaryValues& rotary_rad) const;

    const Machine& machine_;
    TravelOptions options_;
    std::optional<Vector3> origin_mm_;
    std::optional<double> tool_length_mm_;
    std::optional<AxisValues> at_;
    std::array<Held, 3> held_{};
    std::optional<std::uint32_t> singular_line_;  ///< last reported

    // Constants of the bound. A rotary axis "leads" when it stands before a linear axis in the chain.
    std::array<bool, 2> leads_{};
    bool mixed_ = false;  ///< not all linear axes are led by the same rotary axes
    double directions_norm_ = 1.0;
    double inverse_norm_ = 1.0;
    std::array<double, 2> levers_mm_{};

    base::Diagnostics report_;
    TravelSummary summary_;
};

}  // namespace cusp::kinematics
