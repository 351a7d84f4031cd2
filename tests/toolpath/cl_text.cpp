// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Printing of records for comparison.
#include "cl_text.hpp"

#include <fmt/format.h>
#include <fstream>
#include <sstream>

namespace cusp::toolpath::test {
namespace {

std::string textOf(const geometry::Vector3& v) {
    return fmt::format("{} {} {}", v.x() + 0.0, v.y() + 0.0, v.z() + 0.0);  // no "-0"
}

std::string textOf(const CutterLocation& location) {
    return fmt::format("{} axis {}", textOf(location.tip_mm), textOf(location.axis));
}

std::string textOf(const FeedRate& f) {
    return fmt::format("feed {} {}", f.value, f.unit == FeedRate::Unit::MmPerS ? "mm/s" : "mm/rev");
}

std::string textOf(const geometry::RigidTransform& t) {
    return fmt::format("origin {} x {} y {} z {}", textOf(t.translation()), textOf(t.linear().col(0)),
                       textOf(t.linear().col(1)), textOf(t.linear().col(2)));
}

std::string optionText(const char* name, const std::optional<double>& value) {
    return value ? fmt::format(" {} {}", name, *value) : std::string();
}

struct Printer {
    std::string operator()(const LinearMotion& m) const {
        return fmt::format("{} {}", m.kind == MotionKind::Rapid ? "rapid" : "go", textOf(m.location));
    }
    std::string operator()(const ArcMotion& a) const {
        return fmt::format("arc {} center {} normal {} radius {}{}", textOf(a.end), textOf(a.center_mm),
                           textOf(a.normal), a.radius_mm, a.full_circle ? " full" : "");
    }
    std::string operator()(const StartPosition& s) const { return "from " + textOf(s.location); }
    std::string operator()(const HomeReturn& /*home*/) const { return "home"; }
    std::string operator()(const CycleStart& c) const {
        constexpr const char* kinds[] = {"drill", "deep", "break chip", "bore", "tap"};
        return fmt::format("cycle {} depth {}", kinds[static_cast<int>(c.kind)], c.depth_mm) +
               optionText("clearance", c.clearance_mm) + optionText("retract", c.retract_mm) +
               (c.feed ? " " + textOf(*c.feed) : "") + optionText("first peck", c.first_peck_mm) +
               optionText("peck", c.peck_mm) + optionText("dwell", c.dwell_s);
    }
    std::string operator()(const HoleLocation& h) const { return "hole " + textOf(h.location); }
    std::string operator()(const CycleEnd& /*end*/) const { return "cycle end"; }
    std::string operator()(const SplineMotion& s) const {
        std::string text = fmt::format("spline {} knots {}", fmt::join(s.parameters, " "), fmt::join(s.knots, " "));
        for (const auto& control : s.controls) text += fmt::format(" control {}", fmt::join(control, " "));
        return text;
    }
    std::string operator()(const PathTolerance& t) const {
        return fmt::format("tolerance {} {}", t.outside ? "outside" : "inside", t.value_mm);
    }
    std::string operator()(const CutterCompensation& c) const {
        constexpr const char* sides[] = {"off", "left", "right"};
        return fmt::format("compensation {}{}", sides[static_cast<int>(c.side)],
                           c.offset_number ? " " + std::to_string(*c.offset_number) : "");
    }
    std::string operator()(const WorkPlane& w) const { return "plane " + textOf(w.programming_from_plane); }
    std::string operator()(const FeedRate& f) const { return textOf(f); }
    std::string operator()(const SpindleCommand& s) const {
        constexpr const char* turns[] = {"off", "clockwise", "counter-clockwise"};
        const std::string speed =
            s.speed ? fmt::format(" {} {}", *s.speed, s.unit == SpindleCommand::Unit::Rpm ? "rpm" : "m/min") : "";
        return fmt::format("spindle {}{}", turns[static_cast<int>(s.turn)], speed);
    }
    std::string operator()(const CoolantCommand& c) const {
        constexpr const char* kinds[] = {"off", "flood", "mist", "through"};
        return fmt::format("coolant {}", kinds[static_cast<int>(c.kind)]);
    }
    std::string operator()(const ToolCall& t) const {
        std::string text = fmt::format("tool {} '{}'", t.number ? std::to_string(*t.number) : "-", t.name);
        if (t.cutter) {
            const geometry::Cutter& c = *t.cutter;
            text +=
                fmt::format(" d={} r={} e={:.6g} f={:.6g} a={:.6g} b={:.6g} h={}", c.diameter_mm, c.corner_radius_mm,
                            c.corner_e_mm, c.corner_f_mm, c.point_angle_rad, c.taper_angle_rad, c.cutting_height_mm);
        }
        return text;
    }
    std::string operator()(const OperationStart& o) const { return fmt::format("operation '{}'", o.name); }
    std::string operator()(const ProgrammingFrame& f) const { return "frame " + textOf(f.part_from_programming); }
    std::string operator()(const Remark& r) const {
        constexpr const char* kinds[] = {"part", "message", "insert"};
        return fmt::format("{} '{}'", kinds[static_cast<int>(r.kind)], r.text);
    }
    std::string operator()(const ProgramStop& s) const { return s.optional ? "optional stop" : "stop"; }
    std::string operator()(const Dwell& d) const { return fmt::format("dwell {} s", d.seconds); }
    std::string operator()(const ProgramEnd& /*end*/) const { return "end"; }
};

constexpr const char* file_name = "t.apt";

}  // namespace

std::string fileText(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

std::string textOf(const ClRecord& record) {
    return fmt::format("{} {}\n", record.line, std::visit(Printer{}, record.statement));
}

ReadOut readOut(std::istream& in, const ClReaderOptions& options) {
    ReadOut out;
    ClReader reader(in, file_name, options);
    ClRecord record;
    while (reader.next(record)) {
        out.text += textOf(record);
        out.records.push_back(record);
    }
    out.dialect = reader.dialect();
    out.mm_per_unit = reader.mmPerUnit();
    out.report = reader.report();
    for (const base::Diagnostic& diagnostic : out.report) {
        base::Diagnostic shown = diagnostic;
        shown.where.file.clear();
        out.problems += base::toText(shown) + "\n";
    }
    return out;
}

ReadOut readOut(const std::string& cl_text, const ClReaderOptions& options) {
    std::istringstream in(cl_text);
    return readOut(in, options);
}

namespace {

ReadOut readBody(const std::string& body) {
    ClReaderOptions options;
    options.mm_per_unit = 1.0;
    const bool moves = body.find("GOTO") != std::string::npos;
    return readOut(body + (moves ? "\nFINI\n" : "\nGOTO/0,0,0\nFINI\n"), options);
}

}  // namespace

std::string recordsOf(const std::string& body) {
    const bool moves = body.find("GOTO") != std::string::npos;
    const ReadOut out = readBody(body);
    std::string text;
    for (std::size_t i = 0; i + (moves ? 1 : 2) < out.records.size(); ++i) {
        text += textOf(out.records[i]);
    }
    return text + out.problems;
}

std::string problemsOf(const std::string& body) { return readBody(body).problems; }

}  // namespace cusp::toolpath::test
