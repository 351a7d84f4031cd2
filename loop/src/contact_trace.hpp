// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Which axis positions made each point of a surface.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/loop/executed_motion.hpp>
#include <cusp/loop/machine_error.hpp>
#include <cusp/loop/virtual_cmm.hpp>

#include <optional>
#include <span>
#include <vector>

namespace cusp::loop {

/// The cut of one surface point: where all axes stood and how fast they went, and where on the tool it was cut.
struct ContactTrace {
    dynamics::AxisVector axes{};
    dynamics::AxisVector rates_per_s{};
    Vector3 in_tool_mm = Vector3::Zero();  ///< tool frame (RealMachine::wcsFromTool)
    Vector3 normal_wcs = Vector3::UnitZ();
    double radius_share = 0.0;  ///< change of the deviation by the tool's radius, ≤ 0
};

/// One for each target, on the machine without errors; empty where the tool does not cut.
[[nodiscard]] base::Result<std::vector<std::optional<ContactTrace>>>
traceContacts(const AxisTrack& track, const CutJob& job, const RealMachine& exact, std::span<const CmmTarget> targets);

/// How the deviation at a contact differs on `real` from that on `exact`, to first order in where the contact is: along the
/// normal, the tool's radius included. In mm.
[[nodiscard]] double contactShift(const ContactTrace& contact, const RealMachine& real, const RealMachine& exact);

}  // namespace cusp::loop
