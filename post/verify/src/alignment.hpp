// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Finds, for each motion of a program, the CL point it belongs to, in order and without a map from the writer.
#pragma once

#include "between_ends.hpp"
#include "expected_path.hpp"
#include "findings.hpp"
#include "process_check.hpp"

#include <optional>

namespace cusp::post::verify {

/// The next CL point not yet met is k. A block end within tolerance of k meets it; one on the move from k−1 to k is on the
/// way; a rapid outside an operation is a link. Otherwise a later point within reach is looked for (the ones before it were
/// dropped), and failing that the block is held back until the next one shows whether it was point k displaced, or one
/// block too many.
class Alignment : public reader::ProgramSink {
public:
    Alignment(const MachineFile& machine, const ExpectedPath* expected, const VerifyOptions& options,
              const std::string& program_name, VerifyReport& report);

    void motion(const reader::ExecutedMotion& motion) override;
    void event(const reader::BlockPlace& place, const reader::ExecutedEvent& event) override;
    /// After the last block: what is still open.
    void finish();

private:
    /// A block end that met nothing.
    struct Held {
        reader::BlockPlace place;
        reader::ToolPose pose;
        bool rapid = false;
    };

    /// The tool is off the part to unwind rotary axes.
    struct Excursion {
        reader::BlockPlace place;
        reader::ToolPose from;
        reader::Vector3 off_mm;
        bool turned = false;
    };

    /// On the way to the bottom of a hole.
    struct HoleProgress {
        double drilled_mm = 0.0;        ///< below the location
        std::optional<double> peck_mm;  ///< the last
        bool out = true;                ///< of the hole, since the last peck
    };

    void checkLimits(const reader::ExecutedMotion& motion);
    void checkReach(const reader::ExecutedMotion& motion);
    void checkTravel(const reader::ExecutedMotion& motion);
    void checkSuppressed(const reader::ExecutedMotion& motion);
    bool checkPositions(const reader::ExecutedMotion& motion, const std::array<std::optional<double>, 3>& at_mm);
    void compare(const reader::ExecutedMotion& motion);
    void withoutPose(const reader::ExecutedMotion& motion);
    [[nodiscard]] bool meetsNext(const reader::ExecutedMotion& motion);
    [[nodiscard]] bool onTheWay(const reader::ExecutedMotion& motion);
    [[nodiscard]] std::optional<double> besideTheWay(const reader::ExecutedMotion& motion) const;
    [[nodiscard]] bool leavesOut(const reader::ExecutedMotion& motion);
    [[nodiscard]] bool meetsLater(const reader::ExecutedMotion& motion);
    [[nodiscard]] bool beginsExcursion(const reader::ExecutedMotion& motion);
    [[nodiscard]] bool continuesExcursion(const reader::ExecutedMotion& motion);
    [[nodiscard]] bool restsAt(const reader::ExecutedMotion& motion, const reader::Vector3& tip_mm) const;
    void abandonExcursion();
    void checkOffThePart(const reader::ExecutedMotion& motion);
    void meet(const reader::ExecutedMotion& motion, std::size_t index);
    bool passPointAlreadyMet();
    void passPointsAlreadyMet();
    void link();
    void extra(const Held& held);
    void displaced(const Held& held);
    void drop(std::size_t until);
    void checkKind(const reader::ExecutedMotion& motion, const ExpectedPoint& point);
    void checkBetween(const reader::ExecutedMotion& motion, double to);
    void checkTurns(const reader::ExecutedMotion& motion, std::size_t cl_line);
    [[nodiscard]] bool done() const { return next_ >= expected_->points.size(); }
    [[nodiscard]] bool atOpening() const { return done() || expected_->points[next_].opens; }
    [[nodiscard]] ExpectedMove nextMove() const;
    [[nodiscard]] const ExpectedCycle* nextHole() const;
    void inHole(const reader::ExecutedMotion& motion, const ExpectedCycle& cycle, double fraction);
    void checkDwell(const reader::ExecutedMotion& motion, const ExpectedPoint& point);

    const reader::ForwardChain chain_;
    const ExpectedPath* expected_;
    const VerifyOptions& options_;
    const Tolerance tolerance_;
    ProcessLimits process_limits_;
    VerifyReport& report_;
    Findings findings_;

    std::size_t next_ = 0;
    std::optional<reader::ToolPose>
        skipped_from_;       ///< the point before was optional and left out: the path comes from here
    double fraction_ = 0.0;  ///< how far the path has come from point next_−1 to next_
    HoleProgress hole_;
    std::optional<double> dwelt_s_;       ///< since the last motion
    std::optional<reader::ToolPose> at_;  ///< where the path stands: the last block end on it
    std::optional<Held> held_;
    std::optional<Excursion> excursion_;
};

}  // namespace cusp::post::verify
