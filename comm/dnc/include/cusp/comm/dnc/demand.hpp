// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a program needs of a link while it runs, received as data, and whether a measured link gives it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::comm {

/// Bytes and blocks the program consumes in equal steps of time, from its start.
struct DemandProfile {
    struct Step {
        double bytes = 0.0;
        double blocks = 0.0;
    };
    double step_s = 0.1;
    std::vector<Step> steps;
};

struct RateCheck {
    double link_bytes_per_s = 0.0;
    double mean_bytes_per_s = 0.0;
    double peak_bytes_per_s = 0.0;   ///< over one second
    double peak_blocks_per_s = 0.0;  ///< over one second
    double peak_at_s = 0.0;          ///< where that second begins, in the program's own time
    double buffer_bytes = 0.0;
    /// When the control's buffer, full at the start and fed at the link's rate, first runs empty.
    std::optional<double> starves_at_s;
    /// The slowest link, with this buffer, on which it does not.
    double needed_bytes_per_s = 0.0;
};

/// `buffer_bytes`: what the control holds of the program before it starts.
[[nodiscard]] RateCheck checkRate(const DemandProfile& demand, double link_bytes_per_s, double buffer_bytes);

/// "the link brings 7.9 kB/s; the program needs 3.1 kB/s in the mean and up to 12.4 kB/s (240 blocks/s) at 0:12 …"
[[nodiscard]] std::string toText(const RateCheck& check);

}  // namespace cusp::comm
