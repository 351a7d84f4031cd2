// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// u = (sin C sin A, −cos C sin A, cos A), and the same A and C printed.
#include "program_pair.hpp"

#include <cmath>
#include <cstdlib>
#include <fmt/format.h>
#include <iostream>
#include <random>
#include <sstream>

namespace cusp::post::verify::test {

namespace {

using namespace cusp::toolpath;

struct Pose {
    geometry::Vector3 tip;
    double a_deg = 0.0;
    double c_deg = 0.0;
};

class Builder {
public:
    explicit Builder(std::uint32_t seed) : random_(seed) {}

    void operation(int number, int points) {
        record(OperationStart{fmt::format("OP{}", number)});
        record(ToolCall{number, fmt::format("BALL_{}", number), std::nullopt});
        record(SpindleCommand{SpindleCommand::Turn::Clockwise, 8000.0 + number, SpindleCommand::Unit::Rpm});
        record(CoolantCommand{CoolantCommand::Kind::Flood});
        for (const char* line : {"TRAFOOF", "SUPA G0 Z0 D0", "SUPA X0 Y0 A0 C0", "G40 G17 G710 G94 G90"}) block(line);
        block(fmt::format("T{} M6", number));
        Pose pose = begin(number);
        block(fmt::format("G0 A{:.5f} C{:.5f}", pose.a_deg, pose.c_deg));
        for (const char* line : {"TRAORI", "ORIAXES", "G54"}) block(line);
        block(fmt::format("D1 S{} M3 M8", 8000 + number));
        move(pose, MotionKind::Rapid, "G0 ");
        record(FeedRate{500.0 / 60.0, FeedRate::Unit::MmPerS});
        pose.tip.z() -= 40.0;
        move(pose, MotionKind::Feed, "G1 ", " F500.");
        record(FeedRate{1500.0 / 60.0, FeedRate::Unit::MmPerS});
        for (int i = 0; i < points; ++i) {
            advance(pose, i);
            move(pose, MotionKind::Feed, "", i == 0 ? " F1500." : "");
        }
        pose.tip.z() += 40.0;
        move(pose, MotionKind::Rapid, "G0 ");
    }

    ProgramPair finish() {
        record(ProgramEnd{});
        for (const char* line : {"TRAFOOF", "SUPA G0 Z0 D0", "M5 M9", "M30"}) block(line);
        out_.path.file_name = "P.cls";
        return std::move(out_);
    }

private:
    void record(ClStatement statement) {
        ClRecord& added = out_.path.records.emplace_back();
        added.statement = std::move(statement);
        added.line = static_cast<std::uint32_t>(out_.path.records.size());
    }
    void block(const std::string& text) {
        out_.program.push_back(fmt::format("N{} {}", 10 * (out_.program.size() + 1), text));
    }

    Pose begin(int number) { return {{20.0 * number, 15.0, 60.0}, 20.0 + number, -150.0 + number}; }

    /// A winding way with no two steps alike.
    void advance(Pose& pose, int i) {
        std::uniform_real_distribution<double> jitter(0.5, 1.5);
        pose.tip += geometry::Vector3(jitter(random_), 0.8 * std::sin(0.3 * i) + 0.1 * jitter(random_),
                                      0.4 * std::cos(0.2 * i));
        pose.a_deg = 27.5 + 22.5 * std::sin(0.11 * i + 1.0) + 0.01 * jitter(random_);
        pose.c_deg = std::min(190.0, pose.c_deg + jitter(random_));
    }

    void move(const Pose& pose, MotionKind kind, const std::string& before, const std::string& after = "") {
        const double a = base::radFromDeg(pose.a_deg);
        const double c = base::radFromDeg(pose.c_deg);
        LinearMotion motion;
        motion.location.tip_mm = pose.tip;
        motion.location.axis = {std::sin(c) * std::sin(a), -std::cos(c) * std::sin(a), std::cos(a)};
        motion.kind = kind;
        record(motion);
        block(fmt::format("{}X{:.5f} Y{:.5f} Z{:.5f} A{:.5f} C{:.5f}{}", before, pose.tip.x(), pose.tip.y(),
                          pose.tip.z(), pose.a_deg, pose.c_deg, after));
    }

    ProgramPair out_;
    std::mt19937 random_;
};

}  // namespace

ProgramPair twoOperations(std::uint32_t seed, int points) {
    Builder builder(seed);
    builder.operation(5, points);
    builder.operation(6, points);
    return builder.finish();
}

ToolPath straightPath(const std::vector<geometry::Vector3>& tips) {
    ToolPath path;
    path.records.resize(2 + tips.size());
    path.records[0] = {SpindleCommand{SpindleCommand::Turn::Clockwise, 1000.0, SpindleCommand::Unit::Rpm}, 1};
    path.records[1] = {FeedRate{10.0, FeedRate::Unit::MmPerS}, 2};
    std::uint32_t line = 1;
    MotionKind kind = MotionKind::Rapid;
    for (const geometry::Vector3& tip : tips) {
        LinearMotion motion;
        motion.location.tip_mm = tip;
        motion.kind = kind;
        ++line;
        path.records[line] = {motion, line + 1};
        kind = MotionKind::Feed;
    }
    return path;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    return text;
}

MachineFile shippedMachine(const std::string& name) {
    auto machine = readMachineFile(CUSP_SOURCE_DIR "/machines/" + name + ".toml");
    if (!machine) {
        std::cerr << base::toText(machine.error()) << '\n';
        std::abort();
    }
    return *std::move(machine);
}

VerifyReport verify(const std::string& program, const ToolPath& path, const MachineFile& machine,
                    const VerifyOptions& options) {
    std::istringstream in(program);
    auto report = verifyProgram(in, "P.MPF", machine, &path, options);
    if (report) return *std::move(report);
    VerifyReport refused;
    refused.findings = report.error();
    return refused;
}

std::string errorTexts(const VerifyReport& report) {
    std::string text;
    for (const base::Diagnostic& finding : report.findings)
        if (finding.severity == base::Severity::Error) text += finding.message + "\n";
    return text;
}

}  // namespace cusp::post::verify::test
