// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The moves of a CL path with the cutter that makes them: what every simulation runs on.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/geometry/cutter.hpp>
#include <cusp/geometry/frames.hpp>
#include <cusp/toolpath/cl_record.hpp>
#include <cusp/toolpath/tool_library.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace cusp::simulation {

/// One straight move in the frame of the part: the tip on a line, the tool axis on the great circle (what a CL file means).
struct ToolMove {
    toolpath::CutterLocation from;
    toolpath::CutterLocation to;
    toolpath::MotionKind kind = toolpath::MotionKind::Feed;
    std::uint32_t line = 0;    ///< of the CL file
    std::uint32_t cutter = 0;  ///< index into CutterPath::cutters
};

struct CutterPath {
    std::vector<ToolMove> moves;
    std::vector<geometry::Cutter> cutters;
    std::size_t locations = 0;  ///< GOTO, holes and ends of arcs
    /// As `cutters`: the library's tool where a cutter is one's, else null. Empty where a path is not read from a file.
    std::vector<const toolpath::Tool*> tools = {};
};

/// Takes the records of a CL file one by one. Arcs become chords within `chord_tolerance_mm`; a hole is a move to its depth
/// and back. Points are brought into the part by the programming frame that holds.
class PathCollector {
public:
    /// `report` gets `simulation.no-cutter` where the tool moves and the file has not said its shape: those moves are left
    /// out. It must outlive the collector.
    PathCollector(std::string file, double chord_tolerance_mm, base::Diagnostics& report);
    /// Tools the library has by number or name are taken from there, whatever shape the file tells. It must outlive the path.
    void lookUpIn(const toolpath::ToolLibrary& library) { library_ = &library; }
    /// Every tool of the file is this one. It must outlive the path.
    void useTool(const toolpath::Tool& tool) { tool_ = &tool; }
    void take(const toolpath::ClRecord& record);
    [[nodiscard]] CutterPath finish() { return std::move(path_); }

private:
    void moveTo(const toolpath::CutterLocation& location, toolpath::MotionKind kind, std::uint32_t line);
    void turn(const toolpath::ArcMotion& arc, std::uint32_t line);
    void drill(const toolpath::CutterLocation& location, std::uint32_t line);
    void call(const toolpath::ToolCall& tool);
    [[nodiscard]] toolpath::CutterLocation inPart(const toolpath::CutterLocation& location) const;

    std::string file_;
    double chord_tolerance_mm_;
    base::Diagnostics& report_;
    const toolpath::ToolLibrary* library_ = nullptr;
    const toolpath::Tool* tool_ = nullptr;
    CutterPath path_;
    geometry::RigidTransform part_from_programming_ = geometry::RigidTransform::Identity();
    toolpath::CutterLocation at_;  ///< in the programming frame
    bool placed_ = false;          ///< the first location only places the tool
    bool shaped_ = false;          ///< the shape of the tool is known
    bool told_ = false;            ///< that it is not
    toolpath::CycleStart cycle_;
};

}  // namespace cusp::simulation
