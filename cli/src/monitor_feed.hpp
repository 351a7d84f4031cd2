// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the monitor page is told, between the thread that runs the control or the transfer and those that serve viewers.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/geometry/frames.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace cusp::cli {

/// One point of the running curves; what does not apply is absent.
struct CurveSample {
    double time_s = 0.0;
    std::optional<double> feed_mm_per_min{};
    std::optional<double> override_percent{};
    std::optional<double> fifo_percent{};
    double link_bytes_per_s = 0.0;
};

/// What a viewer has already.
struct MonitorCursor {
    std::uint64_t sample = 0;  ///< curves: the first one it lacks
    std::uint64_t run = 0;     ///< which track
    std::uint64_t point = 0;   ///< track: the first one it lacks
};

/// {"do": "stop"}, {"do": "override", "value": 50} …
struct MonitorCommand {
    std::string name;
    double value = 0.0;
};

/// Every call is short; the lock is held to copy, never to format or to send.
class MonitorFeed {
public:
    static constexpr std::size_t most_samples = 900;
    static constexpr std::size_t most_points = 20'000;
    static constexpr std::size_t points_at_once = 4'000;

    // The one that runs the control or the transfer:
    /// The present state, complete.
    void tell(const base::Json& now);
    void add(const CurveSample& sample);
    /// The tool is here. Points closer than the picture can show are left out.
    void track(const geometry::Vector3& tip_mm, bool cutting);
    /// A new run: the track begins again.
    void beginTrack();
    /// The programmed path has changed; `make` is called by the first viewer that asks for it, in that viewer's thread.
    void offerPath(std::function<base::Json()> make);
    [[nodiscard]] std::optional<MonitorCommand> takeCommand();
    [[nodiscard]] bool watched() const;

    // Viewers' threads:
    [[nodiscard]] std::string state(const MonitorCursor& seen);
    [[nodiscard]] std::string path();
    /// False when too many wait.
    [[nodiscard]] bool give(MonitorCommand command);
    /// The last `tell` has gone out to somebody since it was told.
    [[nodiscard]] bool lastStateSeen() const;

private:
    struct Path {
        std::mutex making;
        std::function<base::Json()> make;
        std::string text;
    };
    void thin();

    mutable std::mutex mutex_;
    std::string now_ = "null";
    std::uint64_t told_ = 0;
    std::uint64_t seen_ = 0;
    std::optional<std::chrono::steady_clock::time_point> asked_at_;
    std::vector<CurveSample> samples_;
    std::uint64_t first_sample_ = 0;
    std::uint64_t run_ = 1;
    std::vector<float> points_;  ///< x, y, z, cutting
    double spacing_mm_ = 0.05;
    std::optional<geometry::Vector3> last_point_;
    std::shared_ptr<Path> path_;
    std::uint64_t path_version_ = 0;
    std::vector<MonitorCommand> commands_;
};

}  // namespace cusp::cli
