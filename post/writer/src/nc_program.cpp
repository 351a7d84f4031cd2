// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The text dump of NC steps: what golden tests compare, the same for every machine and control.
#include <cusp/post/writer/nc_program.hpp>

#include <cusp/base/units.hpp>

#include <array>
#include <fmt/format.h>

namespace cusp::post {

using toolpath::CoolantCommand;
using toolpath::FeedRate;
using toolpath::MotionKind;
using toolpath::SpindleCommand;

namespace {

struct StepText {
    const std::vector<std::string>& rotary_names;

    std::string rotary(const RotaryValues& values) const {
        std::string out;
        for (std::size_t i = 0; i < rotary_names.size(); ++i)
            out += fmt::format(" {}{:.4f}", rotary_names[i], base::degFromRad(values[i]));
        return out;
    }
    static std::string point(const geometry::Vector3& point_mm) {
        return fmt::format(" X{:.4f} Y{:.4f} Z{:.4f}", point_mm.x(), point_mm.y(), point_mm.z());
    }
    static std::string feed(const FeedRate& feed) {
        if (feed.unit == FeedRate::Unit::MmPerRev) return fmt::format(" {:.4f} mm/rev", feed.value);
        return fmt::format(" {:.3f} mm/min", base::mmPerMinFromMmPerS(feed.value));
    }

    template <class Motion>
    std::string motion(const Motion& item) const {
        const bool rapid = item.kind == MotionKind::Rapid;
        return (rapid ? "rapid" : "feed") + point(item.point_mm) + rotary(item.rotary_rad) +
               (rapid ? "" : feed(item.feed));
    }

    std::string operator()(const Comment& item) const { return "comment " + item.text; }
    std::string operator()(const Literal& item) const { return "block " + item.text; }
    std::string operator()(const ModalStart&) const { return "modal-start"; }
    std::string operator()(const GoHome&) const { return "go-home"; }
    std::string operator()(const ChangeTool& item) const {
        const std::string number = item.number ? fmt::format(" {}", *item.number) : "";
        return "change-tool" + number + (item.name.empty() ? "" : " \"" + item.name + "\"");
    }
    std::string operator()(const Smoothing& item) const { return item.on ? "smoothing on" : "smoothing off"; }
    std::string operator()(const ScreenMessage& item) const { return "message " + item.text; }
    std::string operator()(const SelectWorkOffset& item) const {
        return item.name.empty() ? "work-offset" : "work-offset " + item.name;
    }
    std::string operator()(const Spindle& item) const {
        if (item.turn == SpindleCommand::Turn::Off) return "spindle off";
        const char* turn = item.turn == SpindleCommand::Turn::Clockwise ? "cw" : "ccw";
        return fmt::format("spindle {} {:.3f} rpm", turn, item.speed_rpm);
    }
    std::string operator()(const Coolant& item) const {
        switch (item.kind) {
            case CoolantCommand::Kind::Off: return "coolant off";
            case CoolantCommand::Kind::Flood: return "coolant flood";
            case CoolantCommand::Kind::Mist: return "coolant mist";
            case CoolantCommand::Kind::Through: return "coolant through";
        }
        return {};
    }
    std::string operator()(const PositionRotary& item) const { return "position-rotary" + rotary(item.rotary_rad); }
    std::string operator()(const TipProgramming& item) const {
        if (!item.on) return "tip-programming off";
        return item.vectors ? "tip-programming on, vectors" : "tip-programming on";
    }
    std::string operator()(const TiltedPlane& item) const {
        const auto deg = [&](std::size_t i) { return base::degFromRad(item.angles_rad[i]); };
        return fmt::format("tilted-plane X{:.4f} Y{:.4f} Z{:.4f} at", deg(0), deg(1), deg(2)) + point(item.origin_mm) +
               rotary(item.rotary_rad);
    }
    std::string operator()(const PlaneOff&) const { return "plane-off"; }
    std::string operator()(const RadiusCompensation& item) const {
        using Side = toolpath::CutterCompensation::Side;
        const char* side = item.side == Side::Off ? "off" : item.side == Side::Left ? "left" : "right";
        return std::string("radius-compensation ") + side +
               (item.offset_number ? fmt::format(" {}", *item.offset_number) : "");
    }
    std::string operator()(const AxisProgramming& item) const {
        return fmt::format("axis-programming length {:.4f} origin", item.tool_length_mm) + point(item.wcs_origin_mm);
    }
    std::string operator()(const Approach& item) const { return "approach " + motion(item); }
    std::string operator()(const Move& item) const {
        const std::string text = "move " + motion(item);
        return item.moves_per_min > 0.0 ? text + fmt::format(" as {:.6g}/min", item.moves_per_min) : text;
    }
    std::string operator()(const ArcMove& item) const {
        const std::string text = fmt::format("arc {}{} I{:.4f} J{:.4f}{}{}", item.clockwise ? "cw" : "ccw",
                                             point(item.end_mm), item.center_from_start_mm.x(),
                                             item.center_from_start_mm.y(), rotary(item.rotary_rad), feed(item.feed));
        return item.moves_per_min > 0.0 ? text + fmt::format(" as {:.6g}/min", item.moves_per_min) : text;
    }
    std::string operator()(const HoleCycle& item) const {
        static constexpr std::array<const char*, 5> kinds{"drill", "deep", "break-chip", "bore", "tap"};
        return fmt::format(
            "hole-cycle {} retract Z{:.4f} surface Z{:.4f} clearance {:.4f} depth {:.4f} dwell {:.3f} peck "
            "{:.4f} {:.4f} pitch {:.4f}{}",
            kinds[static_cast<std::size_t>(item.kind)], item.retract_z_mm, item.surface_z_mm, item.clearance_mm,
            item.depth_mm, item.dwell_s, item.first_peck_mm, item.peck_mm, item.pitch_mm, feed(item.feed));
    }
    std::string operator()(const HolePosition& item) const {
        return fmt::format("hole X{:.4f} Y{:.4f}", item.x_mm, item.y_mm) + rotary(item.rotary_rad);
    }
    std::string operator()(const HoleCycleOff&) const { return "hole-cycle off"; }
    std::string operator()(const Pause& item) const { return fmt::format("pause {:.3f} s", item.seconds); }
    std::string operator()(const Stop& item) const { return item.optional ? "optional-stop" : "stop"; }
};

}  // namespace

geometry::RigidTransform TiltedPlane::workpieceFromPlane() const {
    using geometry::Vector3;
    geometry::RigidTransform workpiece_from_plane = geometry::RigidTransform::Identity();
    workpiece_from_plane.translate(origin_mm);
    workpiece_from_plane.rotate(Eigen::AngleAxisd(angles_rad[0], Vector3::UnitX()));
    workpiece_from_plane.rotate(Eigen::AngleAxisd(angles_rad[1], Vector3::UnitY()));
    workpiece_from_plane.rotate(Eigen::AngleAxisd(angles_rad[2], Vector3::UnitZ()));
    return workpiece_from_plane;
}

std::string toText(const NcStep& step, const std::vector<std::string>& rotary_names) {
    return std::visit(StepText{rotary_names}, step.item);
}

}  // namespace cusp::post
