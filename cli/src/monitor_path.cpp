// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Motions with known tips, as points; points that lie on the way between their neighbours are left out.
#include "monitor_path.hpp"

#include <cusp/post/reader/move_sampler.hpp>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>
#include <vector>

namespace cusp::cli {

namespace {

using post::reader::ExecutedMotion;
using post::reader::Vector3;

/// Beyond it a picture is drawn of the beginning only.
constexpr std::size_t most_blocks = 400'000;
constexpr int arc_parts = 24;
constexpr int most_rounds = 20;
constexpr double micrometres_per_mm = 1000.0;

struct PathPoint {
    Vector3 tip_mm;
    std::size_t line = 0;
    bool rapid = false;
};

double distance(const Vector3& a, const Vector3& b) { return std::hypot(b.x - a.x, b.y - a.y, b.z - a.z); }

/// Distance of `p` from the segment a–b.
double offChord(const Vector3& p, const Vector3& a, const Vector3& b) {
    const double length = distance(a, b);
    if (length <= 0.0) return distance(p, a);
    const double along = ((p.x - a.x) * (b.x - a.x) + (p.y - a.y) * (b.y - a.y) + (p.z - a.z) * (b.z - a.z)) / length;
    const double share = std::clamp(along / length, 0.0, 1.0);
    return distance(p, {std::lerp(a.x, b.x, share), std::lerp(a.y, b.y, share), std::lerp(a.z, b.z, share)});
}

class PathSink : public post::reader::ProgramSink {
public:
    explicit PathSink(const post::MachineFile& machine) : chain_(machine.machine) {}

    void motion(const ExecutedMotion& motion) override {
        ++blocks_;
        if (!motion.end_pose) return;
        const bool rapid = motion.code == post::reader::MotionCode::Rapid;
        const int parts = motion.arc && motion.start_pose ? arc_parts : 1;
        for (int i = 1; i < parts; ++i)
            points_.push_back(
                {poseAt(motion, chain_, static_cast<double>(i) / parts).tip_mm, motion.place.line, rapid});
        points_.push_back({motion.end_pose->tip_mm, motion.place.line, rapid});
    }
    void event(const post::reader::BlockPlace& /*place*/, const post::reader::ExecutedEvent& /*event*/) override {}

    [[nodiscard]] bool full() const { return blocks_ >= most_blocks; }
    [[nodiscard]] std::vector<PathPoint>& points() { return points_; }

private:
    post::reader::ForwardChain chain_;
    std::vector<PathPoint> points_;
    std::size_t blocks_ = 0;
};

/// Keeps a point where leaving it out would move the line by more than `tolerance_mm` there.
std::vector<PathPoint> thinned(const std::vector<PathPoint>& all, double tolerance_mm) {
    std::vector<PathPoint> out;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool end = i == 0 || i + 1 == all.size() || all[i].rapid != all[i + 1].rapid;
        if (!end && offChord(all[i].tip_mm, out.back().tip_mm, all[i + 1].tip_mm) < tolerance_mm &&
            distance(out.back().tip_mm, all[i + 1].tip_mm) < 200.0 * tolerance_mm)
            continue;
        out.push_back(all[i]);
    }
    return out;
}

double extentOf(const std::vector<PathPoint>& points) {
    double most = 0.0;
    for (const PathPoint& point : points) most = std::max(most, distance(points.front().tip_mm, point.tip_mm));
    return most;
}

}  // namespace

base::Json programPath(const std::string& text, const std::string& name, const post::MachineFile& machine,
                       const post::reader::MachineSetup& setup, std::size_t most_points) {
    PathSink sink(machine);
    std::istringstream stream(text);
    base::Diagnostics report;
    post::reader::ReaderOptions options;
    options.setup = setup;
    post::reader::ProgramRun run(stream, name, machine, options, sink, report);
    while (!sink.full() && run.step()) continue;
    std::vector<PathPoint> points = std::move(sink.points());
    bool whole = run.ended() && !report.hasErrors();
    if (!points.empty()) {
        double tolerance_mm = std::max(extentOf(points) / 20'000.0, 1e-3);
        for (int i = 0; i < most_rounds && points.size() > most_points; ++i, tolerance_mm *= 2.0)
            points = thinned(points, tolerance_mm);
        if (points.size() > most_points) {
            points.resize(most_points);
            whole = false;
        }
    }
    base::Json out;
    out["points"] = points.size();
    out["whole"] = whole;
    base::Json tips = base::Json::array();
    base::Json lines = base::Json::array();
    base::Json rapids = base::Json::array();
    for (const PathPoint& point : points) {
        for (const double value : {point.tip_mm.x, point.tip_mm.y, point.tip_mm.z})
            tips.push_back(std::round(value * micrometres_per_mm) / micrometres_per_mm);
        lines.push_back(point.line);
        rapids.push_back(point.rapid ? 1 : 0);
    }
    out["tip_mm"] = std::move(tips);
    out["line"] = std::move(lines);
    out["rapid"] = std::move(rapids);
    return out;
}

}  // namespace cusp::cli
