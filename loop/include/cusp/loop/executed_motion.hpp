// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the axes did, and what the tool of a machine with errors really did with it.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/loop/machine_error.hpp>
#include <cusp/simulation/tool_move.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace cusp::loop {

/// Samples of all axes over time, as the control commanded them.
struct AxisTrack {
    std::vector<double> time_s;
    std::vector<dynamics::AxisVector> axes;

    void add(double at_s, const dynamics::AxisVector& place) {
        time_s.push_back(at_s);
        axes.push_back(place);
    }
    [[nodiscard]] std::size_t size() const { return axes.size(); }
};

/// A CL file as a cut: one cutter, one frame.
struct CutJob {
    simulation::CutterPath path;        ///< in the frame of the part
    std::vector<double> feed_mm_per_s;  ///< of each move; rapid moves have infinity
    geometry::RigidTransform part_from_wcs = geometry::RigidTransform::Identity();

    [[nodiscard]] const geometry::Cutter& cutter() const { return path.cutters.front(); }
};

/// Errors: those of the records (`simulation.no-cutter`), `cut.cutters` (more than one cutter shape: what a part measures is
/// then not one tool's doing), `cut.frames` (more than one programming frame), `cut.no-feed`, `simulation.no-moves`.
[[nodiscard]] base::Result<CutJob> cutJob(const toolpath::ToolPath& path);

/// The track a machine without dynamics would follow: every move with its tip on the line and its rotary axes linear (what
/// TRAORI does), at its feed. Errors: `cut.not-reached`, with the CL line.
[[nodiscard]] base::Result<AxisTrack> idealTrack(const CutJob& job, const kinematics::Machine& machine,
                                                 const CuttingSetup& setup);

/// Reads what `cusp controller --record` writes. Errors: `track.header` (names the columns it needs), `track.number`,
/// `track.columns`, `track.empty`, each with its line.
[[nodiscard]] base::Result<AxisTrack> readTrack(std::istream& in, const std::string& name,
                                                const kinematics::Machine& machine);

/// What the axes did with their servo lag: a first-order lag per axis, exact for a command that runs straight between samples.
[[nodiscard]] AxisTrack lagged(const AxisTrack& track, const dynamics::AxisVector& lag_s);

/// The samples of the track a move of a real path goes from and to.
struct SampleSpan {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
};

/// The tool's real motion in the frame of the part. Samples between which the tool runs straight within `tolerance_mm` (at
/// the tip and 100 mm up the axis) become one move; `spans`, when given, gets the samples of each.
[[nodiscard]] simulation::CutterPath realPath(const AxisTrack& track, const RealMachine& machine,
                                              const geometry::Cutter& cutter,
                                              const geometry::RigidTransform& part_from_wcs, double tolerance_mm = 1e-4,
                                              std::vector<SampleSpan>* spans = nullptr);

}  // namespace cusp::loop
