// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where the program stands before a block, said again in a few lines, and the proof that they say the same.
#include "program_resume.hpp"

#include "modal_words.hpp"
#include "program_demand.hpp"

#include <cusp/base/number_text.hpp>
#include <cusp/base/units.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <sstream>
#include <vector>

namespace cusp::cli {

namespace {

namespace nc = post::reader;

constexpr int places = 6;
/// What printing a position and reading it back may cost.
constexpr double same_mm = 1e-4;
constexpr double same_rad = 1e-6;

/// The first motion of a line or of one after it, with the state it runs in.
struct Beginning {
    nc::ExecutedMotion motion;
    nc::ModalSnapshot state;
};

class BeginningSink : public nc::ProgramSink {
public:
    explicit BeginningSink(std::size_t line) : line_(line) {}
    void motion(const nc::ExecutedMotion& motion) override {
        if (found_ || motion.place.line < line_) return;
        found_ = Beginning{motion, *motion.state};
        found_->motion.state = nullptr;
    }
    void event(const nc::BlockPlace& /*place*/, const nc::ExecutedEvent& /*event*/) override {}
    [[nodiscard]] const std::optional<Beginning>& found() const { return found_; }

private:
    std::size_t line_;
    std::optional<Beginning> found_;
};

base::Result<Beginning> beginningOf(const std::string& text, const std::string& name, const post::MachineFile& machine,
                                    const nc::MachineSetup& setup, std::size_t line) {
    BeginningSink sink(line);
    std::istringstream stream(text);
    base::Diagnostics report;
    nc::ReaderOptions options;
    options.setup = setup;
    nc::ProgramRun run(stream, name, machine, options, sink, report);
    while (!sink.found() && run.step()) continue;
    if (report.hasErrors()) return base::fail(std::move(report));
    if (!sink.found())
        return base::fail("send.resume", "nothing moves from this block on: there is nothing to resume",
                          {name, line, 0, {}});
    return *sink.found();
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::string number(double value) { return base::formatFixed(value, places, base::TrailingZeros::Strip); }

class Preamble {
public:
    Preamble(const ModalWords& words, const Beginning& at, const post::MachineFile& machine,
             const ResumeOptions& options)
        : words_(words), at_(at), machine_(machine), options_(options), chain_(machine.machine) {}

    [[nodiscard]] std::string text() {
        say(fmt::format("; resumes before N{}, computed by cusp", options_.block));
        say("G40 G90 " + said("plane") + said("units") + said("feed-mode") + said("stop") + said("stop-window"));
        say(words_.others());
        say("TRAFOOF");
        const std::string& retract = machine_.control.retract_axis;
        const bool has_tool = !words_.last("T").empty();
        say(fmt::format("SUPA G0 {}{}{}", retract, number(machine_.machine.linear.at(retract).home_mm),
                        has_tool ? " D0" : ""));
        say(words_.last("T"));
        if (words_.toolChanged()) say("M6");
        say(has_tool && words_.last("D").empty() ? "D1" : words_.last("D"));
        say(words_.last("CYCLE832"));
        say(words_.last("CTOL"));
        say(words_.last("OTOL"));
        say(words_.last("offset"));
        const bool turns = at_.state.spindle != nc::SpindleTurn::Off;
        say(said("S") + (turns ? words_.last("spindle") : ""));
        // A tool change may have ended what was switched on before it.
        if (at_.state.mist) say("M7");
        if (at_.state.flood) say("M8");
        approach();
        say(words_.last("F"));
        return std::move(text_);
    }

private:
    [[nodiscard]] std::string said(const std::string& group) const {
        const std::string word = words_.last(group);
        return word.empty() ? word : word + " ";
    }
    void say(std::string line) {
        while (line.ends_with(' ')) line.pop_back();
        if (!line.empty()) text_ += line + "\n";
    }
    [[nodiscard]] std::string rotaryWords() const {
        std::string out;
        for (std::size_t i = 0; i < chain_.rotaryCount(); ++i)
            if (at_.motion.start.rotary_rad[i])
                out += fmt::format(" {}{}", chain_.rotaryName(i),
                                   number(base::degFromRad(*at_.motion.start.rotary_rad[i])));
        return out;
    }
    [[nodiscard]] std::string directionWords() const {
        const nc::Vector3& axis = at_.motion.start_pose->axis;
        return fmt::format(" A3={} B3={} C3={}", number(axis.x), number(axis.y), number(axis.z));
    }
    /// The rotary axes turn while the tool is away, then over the place, and down along the tool axis.
    void approach() {
        const bool known = at_.motion.start.rotary_rad[0].has_value() || chain_.rotaryCount() == 0;
        const std::string turned = known ? rotaryWords() : at_.motion.transformation ? directionWords() : "";
        if (known && !turned.empty()) say("G0" + turned);
        if (at_.motion.transformation) {
            say("TRAORI");
            say(words_.last("offset"));
            say(said("orientation-frame") + said("orientation"));
        }
        const nc::Vector3 tip = at_.motion.path_start_mm;
        const nc::Vector3 axis = at_.motion.transformation ? at_.motion.start_pose->axis : nc::Vector3{0.0, 0.0, 1.0};
        const nc::Vector3 above = tip + options_.approach_mm * axis;
        say(fmt::format("G0 X{} Y{}{}", number(above.x), number(above.y), turned));
        say(fmt::format("Z{}", number(above.z)));
        const bool feeds = at_.motion.code != nc::MotionCode::Rapid && !words_.last("F").empty();
        say(fmt::format("{} X{} Y{} Z{}{}", feeds ? "G1 " + words_.last("F") : std::string("G0"), number(tip.x),
                        number(tip.y), number(tip.z), turned));
        if (words_.last("motion") == "G0" || words_.last("motion") == "G1") say(words_.last("motion"));
    }

    const ModalWords& words_;
    const Beginning& at_;
    const post::MachineFile& machine_;
    const ResumeOptions& options_;
    nc::ForwardChain chain_;
    std::string text_;
};

bool samePose(const std::optional<nc::ToolPose>& a, const std::optional<nc::ToolPose>& b) {
    if (!a || !b) return !a && !b;
    return norm(a->tip_mm - b->tip_mm) < same_mm && angleBetween(a->axis, b->axis) < same_rad;
}

bool sameRotary(const Beginning& a, const Beginning& b) {
    for (std::size_t i = 0; i < a.motion.start.rotary_rad.size(); ++i) {
        const auto& one = a.motion.start.rotary_rad[i];
        const auto& other = b.motion.start.rotary_rad[i];
        if (one && other && std::abs(*one - *other) > same_rad) return false;
    }
    return true;
}

/// What differs between the resumed program's beginning and the whole one's, or empty.
std::string difference(const Beginning& whole, const Beginning& resumed) {
    const nc::ModalSnapshot& a = whole.state;
    const nc::ModalSnapshot& b = resumed.state;
    if (!samePose(whole.motion.start_pose, resumed.motion.start_pose) || !sameRotary(whole, resumed)) return "place";
    if (!samePose(whole.motion.end_pose, resumed.motion.end_pose)) return "place at the end of the block";
    if (whole.motion.code != resumed.motion.code) return "kind of motion";
    if (whole.motion.transformation != resumed.motion.transformation) return "transformation";
    if (whole.motion.orientation_path != resumed.motion.orientation_path) return "orientation";
    if (a.feed.mode != b.feed.mode || a.feed.value != b.feed.value) return "feed";
    if (a.spindle != b.spindle || a.spindle_rpm != b.spindle_rpm) return "spindle";
    if (a.tool != b.tool || a.cutting_edge != b.cutting_edge) return "tool";
    if (a.mist != b.mist || a.flood != b.flood) return "coolant";
    if (a.plane != b.plane) return "plane";
    if (a.compensation != b.compensation) return "compensation";
    if (a.work_offset != b.work_offset) return "work offset";
    if (a.exact_stop != b.exact_stop) return "exact stop";
    if (a.contour_tolerance_mm != b.contour_tolerance_mm || a.orientation_tolerance_rad != b.orientation_tolerance_rad)
        return "tolerance";
    return {};
}

/// Index of the first line to be sent again: the wanted one, and those before that only move.
std::size_t backedUp(const std::vector<std::string>& lines, std::size_t wanted, unsigned blocks) {
    std::size_t first = wanted;
    while (blocks-- > 0 && first > 0 && ModalWords::onlyMoves(lines[first - 1]) && ModalWords::onlyMoves(lines[wanted]))
        --first;
    return first;
}

}  // namespace

base::Result<comm::ResumePreamble> resumePreamble(const std::string& text, const std::string& name,
                                                  const post::MachineFile& machine, const ResumeOptions& options) {
    const auto from = byteOfBlock(text, options.block);
    if (!from) return base::fail("send.no-block", fmt::format("has no block N{}", options.block), {name, 0, 0, {}});
    const std::vector<std::string> lines = linesOf(text);
    const auto wanted = static_cast<std::size_t>(std::count(text.begin(), text.begin() + *from, '\n'));
    std::size_t first = backedUp(lines, wanted, options.back_up_blocks);
    auto whole = beginningOf(text, name, machine, options.setup, first + 1);
    // The place is known from the second motion on, as a rule; further back nothing can be resumed.
    while (whole && !whole->motion.start_pose && first < wanted)
        whole = beginningOf(text, name, machine, options.setup, ++first + 1);
    if (!whole) return base::fail(std::move(whole).error());
    ModalWords words;
    for (std::size_t i = 0; i < first; ++i)
        if (const std::string wrong = words.take(lines[i]); !wrong.empty())
            return base::fail("send.resume",
                              fmt::format("{}: what comes before block N{} has to be written by hand (--preamble)",
                                          wrong, options.block),
                              {name, i + 1, 0, {}});
    const base::Location where{name, first + 1, 0, {}};
    if (words.last("dimensions") == "G91")
        return base::fail("send.resume", "incremental dimensions (G91) hold there; resume where G90 does", where);
    if (whole->state.compensation != nc::RadiusCompensation::Off)
        return base::fail("send.resume", "radius compensation is on there; resume before the block that switches it on",
                          where);
    if (!whole->motion.start_pose)
        return base::fail("send.resume", "the program alone does not say where the tool is there", where);
    comm::ResumePreamble out;
    out.text = Preamble(words, *whole, machine, options).text();
    std::size_t byte = 0;
    for (std::size_t i = 0; i < first; ++i) byte = text.find('\n', byte) + 1;
    out.from_byte = static_cast<std::uint32_t>(byte);
    out.start_block = options.block;
    const auto before = static_cast<std::size_t>(std::count(out.text.begin(), out.text.end(), '\n'));
    const auto resumed = beginningOf(out.text + text.substr(byte), name, machine, options.setup, before + 1);
    if (!resumed) return base::fail(resumed.error());
    if (const std::string differs = difference(*whole, *resumed); !differs.empty())
        return base::fail(
            "send.resume",
            fmt::format("the computed preamble does not restore the {} there: write one (--preamble)", differs), where);
    return out;
}

}  // namespace cusp::cli
