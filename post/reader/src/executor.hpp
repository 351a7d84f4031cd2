// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The machine's state, and what each block does to it.
#pragma once

#include "arc.hpp"
#include "block_content.hpp"
#include "frame.hpp"

#include <cusp/post/reader/executed_program.hpp>
#include <cusp/post/reader/program_reader.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace cusp::post::reader {

class Executor {
public:
    Executor(const MachineFile& machine, const ForwardChain& chain, const MachineSetup& setup, ProgramSink& sink,
             base::Diagnostics& report);

    void run(const Block& block, const BlockContent& content, bool in_subprogram);

    [[nodiscard]] bool ended() const { return ended_; }
    /// The block that ran last ends the subprogram it stands in.
    [[nodiscard]] bool returned() const { return returned_; }
    [[nodiscard]] std::size_t motions() const { return motions_; }

private:
    void applyCodes(const BlockContent& content);
    void applySmoothing(const BlockContent& content);
    void applyFeedAndSpeed(const BlockContent& content);
    void applyTool(const BlockContent& content);
    void applyTransformation(bool on);
    void applyEarlyFunctions(const BlockContent& content);
    void applyLateFunctions(const BlockContent& content);
    void dwell(const BlockContent& content);
    void move(const BlockContent& content);
    [[nodiscard]] bool checkMotion(const BlockContent& content, bool is_arc, bool moves);
    [[nodiscard]] bool applyTargets(const BlockContent& content, ExecutedMotion& motion);
    [[nodiscard]] std::optional<double> reach(const AxisTarget& target, const std::optional<double>& now, double scale,
                                              std::string_view axis, bool endless);
    [[nodiscard]] bool applyVector(const BlockContent& content);
    [[nodiscard]] bool isIncremental(const AxisTarget& target) const;
    void placePath(ExecutedMotion& motion) const;
    void place();
    void hand(ExecutedMotion& motion, const ModalSnapshot& state);
    void programFrame(const BlockContent& content);
    void changeFrames(const Frame& swivel, const Frame& programmed);
    void swivel(const Swivel& swivel);
    [[nodiscard]] bool checkCompensation(const ExecutedMotion& motion);
    void warnOfTurnedFrame(const ExecutedMotion& motion);
    void runCycle(const CycleCall& cycle);
    void runCycleStep(const CycleStep& step, std::size_t axis, ModalSnapshot& state);
    [[nodiscard]] Frame frame() const { return swivel_frame_ * programmed_frame_; }
    /// Where programmed coordinates, all known, lie in the frame of the work offset.
    [[nodiscard]] Vector3 basePoint(const AxisPositions& position) const;
    [[nodiscard]] bool endArcByAngle(const BlockContent& content);
    [[nodiscard]] std::optional<Vector3> programmedAxis(const BlockContent& content);
    [[nodiscard]] ArcRequest arcRequest(const ExecutedMotion& motion) const;
    [[nodiscard]] bool addArc(const BlockContent& content, ExecutedMotion& motion);
    void requireRotary();
    [[nodiscard]] std::optional<ToolPose> pose(const AxisPositions& position) const;
    [[nodiscard]] std::optional<Vector3> axisFromRotary(const AxisPositions& position) const;
    [[nodiscard]] bool rotaryAtZero(const AxisPositions& position) const;
    [[nodiscard]] OrientationPath orientationPath() const;
    [[nodiscard]] MotionCode motionCode() const;
    [[nodiscard]] bool isActive(int group, std::string_view code) const;
    [[nodiscard]] double mmPerUnit() const;
    void forgetLinear();
    void error(std::string_view code, std::string message);

    const MachineFile& machine_;
    const ForwardChain& chain_;
    const MachineSetup& setup_;
    ProgramSink& sink_;
    base::Diagnostics& report_;
    const Block* block_ = nullptr;
    BlockPlace place_;

    std::array<std::string_view, group::count> active_{};
    ModalSnapshot state_;
    Placement placement_;
    AxisPositions position_;
    std::optional<Vector3> tool_axis_;  ///< known from rotary values or as programmed
    std::string preselected_tool_;
    Frame swivel_frame_;      ///< CYCLE800
    Frame programmed_frame_;  ///< TRANS, ROT and what adds to them
    bool swivelled_ = false;  ///< CYCLE800 has set the tool along its plane's normal, and no rotary axis moved since
    std::array<bool, 3> frame_changed_{};  ///< not programmed since
    std::optional<CycleCall> modal_cycle_;
    bool turned_frame_reported_ = false;
    bool transformation_ = false;
    bool feed_missing_reported_ = false;
    bool rotary_missing_reported_ = false;
    bool in_subprogram_ = false;
    bool ended_ = false;
    bool returned_ = false;
    std::size_t motions_ = 0;
};

}  // namespace cusp::post::reader
