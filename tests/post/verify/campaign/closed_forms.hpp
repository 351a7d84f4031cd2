// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The machines that ship, each in closed form, written down from the build of the machine and not from its chain.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace cusp::post::verify::test {

using Vector3d = Eigen::Vector3d;

/// Where a machine stands: programmed X Y Z (in the frame of the work offset), and its rotary axes, that nearer the
/// workpiece first.
struct AxisValues {
    Vector3d linear_mm = Vector3d::Zero();
    double first_deg = 0.0;
    double second_deg = 0.0;
};

struct ClosedForm {
    std::string machine;  ///< name of the file in machines/
    std::string first;    ///< rotary axis nearer the workpiece
    std::string second;   ///< the one that tilts
    Vector3d (*axis)(double first_deg, double second_deg);
    /// Without TRAORI: the tip in the frame of the work offset, which lies at `origin_mm`.
    Vector3d (*tip)(const AxisValues& at, const Vector3d& origin_mm, double tool_length_mm);
    /// The inverse: what to program for a tip and given rotary axes.
    Vector3d (*programmed)(const Vector3d& tip, const AxisValues& at, const Vector3d& origin_mm, double tool_length_mm);
};

[[nodiscard]] const std::vector<ClosedForm>& fiveAxisMachines();

}  // namespace cusp::post::verify::test
