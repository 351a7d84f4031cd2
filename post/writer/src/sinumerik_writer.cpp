// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Spells NC steps as Sinumerik 840D blocks: PM12 = Siemens Programming Manual Fundamentals 12/2019, PGA = Job Planning.
#include <cusp/post/writer/sinumerik_writer.hpp>

#include "fixed_number.hpp"
#include "hole_cycle_call.hpp"

#include <cusp/base/units.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string_view>

namespace cusp::post {

using toolpath::CoolantCommand;
using toolpath::FeedRate;
using toolpath::MotionKind;
using toolpath::SpindleCommand;

namespace {

constexpr std::size_t flush_bytes = 1U << 16U;
// An 840D block holds 512 characters; comments and messages are cut well before.
constexpr std::size_t text_limit = 120;

/// 840D strings and comments take printable ASCII; a double quote would end the string.
std::string printable(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (out.size() == text_limit) break;
        const bool plain = c >= ' ' && c <= '~' && c != '"';
        out.push_back(plain ? c : '_');
    }
    return out;
}

/// An address of several letters, or one that ends in a digit, needs "=" before its value (PM12).
bool needsEquals(std::string_view address) { return address.size() > 1; }

}  // namespace

struct SinumerikWriter::State {
    State(TextSink text_sink, const MachineFile& machine_file, ProgramHead program_head)
        : out(std::move(text_sink)), file(machine_file), head(std::move(program_head)) {
        for (const std::string& name : file.machine.axisNames())
            if (file.machine.rotary.contains(name)) rotary_names.push_back(name);
        if (head.work_offset.empty()) head.work_offset = file.control.work_offset;
        linear_decimals = static_cast<int>(file.control.format.linear_decimals);
        rotary_decimals = static_cast<int>(file.control.format.rotary_decimals);
        vector_decimals = static_cast<int>(file.control.format.vector_decimals);
    }

    TextSink out;
    const MachineFile& file;
    ProgramHead head;
    std::vector<std::string> rotary_names;
    int linear_decimals = 5;
    int rotary_decimals = 5;
    int vector_decimals = 6;
    bool vectors = false;  ///< the tool axis is told as A3, B3, C3

    std::string buffer;
    std::size_t first_word = 0;  ///< where the words of the open block begin
    std::size_t blocks = 0;

    // What the control already knows, in print; empty after anything that moves the axes in another frame.
    std::array<std::optional<std::int64_t>, 3> linear;
    std::array<std::optional<std::int64_t>, 2> rotary;
    std::optional<std::array<std::int64_t, 3>> vector;
    std::optional<std::int64_t> feed;
    std::string_view feed_mode;  ///< G93, G94, G95
    std::optional<int> motion_code;

    // --- one block ---
    void openBlock() {
        if (const auto step = file.control.block_number_step; step > 0) {
            buffer += 'N';
            appendFixed(buffer, static_cast<std::int64_t>(blocks + 1) * step, 0);
        }
        first_word = buffer.size();
    }
    void word(std::string_view text) {
        if (!buffer.empty() && buffer.back() != '\n') buffer += ' ';
        buffer += text;
    }
    void value(std::string_view address, std::int64_t fixed, int decimals) {
        word(address);
        if (needsEquals(address)) buffer += '=';
        appendFixed(buffer, fixed, decimals);
    }
    /// Closes the block, or takes it back when it holds no word.
    void closeOrDrop() {
        if (buffer.size() > first_word) return closeBlock();
        const std::size_t line = buffer.rfind('\n');
        buffer.erase(line == std::string::npos ? 0 : line + 1);
    }
    void closeBlock() {
        buffer += '\n';
        ++blocks;
        if (buffer.size() >= flush_bytes) flush();
    }
    void flush() {
        out(buffer);
        buffer.clear();
    }
    void block(std::string_view text) {
        openBlock();
        word(text);
        closeBlock();
    }
    void comment(std::string_view text) { buffer += "; " + printable(text) + '\n'; }

    // --- modal words ---
    void forgetPosition() {
        linear = {};
        rotary = {};
        vector.reset();
        motion_code.reset();
    }
    void motionCode(int code) {
        if (motion_code == code) return;
        motion_code = code;
        static constexpr std::array<std::string_view, 4> names{"G0", "G1", "G2", "G3"};
        word(names[static_cast<std::size_t>(code)]);
    }
    void linearWord(std::size_t axis, double mm) {
        static constexpr std::array<std::string_view, 3> names{"X", "Y", "Z"};
        const std::int64_t fixed = toFixed(mm, linear_decimals);
        if (linear[axis] == fixed) return;
        linear[axis] = fixed;
        value(names[axis], fixed, linear_decimals);
    }
    void rotaryWords(const RotaryValues& rotary_rad) {
        for (std::size_t i = 0; i < rotary_names.size(); ++i) {
            const std::int64_t fixed = toFixed(base::degFromRad(rotary_rad[i]), rotary_decimals);
            if (rotary[i] == fixed) continue;
            rotary[i] = fixed;
            value(rotary_names[i], fixed, rotary_decimals);
        }
    }
    /// A component left out would be 0, so a direction is told whole.
    void vectorWords(const geometry::Vector3& axis) {
        const std::array<std::int64_t, 3> fixed{toFixed(axis.x(), vector_decimals), toFixed(axis.y(), vector_decimals),
                                                toFixed(axis.z(), vector_decimals)};
        if (vector == fixed) return;
        vector = fixed;
        static constexpr std::array<std::string_view, 3> names{"A3", "B3", "C3"};
        for (std::size_t i = 0; i < fixed.size(); ++i) value(names[i], fixed[i], vector_decimals);
    }
    template <class Motion>
    void orientationWords(const Motion& item) {
        if (vectors)
            vectorWords(item.axis);
        else
            rotaryWords(item.rotary_rad);
    }
    /// Another kind of feed makes the old F meaningless.
    void feedMode(std::string_view mode) {
        if (feed_mode == mode) return;
        feed_mode = mode;
        feed.reset();
        word(mode);
    }
    void feedMode(const FeedRate& rate) { feedMode(rate.unit == FeedRate::Unit::MmPerRev ? "G95" : "G94"); }
    void feedWord(const FeedRate& rate) {
        const int decimals = static_cast<int>(file.control.format.feed_decimals);
        const double written =
            rate.unit == FeedRate::Unit::MmPerRev ? rate.value : base::mmPerMinFromMmPerS(rate.value);
        const std::int64_t fixed = toFixed(written, decimals);
        if (feed == fixed) return;
        feed = fixed;
        value("F", fixed, decimals);
    }
    /// Under G93 every block has its own F; six digits of it hold the feed to a millionth.
    void inverseTimeWord(double per_min) {
        constexpr int digits = 6;
        const int whole = static_cast<int>(std::ceil(std::log10(per_min)));
        const int decimals = std::clamp(digits - whole, 0, 9);
        feed.reset();
        value("F", toFixed(per_min, decimals), decimals);
    }

    // --- items ---
    void write(const Comment& item) { comment(item.text); }

    void write(const ModalStart&) {
        block(file.control.start_codes);
        feed_mode = {};
        if (!rotary_names.empty()) block("TRAFOOF");
    }

    void write(const GoHome&) {
        forgetPosition();
        openBlock();
        word("SUPA G0");
        homeWord(file.control.retract_axis);
        word("D0");
        closeBlock();
        openBlock();
        word("SUPA G0");
        for (const std::string& name : file.machine.axisNames())
            if (name != file.control.retract_axis) homeWord(name);
        word("D0");
        closeBlock();
    }
    void homeWord(const std::string& name) {
        if (const auto it = file.machine.linear.find(name); it != file.machine.linear.end())
            value(name, toFixed(it->second.home_mm, linear_decimals), linear_decimals);
        else
            value(name, toFixed(base::degFromRad(file.machine.rotary.at(name).home_rad), rotary_decimals),
                  rotary_decimals);
    }

    void write(const ChangeTool& item) {
        if (item.name.empty())
            block("T" + std::to_string(item.number.value_or(0)));
        else
            block("T=\"" + printable(item.name) + "\"");
        block("M6");
        block("D1");
    }

    void write(const Smoothing& item) {
        using Cycle832 = ControlDefinition::Cycle832;
        if (file.control.cycle832 == Cycle832::None) return;
        if (!item.on) return block("CYCLE832()");
        std::string text = "CYCLE832(";
        appendFixed(text, toFixed(file.control.cycle832_tolerance_mm, 6), 6);
        if (file.control.cycle832 == Cycle832::UpTo44) {
            text += ",1,1)";
        } else {
            text += ",_ORI_FINISH,";
            appendFixed(text, toFixed(base::degFromRad(file.control.cycle832_orientation_tolerance_rad), 6), 6);
            text += ')';
        }
        block(text);
    }

    void write(const ScreenMessage& item) { block("MSG(\"" + printable(item.text) + "\")"); }

    void write(const SelectWorkOffset& item) {
        block(item.name.empty() ? head.work_offset : item.name);
        linear = {};
    }

    void write(const Spindle& item) {
        if (item.turn == SpindleCommand::Turn::Off) return block("M5");
        const int decimals = static_cast<int>(file.control.format.speed_decimals);
        openBlock();
        value("S", toFixed(item.speed_rpm, decimals), decimals);
        word(item.turn == SpindleCommand::Turn::Clockwise ? "M3" : "M4");
        closeBlock();
    }

    void write(const Coolant& item) {
        switch (item.kind) {
            case CoolantCommand::Kind::Off: return block("M9");
            case CoolantCommand::Kind::Mist: return block("M7");
            case CoolantCommand::Kind::Flood:
            case CoolantCommand::Kind::Through: return block("M8");
        }
    }

    void write(const PositionRotary& item) {
        openBlock();
        motionCode(0);
        rotaryWords(item.rotary_rad);
        closeBlock();
    }

    void write(const TipProgramming& item) {
        if (rotary_names.empty()) return;
        block(item.on ? "TRAORI" : "TRAFOOF");
        forgetPosition();
        vectors = item.on && item.vectors;
        if (!item.on) return;
        // TRAORI drops the frame; the offset is called again behind it.
        block(item.work_offset.empty() ? head.work_offset : item.work_offset);
        // MD21104 decides which of the two groups acts (PGA p. 7-7); vectors are always read in the frame of ORIWKS.
        const bool by_group_51 = file.control.md21104_ori_ipo_with_g_code;
        if (item.vectors)
            block(by_group_51 ? "ORIWKS ORIVECT" : "ORIWKS");
        else
            block(by_group_51 ? "ORIAXES" : "ORIMKS");
    }

    void write(const AxisProgramming& item) {
        std::string text = "positions for tool length ";
        const auto add = [&](double mm) { appendFixed(text, toFixed(mm, 4), 4); };
        add(item.tool_length_mm);
        text += " mm, work offset at X";
        add(item.wcs_origin_mm.x());
        text += " Y";
        add(item.wcs_origin_mm.y());
        text += " Z";
        add(item.wcs_origin_mm.z());
        comment(text + " in the machine");
        vectors = false;
    }

    void write(const Approach& item) {
        openBlock();
        motionCode(0);
        linearWord(0, item.point_mm.x());
        linearWord(1, item.point_mm.y());
        orientationWords(item);
        closeBlock();
        openBlock();
        if (item.kind == MotionKind::Feed) feedMode(item.feed);
        motionCode(item.kind == MotionKind::Rapid ? 0 : 1);
        linearWord(2, item.point_mm.z());
        if (item.kind == MotionKind::Feed) feedWord(item.feed);
        closeBlock();
    }

    void write(const Move& item) {
        const bool timed = item.moves_per_min > 0.0;
        openBlock();
        if (item.kind == MotionKind::Feed) {
            if (timed)
                feedMode("G93");
            else
                feedMode(item.feed);
        }
        const std::size_t before = buffer.size();
        motionCode(item.kind == MotionKind::Rapid ? 0 : 1);
        for (std::size_t axis = 0; axis < 3; ++axis) linearWord(axis, item.point_mm[static_cast<Eigen::Index>(axis)]);
        orientationWords(item);
        if (timed && buffer.size() > before)
            inverseTimeWord(item.moves_per_min);
        else if (item.kind == MotionKind::Feed && !timed)
            feedWord(item.feed);
        // A point that equals the last one in print: the machine has nothing to do.
        closeOrDrop();
    }

    void write(const ArcMove& item) {
        openBlock();
        feedMode(item.feed);
        motionCode(item.clockwise ? 2 : 3);
        // A full circle ends where it starts: its end point is printed whether it changed or not.
        linear[0].reset();
        linear[1].reset();
        linearWord(0, item.end_mm.x());
        linearWord(1, item.end_mm.y());
        linearWord(2, item.end_mm.z());
        value("I", toFixed(item.center_from_start_mm.x(), linear_decimals), linear_decimals);
        value("J", toFixed(item.center_from_start_mm.y(), linear_decimals), linear_decimals);
        if (!vectors) rotaryWords(item.rotary_rad);
        feedWord(item.feed);
        closeBlock();
    }

    /// Modal call of a drilling cycle; the feed is the one that holds (840D sl Programming Manual Job Planning, cycles).
    void write(const HoleCycle& item) {
        openBlock();
        feedMode(item.feed);
        feedWord(item.feed);
        closeOrDrop();
        block("MCALL " + holeCycleCall(item, linear_decimals));
        motion_code.reset();
    }
    void write(const HolePosition& item) {
        openBlock();
        motionCode(0);
        linear[0].reset();
        linear[1].reset();
        linearWord(0, item.x_mm);
        linearWord(1, item.y_mm);
        if (!vectors) rotaryWords(item.rotary_rad);
        closeBlock();
        // The cycle leaves the tool at its retract height.
        linear[2].reset();
    }
    void write(const HoleCycleOff&) {
        block("MCALL");
        forgetPosition();
    }

    void write(const Pause& item) {
        openBlock();
        word("G4");
        value("F", toFixed(item.seconds, 3), 3);
        closeBlock();
    }
    void write(const Stop& item) { block(item.optional ? "M1" : "M0"); }
    void write(const End&) { block("M30"); }
};

SinumerikWriter::SinumerikWriter(TextSink out, const MachineFile& file, const ProgramHead& head)
    : state_(std::make_unique<State>(std::move(out), file, head)) {
    state_->comment(head.program_name);
    for (const std::string& line : head.comments) state_->comment(line);
}

SinumerikWriter::~SinumerikWriter() = default;

void SinumerikWriter::step(const NcStep& step) {
    std::visit([this](const auto& item) { state_->write(item); }, step.item);
}

std::size_t SinumerikWriter::finish() {
    state_->flush();
    return state_->blocks;
}

}  // namespace cusp::post
