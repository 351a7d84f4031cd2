// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Random programs, samples and their differences.
#include "planned_motion.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::dynamics::test {

ToolModel toolModel(const kinematics::Machine& machine) {
    return [&machine](const AxisVector& axes) {
        const toolpath::CutterLocation at = machine.forward(axisValues(axes), tool_length_mm);
        return ToolPlace{at.tip_mm, at.axis};
    };
}

PathPoint pointAt(const kinematics::Machine& machine, const geometry::Vector3& tip_mm,
                  const kinematics::RotaryValues& rotary_rad) {
    const kinematics::AxisValues values{*machine.solveLinear(tip_mm, rotary_rad, tool_length_mm), rotary_rad};
    return {axisVector(values), {tip_mm, machine.toolAxis(rotary_rad)}};
}

std::vector<PathBlock> blocksOf(const RandomProgram& program, const kinematics::Machine& machine) {
    base::Random random(program.seed);
    std::vector<PathBlock> out;
    double heading = 0.0;
    geometry::Vector3 tip(0.0, 0.0, 0.0);
    kinematics::RotaryValues rotary{0.3, 0.4};
    rotary[1] = machine.rotaryCount() > 1 ? rotary[1] : 0.0;
    for (std::size_t i = 0; i < program.blocks; ++i) {
        heading += random.uniform(-program.turn_rad, program.turn_rad);
        const geometry::Vector3 next =
            tip + program.block_mm * geometry::Vector3(std::cos(heading), std::sin(heading), random.uniform(-0.1, 0.1));
        kinematics::RotaryValues turned = rotary;
        for (std::size_t k = 0; k < machine.rotaryCount(); ++k)
            turned[k] = std::clamp(rotary[k] + random.uniform(-program.rotary_rad, program.rotary_rad), 0.2, 0.6);
        PathBlock block;
        block.id = i + 1;
        block.feed_mm_per_s = program.feed_mm_per_s;
        block.tolerance_mm = program.tolerance_mm;
        block.orientation_tolerance_rad = program.orientation_tolerance_rad;
        const int parts = std::max(1, static_cast<int>(std::ceil(program.rotary_rad / 0.002)));
        for (int k = 0; k <= parts; ++k) {
            const double u = static_cast<double>(k) / parts;
            block.points.push_back(
                pointAt(machine, (1.0 - u) * tip + u * next,
                        {(1.0 - u) * rotary[0] + u * turned[0], (1.0 - u) * rotary[1] + u * turned[1]}));
        }
        out.push_back(std::move(block));
        tip = next;
        rotary = turned;
    }
    return out;
}

std::vector<MotionPiece> planAll(MotionPlanner& planner, const std::vector<PathBlock>& blocks) {
    std::vector<MotionPiece> out;
    const auto drain = [&] {
        while (planner.ready()) {
            const Plan plan = planner.plan();
            out.insert(out.end(), plan.committed.begin(), plan.committed.end());
        }
    };
    for (const PathBlock& block : blocks) {
        planner.add(block);
        drain();
    }
    planner.stop();
    drain();
    return out;
}

double durationOf(const std::vector<MotionPiece>& pieces) {
    double sum = 0.0;
    for (const MotionPiece& piece : pieces) sum += piece.law.duration_s;
    return sum;
}

std::vector<AxisVector> samples(const std::vector<MotionPiece>& pieces, double tick_s) {
    std::vector<AxisVector> out(3, pieces.front().at(0.0));
    double begin = 0.0;
    std::size_t piece = 0;
    for (std::size_t tick = 1; piece < pieces.size(); ++tick) {
        const double t = static_cast<double>(tick) * tick_s;
        while (piece < pieces.size() && t - begin > pieces[piece].law.duration_s)
            begin += pieces[piece++].law.duration_s;
        if (piece < pieces.size()) out.push_back(pieces[piece].at(t - begin));
    }
    for (int i = 0; i < 4; ++i) out.push_back(pieces.back().at(pieces.back().law.duration_s));
    return out;
}

LimitUse limitUse(const std::vector<AxisVector>& samples, double tick_s, const AxisLimits& limits) {
    LimitUse out;
    for (std::size_t k = 3; k < samples.size(); ++k)
        for (std::size_t i = 0; i < limits.count; ++i) {
            const double q0 = samples[k][i];
            const double q1 = samples[k - 1][i];
            const double q2 = samples[k - 2][i];
            const double q3 = samples[k - 3][i];
            const double v = (q0 - q1) / tick_s;
            const double a = (q0 - 2.0 * q1 + q2) / (tick_s * tick_s);
            const double j = (q0 - 3.0 * q1 + 3.0 * q2 - q3) / (tick_s * tick_s * tick_s);
            out.velocity = std::max(out.velocity, std::abs(v) / limits.velocity[i]);
            out.acceleration = std::max(out.acceleration, std::abs(a) / limits.acceleration[i]);
            out.jerk = std::max(out.jerk, std::abs(j) / limits.jerk[i]);
        }
    return out;
}

AxisLimits cube(double velocity, double acceleration, double jerk) {
    AxisLimits limits;
    for (std::size_t i = 0; i < 3; ++i) {
        limits.velocity[i] = velocity;
        limits.acceleration[i] = acceleration;
        limits.jerk[i] = jerk;
    }
    return limits;
}

ToolModel cubeTool() {
    return [](const AxisVector& axes) { return ToolPlace{{axes[0], axes[1], axes[2]}, geometry::Vector3::UnitZ()}; };
}

PathBlock line(const geometry::Vector3& from, const geometry::Vector3& to, double feed_mm_per_s) {
    PathBlock block;
    for (const geometry::Vector3& tip : {from, to})
        block.points.push_back({{tip.x(), tip.y(), tip.z()}, {tip, geometry::Vector3::UnitZ()}});
    block.feed_mm_per_s = feed_mm_per_s;
    return block;
}

}  // namespace cusp::dynamics::test
