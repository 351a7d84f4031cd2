// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A flat path at all its levels: moves in space, their time on a machine, and the CL file.
#pragma once

#include <cusp/optimizer/pocket/flat_path.hpp>
#include <cusp/optimizer/pocket/pocket_job.hpp>

#include <cusp/kinematics/machine.hpp>
#include <cusp/toolpath/cl_reader.hpp>

#include <vector>

namespace cusp::pocket {

struct PocketMove {
    geometry::Vector3 tip_mm = geometry::Vector3::Zero();
    double feed_mm_per_s = 0.0;
    bool rapid = false;
};

/// Heights of the floors of the levels, from the top down; all alike, none deeper than `ap_mm`.
[[nodiscard]] std::vector<double> levelsOf(const DepthJob& depth, double ap_mm);

/// The moves of every level. Feed of steps over the engagement limit and of helices is halved.
[[nodiscard]] std::vector<PocketMove> movesOf(const FlatPath& path, const PocketJob& job, const CuttingData& data);

/// Within the limits of the machine's axes (look-ahead, corners rounded within the job's tolerance).
/// Error `pocket.pose`: the machine cannot put the tip there.
[[nodiscard]] base::Result<double> machineTime(const std::vector<PocketMove>& moves, const kinematics::Machine& machine,
                                               const PocketJob& job);
/// Way over feed.
[[nodiscard]] double distanceTime(const std::vector<PocketMove>& moves, double rapid_mm_per_s);

[[nodiscard]] toolpath::ToolPath clFile(const std::vector<PocketMove>& moves, const PocketJob& job,
                                        const CuttingData& data, const std::string& remark);

}  // namespace cusp::pocket
