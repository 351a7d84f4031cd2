// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A sink that turns executed motions into straight moves.
#include "program_moves.hpp"

#include "console.hpp"
#include "input.hpp"

#include <cusp/base/number_text.hpp>
#include <cusp/post/reader/move_sampler.hpp>
#include <cusp/post/reader/program_reader.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cusp::cli {
namespace {

using post::reader::ExecutedMotion;
using simulation::CutterPath;

geometry::Vector3 vectorOf(const post::reader::Vector3& v) { return {v.x, v.y, v.z}; }

toolpath::CutterLocation locationOf(const post::reader::ToolPose& pose) {
    return {vectorOf(pose.tip_mm), vectorOf(pose.axis).normalized()};
}

class MoveSink : public post::reader::ProgramSink {
public:
    MoveSink(std::string file, const LoadedMachine& machine, const toolpath::ToolLibrary& library,
             const toolpath::Tool* tool, double chord_tolerance_mm, base::Diagnostics& report)
        : file_(std::move(file)),
          chain_(machine.file.machine),
          library_(library),
          tool_(tool),
          chord_tolerance_mm_(chord_tolerance_mm),
          report_(report) {}

    void motion(const ExecutedMotion& motion) override {
        if (motion.machine_coordinates) return;
        const auto line = static_cast<std::uint32_t>(motion.place.line);
        if (!motion.end_pose) {
            unknown_ += motion.code == post::reader::MotionCode::Rapid ? 0 : 1;
            if (unknown_ == 1 && motion.code != post::reader::MotionCode::Rapid)
                report_.error("simulate.pose",
                              "the program does not tell where the tool is here: an axis was never programmed in this "
                              "frame, or rotary axes turn without TRAORI",
                              {file_, line, {}, {}});
            return;
        }
        ++path_.locations;
        if (!motion.start_pose) return;  // from where the program does not say: the tool is only placed
        if (!selectTool(*motion.state, line)) return;
        add(motion, line);
    }
    void event(const post::reader::BlockPlace&, const post::reader::ExecutedEvent&) override {}

    [[nodiscard]] CutterPath finish() { return std::move(path_); }

private:
    /// The cutter of the tool in the spindle; false, and said once a tool, where it is not known.
    bool selectTool(const post::reader::ModalSnapshot& state, std::uint32_t line) {
        if (known_ && state.tool == current_) return !path_.cutters.empty() && usable_;
        known_ = true;
        current_ = state.tool;
        const toolpath::Tool* found = tool_ != nullptr ? tool_ : library_.findName(current_);
        std::int64_t number = 0;
        const char* end = current_.data() + current_.size();
        if (found == nullptr && std::from_chars(current_.data(), end, number).ptr == end)
            found = library_.findNumber(number);
        usable_ = found != nullptr;
        if (!usable_) {
            report_.error("simulate.tool",
                          current_.empty()
                              ? std::string("the tool moves before any tool change: give the tool with --tool")
                              : fmt::format("tool \"{}\" is not in the tool library: a program does not tell the shape "
                                            "of its tools; give --tool-library, or --tool for all",
                                            current_),
                          {file_, line, {}, {}});
            return false;
        }
        path_.cutters.push_back(found->cutter());
        path_.tools.push_back(found);
        return true;
    }

    void add(const ExecutedMotion& motion, std::uint32_t line) {
        const auto kind =
            motion.code == post::reader::MotionCode::Rapid ? toolpath::MotionKind::Rapid : toolpath::MotionKind::Feed;
        // A chord of 1/n of the way is off it by an eighth of the second derivative by n²; the axis tells at the cutter.
        const post::reader::Bend bend = post::reader::bendOf(motion, chain_);
        const double reach = path_.cutters.back().diameter_mm + path_.cutters.back().cutting_height_mm;
        const double off = (bend.tip_mm + bend.axis_rad * reach) / 8.0;
        constexpr double most_chords = 10000.0;
        const int chords =
            static_cast<int>(std::clamp(std::ceil(std::sqrt(off / chord_tolerance_mm_)), 1.0, most_chords));
        toolpath::CutterLocation from = locationOf(*motion.start_pose);
        for (int i = 1; i <= chords; ++i) {
            const auto to = i == chords
                                ? locationOf(*motion.end_pose)
                                : locationOf(post::reader::poseAt(motion, chain_, static_cast<double>(i) / chords));
            path_.moves.push_back({from, to, kind, line, static_cast<std::uint32_t>(path_.cutters.size() - 1)});
            from = to;
        }
    }

    std::string file_;
    post::reader::ForwardChain chain_;
    const toolpath::ToolLibrary& library_;
    const toolpath::Tool* tool_;
    double chord_tolerance_mm_;
    base::Diagnostics& report_;
    CutterPath path_;
    std::string current_;
    bool known_ = false;
    bool usable_ = false;
    std::size_t unknown_ = 0;
};

}  // namespace

base::Result<CutterPath> readProgramMoves(std::istream& stream, const std::string& name, const LoadedMachine& machine,
                                          const toolpath::ToolLibrary& library, const toolpath::Tool* tool,
                                          double chord_tolerance_mm, base::Diagnostics& report) {
    MoveSink sink(name, machine, library, tool, chord_tolerance_mm, report);
    post::reader::readProgram(stream, name, machine.file, {}, sink, report);
    if (report.hasErrors()) return base::fail(report);
    return sink.finish();
}

base::Result<CutterPath> readProgramMoves(const std::string& file, const LoadedMachine& machine,
                                          const toolpath::ToolLibrary& library, const toolpath::Tool* tool,
                                          double chord_tolerance_mm) {
    auto input = TextInput::open(file);
    if (!input) return base::fail(input.error());
    base::Diagnostics report;
    auto moves = readProgramMoves(input->stream(), input->name(), machine, library, tool, chord_tolerance_mm, report);
    if (moves) tell(report);
    return moves;
}

}  // namespace cusp::cli
