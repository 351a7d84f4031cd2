// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Runs blocks of words; knows the few words drawn programs are made of.
#include "paper_machine.hpp"
#include "paper_cycles.hpp"

#include <cusp/base/units.hpp>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

namespace cusp::post::verify::test {

namespace {

constexpr const char* axis_letters[] = {"X", "Y", "Z"};
/// Chords of 0.2 µm at radii below 20 mm, and steps of the tool axis.
constexpr double arc_step_rad = 0.008;
constexpr double turn_step_deg = 0.1;

Vector3d between(const Vector3d& a, const Vector3d& b, double fraction) {
    const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
    if (angle < 1e-9) return b;
    return (std::sin((1.0 - fraction) * angle) * a + std::sin(fraction * angle) * b) / std::sin(angle);
}

Eigen::Isometry3d turned(double angle_deg, int axis) {
    return Eigen::Isometry3d(Eigen::AngleAxisd(base::radFromDeg(angle_deg), Vector3d::Unit(axis)));
}

class PaperMachine {
public:
    explicit PaperMachine(const DrawnProgram& program) : program_(program) {}

    std::vector<TraceMotion> run() {
        for (const NcBlock& block : program_.blocks) {
            if (ended_) break;
            one(block);
        }
        // A program without an end is not run at all.
        if (!ended_) trace_.clear();
        return std::move(trace_);
    }

private:
    struct Position {
        std::array<std::optional<double>, 3> linear;
        std::optional<double> first_deg;
        std::optional<double> second_deg;
        std::optional<Vector3d> axis;  ///< as A3 B3 C3 or CYCLE800 left it
    };

    void one(const NcBlock& block) {
        codes(block);
        words(block);
        functions(block);
        if (block.cycle == "CYCLE800" || (block.has("ROT") || block.has("TRANS") || block.has("AROT")))
            return frames(block);
        if (block.has("MCALL"))
            modal_ = block.cycle.empty() ? nullptr : &block;
        else if (!block.cycle.empty())
            drill(block);
        if (block.has("SUPA"))
            forget(block);
        else
            move(block);
        const bool moved = block.has("X") || block.has("Y") || block.has("Z");
        if (modal_ != nullptr && modal_ != &block && moved) drill(*modal_);
        if (block.has("M", 5)) state_.spindle = 5;
        if (block.has("M", 9)) state_.mist = state_.flood = false;
        ended_ = ended_ || block.has("M", 30);
    }

    void codes(const NcBlock& block) {
        for (const NcWord& word : block.words) {
            if (word.address == "TRAORI" || word.address == "TRAFOOF") {
                if ((word.address == "TRAORI") != traori_) at_.linear = {};
                traori_ = word.address == "TRAORI";
            }
            if (word.address.starts_with("ORI")) (word.address.size() == 6 ? ori_frame_ : ori_path_) = word.address;
            if (word.address != "G") continue;
            const double code = *word.value;
            if (code <= 3.0) motion_ = code;
            if (code >= 17.0 && code <= 19.0) state_.plane = code;
            if (code == 90.0 || code == 91.0) incremental_ = code == 91.0;
            if (code == 700.0 || code == 710.0) mm_per_unit_ = code == 700.0 ? base::mm_per_inch : 1.0;
            if (code >= 93.0 && code <= 95.0 && code != feed_code_) {
                feed_code_ = code;
                feed_.reset();
            }
            const bool offset = (code >= 54.0 && code <= 57.0) || code == 500.0;
            if (offset && state_.work_offset != code) {
                state_.work_offset = code;
                at_.linear = {};
            }
        }
    }

    void words(const NcBlock& block) {
        if (feed_code_ == 93.0) feed_.reset();
        const double feed_unit = feed_code_ == 93.0 ? 1.0 : mm_per_unit_;
        if (const auto feed = block.value("F")) feed_ = *feed * feed_unit;
        if (const auto speed = block.value("S")) state_.rpm = *speed;
        if (const auto tool = block.value("T")) preselected_ = *tool;
        if (block.has("M", 6)) {
            state_.tool = preselected_;
            state_.cutting_edge = 1.0;
            state_.spindle = 5;
            state_.mist = state_.flood = false;
            at_.linear = {};
        }
        const auto edge = block.value("D");
        if (!edge || *edge == state_.cutting_edge) return;
        state_.cutting_edge = *edge;
        at_.linear = {};
    }

    void functions(const NcBlock& block) {
        if (block.has("M", 3)) state_.spindle = 3;
        if (block.has("M", 4)) state_.spindle = 4;
        state_.mist = state_.mist || block.has("M", 7);
        state_.flood = state_.flood || block.has("M", 8);
    }

    void frames(const NcBlock& block) {
        std::optional<Vector3d> tip;
        if (at_.linear[0] && at_.linear[1] && at_.linear[2]) tip = frame() * programmed(at_);
        if (block.cycle == "CYCLE800")
            swivel(block);
        else {
            Vector3d values = Vector3d::Zero();
            for (int i = 0; i < 3; ++i) values[i] = block.value(axis_letters[i]).value_or(0.0);
            Eigen::Isometry3d change = Eigen::Isometry3d::Identity();
            if (block.has("TRANS"))
                change.translate(Vector3d(mm_per_unit_ * values));
            else
                change = turned(values.z(), 2) * turned(values.y(), 1) * turned(values.x(), 0);
            programmed_frame_ = block.has("AROT") ? programmed_frame_ * change : change;
        }
        if (!tip) return;
        const Vector3d now = frame().inverse() * *tip;
        for (std::size_t i = 0; i < 3; ++i) at_.linear[i] = now[static_cast<Eigen::Index>(i)];
    }

    /// Mode 57 turns about X, the new Y, the new Z; 27 the other way round; 39 Z, X, Y.
    void swivel(const NcBlock& block) {
        programmed_frame_ = swivel_frame_ = Eigen::Isometry3d::Identity();
        swivelled_ = !block.arguments.empty();
        at_.linear = {};
        if (!swivelled_) return;
        const auto at = [&](std::size_t i) { return block.arguments[i].value_or(0.0); };
        const int order = static_cast<int>(at(3));
        const std::array<int, 3> axes = order == 57   ? std::array{0, 1, 2}
                                        : order == 27 ? std::array{2, 1, 0}
                                                      : std::array{2, 0, 1};
        swivel_frame_.translate(mm_per_unit_ * Vector3d(at(4), at(5), at(6)));
        for (std::size_t i = 0; i < 3; ++i) swivel_frame_ = swivel_frame_ * turned(at(7 + i), axes[i]);
        swivel_frame_.translate(mm_per_unit_ * Vector3d(at(10), at(11), at(12)));
        at_.linear = {};
        at_.first_deg.reset();
        at_.second_deg.reset();
        at_.axis = swivel_frame_.linear().col(2);
    }

    [[nodiscard]] Eigen::Isometry3d frame() const { return swivel_frame_ * programmed_frame_; }
    [[nodiscard]] static Vector3d programmed(const Position& at) {
        return {*at.linear[0], *at.linear[1], *at.linear[2]};
    }

    /// SUPA: where the machine's zero lies in the work offset is not for the program to know.
    void forget(const NcBlock& block) {
        for (std::size_t i = 0; i < 3; ++i)
            if (block.has(axis_letters[i])) at_.linear[i].reset();
        rotaryTargets(block);
        linked_ = true;
    }

    bool rotaryTargets(const NcBlock& block) {
        if (program_.closed_form == nullptr) return false;
        const auto target = [&](const std::string& name, std::optional<double>& slot) {
            const auto value = block.value(name);
            if (!value) return false;
            slot = incremental_ ? (slot ? std::optional(*slot + *value) : slot) : value;
            return true;
        };
        const bool first = target(program_.closed_form->first, at_.first_deg);
        const bool second = target(program_.closed_form->second, at_.second_deg);
        if (!first && !second) return false;
        at_.axis.reset();
        swivelled_ = false;
        return true;
    }

    bool targets(const NcBlock& block) {
        bool moves = rotaryTargets(block);
        for (std::size_t i = 0; i < 3; ++i) {
            const auto value = block.value(axis_letters[i]);
            if (!value) continue;
            moves = true;
            auto& slot = at_.linear[i];
            const double target = *value * mm_per_unit_;
            slot = incremental_ ? (slot ? std::optional(*slot + target) : slot) : std::optional(target);
        }
        if (!block.has("A3") && !block.has("B3") && !block.has("C3")) return moves;
        const Vector3d vector(block.value("A3").value_or(0.0), block.value("B3").value_or(0.0),
                              block.value("C3").value_or(0.0));
        at_.axis = frame().linear() * vector.normalized();
        at_.first_deg.reset();
        at_.second_deg.reset();
        return true;
    }

    [[nodiscard]] bool atZero(const Position& at) const {
        return program_.closed_form == nullptr || (at.first_deg == 0.0 && at.second_deg == 0.0);
    }
    [[nodiscard]] bool byJoints() const { return !traori_ && !swivelled_ && program_.closed_form != nullptr; }

    [[nodiscard]] std::optional<TracePose> pose(const Position& at) const {
        if (!at.linear[0] || !at.linear[1] || !at.linear[2]) return std::nullopt;
        const Vector3d point = frame() * programmed(at);
        if (program_.closed_form == nullptr) return TracePose{point, Vector3d::UnitZ()};
        if (at.axis && !traori_ && !swivelled_) return std::nullopt;
        if (at.axis) return TracePose{point, *at.axis};
        if (!at.first_deg || !at.second_deg) return std::nullopt;
        const Vector3d axis = program_.closed_form->axis(*at.first_deg, *at.second_deg);
        if (!byJoints() || atZero(at)) return TracePose{point, axis};
        if (!program_.options.tool_length_mm) return std::nullopt;
        return TracePose{program_.closed_form->tip({point, *at.first_deg, *at.second_deg}, program_.origin_mm,
                                                   program_.tool_length_mm),
                         axis};
    }

    [[nodiscard]] static Position mix(const Position& a, const Position& b, double fraction) {
        Position out = b;
        const auto value = [&](const std::optional<double>& from, const std::optional<double>& to) {
            return from && to ? std::optional((1.0 - fraction) * *from + fraction * *to) : to;
        };
        for (std::size_t i = 0; i < 3; ++i) out.linear[i] = value(a.linear[i], b.linear[i]);
        out.first_deg = value(a.first_deg, b.first_deg);
        out.second_deg = value(a.second_deg, b.second_deg);
        return out;
    }

    void move(const NcBlock& block) {
        const Position start = at_;
        const bool from_link = linked_;
        const bool arc = motion_ >= 2.0;
        if (!targets(block) && !(arc && (block.has("I") || block.has("J")))) return;
        linked_ = block.link;
        if (block.link) return;
        TraceMotion motion;
        motion.state = state_;
        motion.state.rapid = motion_ == 0.0;
        const auto from = from_link ? std::nullopt : pose(start);
        const auto to = pose(at_);
        motion.state.placed = to.has_value();
        if (arc && (!from || !addArc(block, start, motion))) motion.state.placed = false;
        if (!arc && to) addStraight(start, from, *to, motion);
        finish(std::move(motion), start, from.has_value());
    }

    void addStraight(const Position& start, const std::optional<TracePose>& from, const TracePose& to,
                     TraceMotion& motion) const {
        if (!from) return motion.poses.push_back(to);
        double turn_deg = base::degFromRad(std::acos(std::clamp(from->axis.dot(to.axis), -1.0, 1.0)));
        const bool rotary = start.first_deg && start.second_deg && at_.first_deg && at_.second_deg;
        if (rotary)
            turn_deg += std::abs(*at_.first_deg - *start.first_deg) + std::abs(*at_.second_deg - *start.second_deg);
        const int pieces = std::clamp(static_cast<int>(std::ceil(turn_deg / turn_step_deg)), 1, 2000);
        const bool linear =
            rotary && (byJoints() || (program_.md21104 ? ori_path_ == "ORIAXES" : ori_frame_ == "ORIMKS"));
        for (int i = 0; i <= pieces; ++i) {
            const double fraction = static_cast<double>(i) / pieces;
            if (linear)
                motion.poses.push_back(*pose(mix(start, at_, fraction)));
            else
                motion.poses.push_back(
                    {(1.0 - fraction) * from->tip_mm + fraction * to.tip_mm, between(from->axis, to.axis, fraction)});
        }
    }

    bool addArc(const NcBlock& block, const Position& start, TraceMotion& motion) const {
        if (!at_.linear[0] || !at_.linear[1] || !at_.linear[2]) return false;
        const int normal = state_.plane == 17.0 ? 2 : state_.plane == 18.0 ? 1 : 0;
        const int u = (normal + 1) % 3;
        const int v = (normal + 2) % 3;
        const Vector3d from = programmed(start);
        const Vector3d to = programmed(at_);
        static constexpr const char* centers[] = {"I", "J", "K"};
        if (block.has(centers[normal])) return false;
        Vector3d center = from;
        for (const int i : {u, v}) center[i] += mm_per_unit_ * block.value(centers[i]).value_or(0.0);
        const double sign = motion_ == 2.0 ? -1.0 : 1.0;
        const double radius = std::hypot(from[u] - center[u], from[v] - center[v]);
        const double end_radius = std::hypot(to[u] - center[u], to[v] - center[v]);
        if (std::abs(radius - end_radius) > std::max(0.01, 0.001 * radius)) return false;
        const double begin = std::atan2(from[v] - center[v], from[u] - center[u]);
        double sweep = sign * (std::atan2(to[v] - center[v], to[u] - center[u]) - begin);
        if (sweep < 0.0) sweep += 2.0 * std::numbers::pi;
        if (std::hypot(to[u] - from[u], to[v] - from[v]) < 1e-9) sweep = 2.0 * std::numbers::pi;
        const int pieces = static_cast<int>(std::ceil(sweep / arc_step_rad)) + 1;
        const Vector3d axis = pose(at_)->axis;
        for (int i = 0; i <= pieces; ++i) {
            const double fraction = static_cast<double>(i) / pieces;
            const double r = radius + fraction * (end_radius - radius);
            const double angle = begin + sign * fraction * sweep;
            Vector3d point;
            point[u] = center[u] + r * std::cos(angle);
            point[v] = center[v] + r * std::sin(angle);
            point[normal] = from[normal] + fraction * (to[normal] - from[normal]);
            motion.poses.push_back({frame() * point, axis});
        }
        return true;
    }

    void finish(TraceMotion motion, const Position& start, bool started) {
        double length = 0.0;
        for (std::size_t i = 1; i < motion.poses.size(); ++i)
            length += (motion.poses[i].tip_mm - motion.poses[i - 1].tip_mm).norm();
        const double feed = feed_.value_or(0.0);
        motion.state.feed_mm_per_min = feed_code_ == 93.0   ? feed * length
                                       : feed_code_ == 95.0 ? feed * state_.rpm
                                                            : feed;
        if (started && start.first_deg && at_.first_deg)
            motion.rotary_travel_deg = std::abs(*at_.first_deg - *start.first_deg);
        if (started && start.second_deg && at_.second_deg)
            motion.rotary_travel_deg += std::abs(*at_.second_deg - *start.second_deg);
        trace_.push_back(std::move(motion));
    }

    void drill(const NcBlock& call) {
        const int spindle = state_.spindle;
        for (const HoleStep& step : holeSteps(call, feed_.value_or(0.0))) {
            if (step.spindle != 0) state_.spindle = step.spindle;
            if (step.dwell_s > 0.0)
                dwell(step.dwell_s);
            else
                height(step.height, step.rapid, step.feed_mm_per_min, step.rpm);
        }
        if (call.cycle == "CYCLE84" && spindleAfterTap(call) == 0) state_.spindle = spindle;
    }

    void height(double target, bool rapid, double feed, double rpm) {
        const std::size_t normal = state_.plane == 17.0 ? 2 : state_.plane == 18.0 ? 1 : 0;
        const auto from = pose(at_);
        at_.linear[normal] = target * mm_per_unit_;
        const auto to = pose(at_);
        TraceMotion motion;
        motion.state = state_;
        if (rpm > 0.0) motion.state.rpm = rpm;
        motion.state.rapid = rapid;
        motion.state.placed = from && to;
        motion.state.feed_mm_per_min = feed;
        if (motion.state.placed) motion.poses = {*from, *to};
        if (!motion.state.placed || (from->tip_mm - to->tip_mm).norm() > 1e-9) trace_.push_back(std::move(motion));
    }

    void dwell(double seconds) {
        const auto here = pose(at_);
        if (seconds <= 0.0 || !here) return;
        TraceMotion motion;
        motion.state = state_;
        motion.state.dwell_s = seconds;
        motion.poses = {*here, *here};
        trace_.push_back(std::move(motion));
    }

    const DrawnProgram& program_;
    std::vector<TraceMotion> trace_;
    TraceState state_;
    Position at_;
    double motion_ = 1.0;
    double feed_code_ = 94.0;
    std::optional<double> feed_;
    double preselected_ = 0.0;
    double mm_per_unit_ = 1.0;
    std::string ori_frame_ = "ORIWKS";
    std::string ori_path_ = "ORIVECT";
    Eigen::Isometry3d swivel_frame_ = Eigen::Isometry3d::Identity();
    Eigen::Isometry3d programmed_frame_ = Eigen::Isometry3d::Identity();
    const NcBlock* modal_ = nullptr;
    bool incremental_ = false;
    bool traori_ = false;
    bool swivelled_ = false;
    bool linked_ = true;
    bool ended_ = false;
};

}  // namespace

std::vector<TraceMotion> trace(const DrawnProgram& program) { return PaperMachine(program).run(); }

}  // namespace cusp::post::verify::test
