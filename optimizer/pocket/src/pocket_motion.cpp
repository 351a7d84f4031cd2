// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Levels, entries, time and CL records.
#include <cusp/dynamics/motion_planner.hpp>
#include <cusp/dynamics/tool_path.hpp>
#include <cusp/optimizer/pocket/pocket_motion.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cusp::pocket {

std::vector<double> levelsOf(const DepthJob& depth, double ap_mm) {
    const double whole = depth.top_mm - depth.floor_mm;
    const auto count = std::max(1, static_cast<int>(std::ceil(whole / ap_mm - 1e-9)));
    std::vector<double> out;
    for (int i = 1; i <= count; ++i) out.push_back(depth.top_mm - whole * i / count);
    return out;
}

namespace {

class Mover {
public:
    Mover(const PocketJob& job, const CuttingData& data)
        : job_(job),
          feed_mm_per_s_(loadOf(data, job.limits(), 1.0).feed_mm_per_min / 60.0),
          clearance_mm_(job.depth.top_mm + job.depth.clearance_mm) {}

    void level(const FlatPath& path, double above_mm, double z_mm) {
        above_mm_ = above_mm;
        z_mm_ = z_mm;
        lowered_ = false;
        Point at = path.start;
        for (const FlatStep& step : path.steps) {
            if (step.kind == StepKind::Helix) {
                helix(step);
            } else if (step.kind == StepKind::Rapid) {
                lower(step.to);
            } else {
                if (!lowered_) lower(at);
                feed({step.to.x_mm, step.to.y_mm, z_mm_}, step.over_limit ? 0.5 : 1.0);
            }
            at = step.to;
        }
        lift();
    }

    std::vector<PocketMove> take() { return std::move(moves_); }

private:
    void rapid(const geometry::Vector3& to) { moves_.push_back({to, 0.0, true}); }
    /// Moves below a micrometre, which points that nearly coincide would make, are left out.
    void feed(const geometry::Vector3& to, double share) {
        if (!moves_.empty() && (to - moves_.back().tip_mm).norm() < 1e-3) return;
        moves_.push_back({to, share * feed_mm_per_s_, false});
    }
    void lift() {
        if (moves_.empty()) return;
        const geometry::Vector3& at = moves_.back().tip_mm;
        if (at.z() < clearance_mm_) rapid({at.x(), at.y(), clearance_mm_});
        lowered_ = false;
    }
    /// Over everything to p, down in the air to the approach height, and at the feed to the level.
    void lower(const Point& p) {
        lift();
        rapid({p.x_mm, p.y_mm, clearance_mm_});
        rapid({p.x_mm, p.y_mm, z_mm_ + job_.depth.approach_mm});
        feed({p.x_mm, p.y_mm, z_mm_}, 1.0);
        lowered_ = true;
    }
    void helix(const FlatStep& step) {
        constexpr int parts = 36;
        lift();
        const auto on = [&](double angle, double z) {
            return geometry::Vector3(step.to.x_mm + step.helix_radius_mm * std::cos(angle),
                                     step.to.y_mm + step.helix_radius_mm * std::sin(angle), z);
        };
        const double start_mm = above_mm_ + job_.depth.approach_mm;
        rapid(on(0.0, clearance_mm_));
        rapid(on(0.0, start_mm));
        const double per_turn_mm = 2.0 * std::numbers::pi * step.helix_radius_mm * std::tan(job_.depth.ramp_rad);
        const double turns = std::max(1.0, std::ceil((start_mm - z_mm_) / per_turn_mm));
        const auto steps = static_cast<int>(turns) * parts;
        for (int i = 1; i <= steps + parts; ++i) {  // and once round at the level
            const double angle = 2.0 * std::numbers::pi * i / parts;
            feed(on(angle, std::max(z_mm_, start_mm - (start_mm - z_mm_) * i / steps)), 0.5);
        }
        feed({step.to.x_mm, step.to.y_mm, z_mm_}, 0.5);
        lowered_ = true;
    }

    const PocketJob& job_;
    double feed_mm_per_s_;
    double clearance_mm_;
    double above_mm_ = 0.0;
    double z_mm_ = 0.0;
    bool lowered_ = false;
    std::vector<PocketMove> moves_;
};

}  // namespace

std::vector<PocketMove> movesOf(const FlatPath& path, const PocketJob& job, const CuttingData& data) {
    Mover mover(job, data);
    double above = job.depth.top_mm;
    for (const double z : levelsOf(job.depth, data.ap_mm)) {
        mover.level(path, above, z);
        above = z;
    }
    return mover.take();
}

base::Result<double> machineTime(const std::vector<PocketMove>& moves, const kinematics::Machine& machine,
                                 const PocketJob& job) {
    const geometry::Vector3 origin(job.machine.origin_mm[0], job.machine.origin_mm[1], job.machine.origin_mm[2]);
    const dynamics::ToolPath path(machine, job.tool.overhang_mm, origin);
    dynamics::MotionPlanner planner(dynamics::limitsOf(machine), {},
                                    [&](const dynamics::AxisVector& at) { return path.placeOf(at); });
    double total = 0.0;
    const auto run = [&] {
        while (planner.ready())
            for (const auto& piece : planner.plan().committed) total += piece.law.duration_s;
    };
    for (std::size_t i = 1; i < moves.size(); ++i) {
        if ((moves[i].tip_mm - moves[i - 1].tip_mm).norm() < 1e-9) continue;
        auto block = path.line({moves[i - 1].tip_mm, {}}, {moves[i].tip_mm, {}});
        if (!block) return base::fail("pocket.pose", "no position of the linear axes puts the tool tip there");
        block->feed_mm_per_s = moves[i].rapid ? std::numeric_limits<double>::infinity() : moves[i].feed_mm_per_s;
        block->tolerance_mm = job.machine.tolerance_mm;
        planner.add(*block);
        run();
    }
    planner.stop();
    run();
    return total;
}

double distanceTime(const std::vector<PocketMove>& moves, double rapid_mm_per_s) {
    double total = 0.0;
    for (std::size_t i = 1; i < moves.size(); ++i)
        total +=
            (moves[i].tip_mm - moves[i - 1].tip_mm).norm() / (moves[i].rapid ? rapid_mm_per_s : moves[i].feed_mm_per_s);
    return total;
}

toolpath::ToolPath clFile(const std::vector<PocketMove>& moves, const PocketJob& job, const CuttingData& data,
                          const std::string& remark) {
    toolpath::ToolPath out;
    out.dialect = toolpath::Dialect::Apt;
    const auto put = [&](toolpath::ClStatement statement) { out.records.push_back({std::move(statement), 0}); };
    if (!job.name.empty()) put(toolpath::Remark{toolpath::Remark::Kind::PartName, job.name});
    put(toolpath::Remark{toolpath::Remark::Kind::Message, remark});
    put(toolpath::ToolCall{job.tool.number, job.tool.name,
                           geometry::Cutter{.diameter_mm = job.tool.diameter_mm,
                                            .corner_radius_mm = 0.0,
                                            .corner_e_mm = job.tool.diameter_mm / 2.0,
                                            .corner_f_mm = 0.0,
                                            .point_angle_rad = 0.0,
                                            .taper_angle_rad = 0.0,
                                            .cutting_height_mm = job.tool.cutting_height_mm}});
    put(toolpath::SpindleCommand{toolpath::SpindleCommand::Turn::Clockwise, std::floor(data.spindle_rpm),
                                 toolpath::SpindleCommand::Unit::Rpm});
    put(toolpath::CoolantCommand{toolpath::CoolantCommand::Kind::Flood});
    double feed = 0.0;
    for (const PocketMove& move : moves) {
        if (!move.rapid && move.feed_mm_per_s != feed) {
            feed = move.feed_mm_per_s;
            put(toolpath::FeedRate{feed, toolpath::FeedRate::Unit::MmPerS});
        }
        put(toolpath::LinearMotion{{move.tip_mm, geometry::Vector3::UnitZ()},
                                   move.rapid ? toolpath::MotionKind::Rapid : toolpath::MotionKind::Feed});
    }
    put(toolpath::CoolantCommand{toolpath::CoolantCommand::Kind::Off});
    put(toolpath::SpindleCommand{});
    put(toolpath::ProgramEnd{});
    return out;
}

}  // namespace cusp::pocket
