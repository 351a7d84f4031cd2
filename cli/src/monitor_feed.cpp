// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rings of curves and track, and their pieces as JSON.
#include "monitor_feed.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <iterator>

namespace cusp::cli {

namespace {

constexpr std::size_t per_point = 4;
constexpr std::size_t most_commands = 16;
/// Who asked within so long is watching.
constexpr auto watched_for = std::chrono::seconds(3);

template <class Value>
std::string listOf(const std::vector<CurveSample>& samples, int places, const Value& value) {
    std::string out = "[";
    for (const CurveSample& sample : samples) {
        const std::optional<double> number = value(sample);
        if (out.size() > 1) out += ',';
        out += number && std::isfinite(*number) ? fmt::format("{:.{}f}", *number, places) : "null";
    }
    return out + "]";
}

std::string curvesText(std::uint64_t from, const std::vector<CurveSample>& samples) {
    return fmt::format(
        R"({{"from":{},"time_s":{},"feed_mm_per_min":{},"override_percent":{},"fifo_percent":{},"link_bytes_per_s":{}}})",
        from, listOf(samples, 2, [](const CurveSample& s) { return std::optional(s.time_s); }),
        listOf(samples, 1, [](const CurveSample& s) { return s.feed_mm_per_min; }),
        listOf(samples, 0, [](const CurveSample& s) { return s.override_percent; }),
        listOf(samples, 1, [](const CurveSample& s) { return s.fifo_percent; }),
        listOf(samples, 0, [](const CurveSample& s) { return std::optional(s.link_bytes_per_s); }));
}

std::string trackText(std::uint64_t run, std::uint64_t from, std::uint64_t count, const std::vector<float>& points) {
    std::string tips;
    std::string cutting;
    for (std::size_t i = 0; i + per_point <= points.size(); i += per_point) {
        if (i > 0) {
            tips += ',';
            cutting += ',';
        }
        tips += fmt::format("{:.3f},{:.3f},{:.3f}", points[i], points[i + 1], points[i + 2]);
        cutting += points[i + 3] > 0.0F ? '1' : '0';
    }
    return fmt::format(R"({{"run":{},"from":{},"count":{},"tip_mm":[{}],"cutting":[{}]}})", run, from, count, tips,
                       cutting);
}

}  // namespace

void MonitorFeed::tell(const base::Json& now) {
    std::string text = now.dump(-1, ' ', false, base::Json::error_handler_t::replace);
    const std::lock_guard lock(mutex_);
    now_ = std::move(text);
    ++told_;
}

void MonitorFeed::add(const CurveSample& sample) {
    const std::lock_guard lock(mutex_);
    samples_.push_back(sample);
    if (samples_.size() <= most_samples) return;
    samples_.erase(samples_.begin());
    ++first_sample_;
}

void MonitorFeed::beginTrack() {
    const std::lock_guard lock(mutex_);
    ++run_;
    points_.clear();
    spacing_mm_ = 0.05;
    last_point_.reset();
}

void MonitorFeed::track(const geometry::Vector3& tip_mm, bool cutting) {
    if (!tip_mm.allFinite()) return;
    const std::lock_guard lock(mutex_);
    if (last_point_ && (tip_mm - *last_point_).norm() < spacing_mm_) return;
    last_point_ = tip_mm;
    for (Eigen::Index i = 0; i < 3; ++i) points_.push_back(static_cast<float>(tip_mm[i]));
    points_.push_back(cutting ? 1.0F : 0.0F);
    if (points_.size() > most_points * per_point) thin();
}

/// Every second point stays, and from now on they come half as close. Viewers begin again.
void MonitorFeed::thin() {
    std::vector<float> kept;
    for (std::size_t i = 0; i + per_point <= points_.size(); i += 2 * per_point)
        std::copy_n(points_.begin() + static_cast<std::ptrdiff_t>(i), per_point, std::back_inserter(kept));
    points_ = std::move(kept);
    spacing_mm_ *= 2.0;
    ++run_;
}

void MonitorFeed::offerPath(std::function<base::Json()> make) {
    auto path = std::make_shared<Path>();
    path->make = std::move(make);
    const std::lock_guard lock(mutex_);
    path_ = std::move(path);
    ++path_version_;
}

std::string MonitorFeed::state(const MonitorCursor& seen) {
    std::string now;
    std::vector<CurveSample> samples;
    std::vector<float> points;
    std::uint64_t sample = 0;
    std::uint64_t run = 0;
    std::uint64_t point = 0;
    std::uint64_t count = 0;
    std::uint64_t version = 0;
    {
        const std::lock_guard lock(mutex_);
        now = now_;
        seen_ = told_;
        asked_at_ = std::chrono::steady_clock::now();
        version = path_version_;
        sample = std::clamp<std::uint64_t>(seen.sample, first_sample_, first_sample_ + samples_.size());
        samples.assign(samples_.begin() + static_cast<std::ptrdiff_t>(sample - first_sample_), samples_.end());
        run = run_;
        count = points_.size() / per_point;
        point = seen.run == run ? std::min(seen.point, count) : 0;
        const std::uint64_t end = std::min<std::uint64_t>(count, point + points_at_once);
        points.assign(points_.begin() + static_cast<std::ptrdiff_t>(point * per_point),
                      points_.begin() + static_cast<std::ptrdiff_t>(end * per_point));
    }
    return fmt::format(R"({{"now":{},"curves":{},"track":{},"path":{}}})", now, curvesText(sample, samples),
                       trackText(run, point, count, points), version);
}

std::string MonitorFeed::path() {
    std::shared_ptr<Path> path;
    std::uint64_t version = 0;
    {
        const std::lock_guard lock(mutex_);
        path = path_;
        version = path_version_;
    }
    if (!path) return R"({"version":0})";
    const std::lock_guard lock(path->making);
    if (path->make) {
        base::Json made = path->make();
        made["version"] = version;
        path->text = made.dump(-1, ' ', false, base::Json::error_handler_t::replace);
        path->make = nullptr;
    }
    return path->text;
}

bool MonitorFeed::give(MonitorCommand command) {
    const std::lock_guard lock(mutex_);
    if (commands_.size() >= most_commands) return false;
    commands_.push_back(std::move(command));
    return true;
}

std::optional<MonitorCommand> MonitorFeed::takeCommand() {
    const std::lock_guard lock(mutex_);
    if (commands_.empty()) return std::nullopt;
    MonitorCommand first = std::move(commands_.front());
    commands_.erase(commands_.begin());
    return first;
}

bool MonitorFeed::watched() const {
    const std::lock_guard lock(mutex_);
    return asked_at_ && std::chrono::steady_clock::now() - *asked_at_ < watched_for;
}

bool MonitorFeed::lastStateSeen() const {
    const std::lock_guard lock(mutex_);
    return seen_ == told_;
}

}  // namespace cusp::cli
