// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How the tool gets from pose to pose in the form the program has: TRAORI with rotary axes or vectors, all axes of the
// machine, or a tilted plane.
#pragma once

#include "machine_axes.hpp"
#include "tip_lineariser.hpp"

#include <cusp/kinematics/excursion.hpp>
#include <cusp/kinematics/path_refiner.hpp>
#include <cusp/post/writer/nc_program.hpp>
#include <cusp/post/writer/post_options.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace cusp::post {

/// Where the tool is to be, and at which rotary positions, in the workpiece frame.
struct ToolPose {
    geometry::Vector3 tip_mm = geometry::Vector3::Zero();
    geometry::Vector3 axis = geometry::Vector3::UnitZ();
    RotaryValues rotary_rad{};
    std::uint32_t line = 0;
};

class ToolMotion {
public:
    /// All references must outlive this.
    ToolMotion(const MachineFile& file, const kinematics::Machine& machine, const PostOptions& options,
               const std::string& cl_file, NcSink& sink, base::Diagnostics& report);

    [[nodiscard]] ProgramForm form() const { return form_; }
    /// How points are programmed from here on: switches the transformation on, or says what positions of the axes hold for.
    /// `tool` may be null. Without TRAORI its length must be known, and on a rotary table where `work_offset` lies.
    void begin(const ChangeTool* tool, const std::string& work_offset, std::uint32_t line);
    /// The same in a tilted plane, which is a form of its own.
    void beginPlane(const TiltedPlane& plane, std::uint32_t line);
    void end(std::uint32_t line);
    [[nodiscard]] bool inPlane() const { return plane_from_workpiece_.has_value(); }

    /// The first motion with a tool, from home.
    void approach(const ToolPose& to, toolpath::MotionKind kind, const toolpath::FeedRate& feed);
    /// `mendable`: the rotary axes can follow the great circle to here.
    void moveTo(const ToolPose& to, toolpath::MotionKind kind, const toolpath::FeedRate& feed, bool mendable);
    /// A cut that limits force off its way: the tool leaves the part, unwinds, and comes back (`kinematics::Excursion`).
    void unwindTo(const ToolPose& to, const toolpath::FeedRate& feed);
    /// `to` is the end of the arc; answers its length.
    double arcTo(const toolpath::ArcMotion& arc, const ToolPose& to, const toolpath::FeedRate& feed);
    /// The tool got there by a way of its own (a cycle).
    void standAt(const ToolPose& pose);
    [[nodiscard]] const ToolPose& at() const { return at_; }

    /// The frame that points are programmed in while the rotary axes stand there; empty, and reported, where the linear axes
    /// cannot bring the tip anywhere.
    [[nodiscard]] std::optional<Eigen::Affine3d> programmedFrame(const ToolPose& at);

    [[nodiscard]] const kinematics::PathRefiner& refiner() const { return refiner_; }
    [[nodiscard]] const kinematics::ExcursionPlanner& excursions() const { return excursions_; }
    /// Blocks put in so that the tip keeps its line without TRAORI, and the largest error bound met.
    [[nodiscard]] std::size_t linearised() const { return lineariser_.inserted(); }
    [[nodiscard]] double largestChordError() const { return largest_chord_error_mm_; }

private:
    void emitMove(const MachineStop& stop);
    void machineMove(const kinematics::PathPoint& to, bool refined);
    [[nodiscard]] double inverseTime(const MachineStop& stop) const;
    [[nodiscard]] bool inMachineAxes() const { return form_ == ProgramForm::Machine && !inPlane(); }
    void reportSingular(std::uint32_t line);
    void setUpAxes(const ChangeTool* tool, const std::string& work_offset, std::uint32_t line);

    const PostOptions& options_;
    const std::string& cl_file_;
    NcSink& sink_;
    base::Diagnostics& report_;
    const kinematics::Machine& machine_;
    ProgramForm form_;
    kinematics::PathRefiner refiner_;
    kinematics::ExcursionPlanner excursions_;
    MachineAxes machine_axes_;
    TipLineariser lineariser_;
    std::optional<Eigen::Affine3d> plane_from_workpiece_;
    ToolPose at_;
    MachineStop told_;  ///< the last block end
    double largest_chord_error_mm_ = 0.0;
    bool singular_reported_ = false;
    // The move being made.
    toolpath::MotionKind kind_ = toolpath::MotionKind::Rapid;
    toolpath::FeedRate feed_;
    std::uint32_t line_ = 0;
};

}  // namespace cusp::post
