// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The control's buffer followed through the program's time.
#include <cusp/comm/dnc/demand.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cusp::comm {

namespace {

double totalBytes(const DemandProfile& demand) {
    double total = 0.0;
    for (const auto& step : demand.steps) total += step.bytes;
    return total;
}

/// The buffer gains what the link brings in a step before the step takes its bytes: the last byte of a step may come
/// just in time.
std::optional<double> firstStarvation(const DemandProfile& demand, double bytes_per_s, double buffer_bytes) {
    double coming = totalBytes(demand);
    double level = std::min(buffer_bytes, coming);
    coming -= level;
    double now_s = 0.0;
    for (const auto& step : demand.steps) {
        // Room is made as the step runs, so what comes during a step is bounded by the buffer and the step's own bytes.
        const double gained = std::min({bytes_per_s * demand.step_s, coming, buffer_bytes - level + step.bytes});
        coming -= gained;
        level += gained - step.bytes;
        // Sums of many small numbers: a thousandth of a byte is no starvation.
        if (level < -1e-3) return now_s;
        level = std::max(level, 0.0);
        now_s += demand.step_s;
    }
    return std::nullopt;
}

void findPeak(const DemandProfile& demand, RateCheck& check) {
    const auto window = static_cast<std::size_t>(std::max(1.0, std::round(1.0 / demand.step_s)));
    const double window_s = static_cast<double>(window) * demand.step_s;
    double bytes = 0.0;
    double blocks = 0.0;
    for (std::size_t i = 0; i < demand.steps.size(); ++i) {
        bytes += demand.steps[i].bytes;
        blocks += demand.steps[i].blocks;
        if (i >= window) {
            bytes -= demand.steps[i - window].bytes;
            blocks -= demand.steps[i - window].blocks;
        }
        check.peak_blocks_per_s = std::max(check.peak_blocks_per_s, blocks / window_s);
        if (bytes / window_s <= check.peak_bytes_per_s) continue;
        check.peak_bytes_per_s = bytes / window_s;
        check.peak_at_s = static_cast<double>(i + 1 > window ? i + 1 - window : 0) * demand.step_s;
    }
}

double neededRate(const DemandProfile& demand, double buffer_bytes) {
    double most = 0.0;
    for (const auto& step : demand.steps) most = std::max(most, step.bytes / demand.step_s);
    if (!firstStarvation(demand, 0.0, buffer_bytes)) return 0.0;
    double low = 0.0;
    double high = most;
    for (int i = 0; i < 60; ++i) {
        const double middle = (low + high) / 2.0;
        (firstStarvation(demand, middle, buffer_bytes) ? low : high) = middle;
    }
    return high;
}

std::string clock(double seconds) {
    const auto whole = static_cast<std::int64_t>(seconds);
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace

RateCheck checkRate(const DemandProfile& demand, double link_bytes_per_s, double buffer_bytes) {
    RateCheck check;
    check.link_bytes_per_s = link_bytes_per_s;
    check.buffer_bytes = buffer_bytes;
    if (demand.steps.empty()) return check;
    check.mean_bytes_per_s = totalBytes(demand) / (static_cast<double>(demand.steps.size()) * demand.step_s);
    findPeak(demand, check);
    check.starves_at_s = firstStarvation(demand, link_bytes_per_s, buffer_bytes);
    check.needed_bytes_per_s = neededRate(demand, buffer_bytes);
    return check;
}

std::string toText(const RateCheck& check) {
    constexpr double kilo = 1000.0;
    std::string out = fmt::format(
        "the link brings {:.2f} kB/s; the program needs {:.2f} kB/s in the mean and up to {:.2f} kB/s ({:.0f} blocks/s) at {}",
        check.link_bytes_per_s / kilo, check.mean_bytes_per_s / kilo, check.peak_bytes_per_s / kilo,
        check.peak_blocks_per_s, clock(check.peak_at_s));
    if (check.starves_at_s)
        out += fmt::format("; with {:.1f} kB buffered it starves at {}, and would need a link of {:.2f} kB/s",
                           check.buffer_bytes / kilo, clock(*check.starves_at_s), check.needed_bytes_per_s / kilo);
    return out;
}

}  // namespace cusp::comm
