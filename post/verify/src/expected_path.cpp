// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One walk over the records, carrying what is modal in a CL file.
#include "expected_path.hpp"

namespace cusp::post::verify {

namespace {

reader::Vector3 toReader(const geometry::Vector3& v) { return {v.x(), v.y(), v.z()}; }

class Walk {
public:
    Walk(ExpectedPath& out, const std::string& file, base::Diagnostics& report)
        : out_(out), file_(file), report_(report) {}

    void operator()(const toolpath::LinearMotion& motion) {
        if (process_changed_ || out_.processes.empty()) out_.processes.push_back(process_);
        process_changed_ = false;
        ExpectedPoint point;
        point.pose = {toReader(motion.location.tip_mm), toReader(motion.location.axis)};
        point.line = line;
        point.process = static_cast<std::uint32_t>(out_.processes.size() - 1);
        point.rapid = motion.kind == toolpath::MotionKind::Rapid;
        point.opens = opens_;
        opens_ = false;
        out_.points.push_back(point);
    }
    void operator()(const toolpath::FeedRate& feed) { change().feed = feed; }
    void operator()(const toolpath::SpindleCommand& command) {
        change().turn = command.turn;
        if (command.speed)
            process_.rpm = command.unit == toolpath::SpindleCommand::Unit::Rpm ? command.speed : std::nullopt;
    }
    void operator()(const toolpath::CoolantCommand& command) { change().coolant = command.kind; }
    void operator()(const toolpath::ToolCall& call) {
        change().tool_number = call.number;
        process_.tool_name = call.name;
        opens_ = true;
    }
    void operator()(const toolpath::OperationStart&) { opens_ = true; }
    void operator()(const toolpath::ProgrammingFrame&) { opens_ = true; }
    void operator()(const toolpath::ProgramStop&) { opens_ = true; }
    void operator()(const toolpath::Remark&) {}
    void operator()(const toolpath::Dwell&) {}
    void operator()(const toolpath::ProgramEnd&) {}
    void operator()(const toolpath::StartPosition&) {}
    void operator()(const toolpath::WorkPlane&) { opens_ = true; }
    void operator()(const toolpath::ArcMotion&) { refuse("arcs are"); }
    void operator()(const toolpath::HomeReturn&) { refuse("GOHOME is"); }
    void operator()(const toolpath::CycleStart&) { refuse("drilling cycles are"); }
    void operator()(const toolpath::HoleLocation&) {}
    void operator()(const toolpath::CycleEnd&) {}
    void operator()(const toolpath::CutterCompensation& command) {
        if (command.side != toolpath::CutterCompensation::Side::Off) refuse("cutter radius compensation is");
    }

    std::uint32_t line = 0;

private:
    void refuse(const char* what) {
        report_.error("verify.unsupported", std::string(what) + " not yet verified", {file_, line, 0, {}});
    }
    ExpectedProcess& change() {
        process_changed_ = true;
        return process_;
    }

    ExpectedPath& out_;
    const std::string& file_;
    base::Diagnostics& report_;
    ExpectedProcess process_;
    bool process_changed_ = true;
    bool opens_ = true;
};

}  // namespace

ExpectedPath expectedPath(const toolpath::ToolPath& path, base::Diagnostics& report) {
    ExpectedPath out;
    Walk walk(out, path.file_name, report);
    for (const toolpath::ClRecord& record : path.records) {
        walk.line = record.line;
        std::visit(walk, record.statement);
    }
    return out;
}

}  // namespace cusp::post::verify
