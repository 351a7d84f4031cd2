// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A drilling cycle as the 840D's CYCLE call.
#pragma once

#include <cusp/post/writer/nc_program.hpp>

#include <string>

namespace cusp::post {

/// "CYCLE81(10,0,2,,20)": CYCLE81 (drill), 82 (drill with dwell), 83 (deep, or breaking the chip), 84 (rigid tapping),
/// 85 (bore, out at the feed). Parameters in the order of the 840D sl cycles: RTP, RFP, SDIS, DP (left out), DPR, then
/// each cycle's own.
[[nodiscard]] std::string holeCycleCall(const HoleCycle& cycle, int decimals);

}  // namespace cusp::post
