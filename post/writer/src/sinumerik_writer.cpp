// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Spells NC steps as Sinumerik 840D blocks: PM12 = Siemens Programming Manual Fundamentals 12/2019, PGA = Job Planning.
#include <cusp/post/writer/sinumerik_writer.hpp>

#include "block_writer.hpp"
#include "hole_cycle_call.hpp"

#include <cusp/base/units.hpp>

#include <optional>

namespace cusp::post {

using toolpath::CoolantCommand;
using toolpath::CutterCompensation;
using toolpath::FeedRate;
using toolpath::MotionKind;
using toolpath::SpindleCommand;

namespace {

std::vector<std::string> rotaryNames(const machine::MachineDefinition& machine) {
    std::vector<std::string> names;
    for (const std::string& name : machine.axisNames())
        if (machine.rotary.contains(name)) names.push_back(name);
    return names;
}

std::string_view feedModeOf(const FeedRate& rate) { return rate.unit == FeedRate::Unit::MmPerRev ? "G95" : "G94"; }

}  // namespace

struct SinumerikWriter::State {
    State(TextSink text_sink, const MachineFile& machine_file, ProgramHead program_head, BlockListener listener)
        : file(machine_file),
          head(std::move(program_head)),
          text(std::move(text_sink), file.control, rotaryNames(file.machine), std::move(listener)) {
        if (head.work_offset.empty()) head.work_offset = file.control.work_offset;
    }

    /// How the tool axis is told.
    enum class Orientation : std::uint8_t { Rotary, Vectors, Plane };

    const MachineFile& file;
    ProgramHead head;
    BlockWriter text;
    Orientation orientation = Orientation::Rotary;
    std::optional<RadiusCompensation> compensation;  ///< for the next straight block
    std::int64_t told_edge = 1;                      ///< D

    [[nodiscard]] bool hasRotary() const { return !text.rotaryNames().empty(); }
    [[nodiscard]] const std::string& offsetName(const std::string& name) const {
        return name.empty() ? head.work_offset : name;
    }

    template <class Motion>
    void orientationWords(const Motion& item) {
        if (orientation == Orientation::Rotary) text.rotary(item.rotary_rad);
        if (orientation == Orientation::Vectors) text.vector(item.axis);
    }
    void feedWords(const FeedRate& rate) {
        text.feedMode(feedModeOf(rate));
        text.feed(rate);
    }

    // --- around the motions ---
    void write(const Comment& item) { text.comment(item.text); }
    void write(const Literal& item) {
        text.block(item.text);
        text.forgetMotionCode();
    }
    void write(const ModalStart&) {
        text.block(file.control.start_codes);
        text.forgetMotionCode();
        text.forgetFeed();
    }

    void write(const GoHome&) {
        told_edge = 1;  // approaches choose it
        text.forgetPosition();
        for (const std::string& block : file.control.sequence.home)
            text.block(expandPlaceholders(block, [this](std::string_view name) { return homeWords(name); }));
        text.forgetPosition();
    }
    [[nodiscard]] std::string homeWords(std::string_view name) const {
        std::string words;
        for (const std::string& axis : file.machine.axisNames()) {
            const bool retracts = axis == file.control.retract_axis;
            if (name == "retract_axis" ? !retracts : name == "other_axes" ? retracts : axis != name) continue;
            if (!words.empty()) words += ' ';
            words += axis;
            if (axis.size() > 1) words += '=';
            if (const auto linear = file.machine.linear.find(axis); linear != file.machine.linear.end())
                appendFixed(words, toFixed(linear->second.home_mm, text.linearDecimals()), text.linearDecimals());
            else
                appendFixed(words,
                            toFixed(base::degFromRad(file.machine.rotary.at(axis).home_rad), text.rotaryDecimals()),
                            text.rotaryDecimals());
        }
        return words;
    }

    void write(const ChangeTool& item) {
        if (item.name.empty())
            text.block("T" + std::to_string(item.number.value_or(0)));
        else
            text.block("T=\"" + printableText(item.name) + "\"");
        text.forgetPosition();
    }

    void write(const Smoothing& item) {
        using Cycle832 = ControlDefinition::Cycle832;
        if (file.control.cycle832 == Cycle832::None) return;
        if (!item.on) return text.block("CYCLE832()");
        std::string call = "CYCLE832(";
        appendFixed(call, toFixed(file.control.cycle832_tolerance_mm, 6), 6);
        if (file.control.cycle832 == Cycle832::UpTo44) {
            call += ",1,1)";
        } else {
            call += ",_ORI_FINISH,";
            appendFixed(call, toFixed(base::degFromRad(file.control.cycle832_orientation_tolerance_rad), 6), 6);
            call += ')';
        }
        text.block(call);
    }

    void write(const ScreenMessage& item) { text.block("MSG(\"" + printableText(item.text) + "\")"); }

    void write(const SelectWorkOffset& item) {
        text.block(offsetName(item.name));
        text.forgetLinear();
    }

    void write(const Spindle& item) {
        if (item.turn == SpindleCommand::Turn::Off) return text.block("M5");
        text.open();
        text.speed(item.speed_rpm);
        text.word(item.turn == SpindleCommand::Turn::Clockwise ? "M3" : "M4");
        text.close();
    }

    void write(const Coolant& item) {
        switch (item.kind) {
            case CoolantCommand::Kind::Off: return text.block("M9");
            case CoolantCommand::Kind::Mist: return text.block("M7");
            case CoolantCommand::Kind::Flood:
            case CoolantCommand::Kind::Through: return text.block("M8");
        }
    }

    void write(const Pause& item) {
        text.open();
        text.word("G4");
        text.value("F", toFixed(item.seconds, 3), 3);
        text.close();
    }
    void write(const Stop& item) { text.block(item.optional ? "M1" : "M0"); }

    // --- how points are programmed ---
    void write(const PositionRotary& item) {
        text.open();
        text.motionCode(0);
        text.rotary(item.rotary_rad);
        text.closeOrDrop();
    }

    void write(const TipProgramming& item) {
        if (!hasRotary()) return text.forgetPosition();
        text.block(item.on ? "TRAORI" : "TRAFOOF");
        text.forgetPosition();
        orientation = item.on && item.vectors ? Orientation::Vectors : Orientation::Rotary;
        if (!item.on) return;
        // TRAORI drops the frame; the offset is called again behind it.
        text.block(offsetName(item.work_offset));
        // MD21104 decides which of the two groups acts (PGA p. 7-7); vectors are always read in the frame of ORIWKS.
        const bool by_group_51 = file.control.md21104_ori_ipo_with_g_code;
        if (item.vectors)
            text.block(by_group_51 ? "ORIWKS ORIVECT" : "ORIWKS");
        else
            text.block(by_group_51 ? "ORIAXES" : "ORIMKS");
        rotaryFeedReference();
    }
    /// FGREF acts in blocks that only turn (PM12 p112).
    void rotaryFeedReference() {
        if (!file.control.fgref_mm) return;
        text.open();
        for (const std::string& name : text.rotaryNames()) {
            std::string word = "FGREF[" + name + "]=";
            appendFixed(word, toFixed(*file.control.fgref_mm, 4), 4);
            text.word(word);
        }
        text.close();
    }

    void write(const AxisProgramming& item) {
        std::string note = "positions for tool length ";
        const auto add = [&](double mm) { appendFixed(note, toFixed(mm, 4), 4); };
        add(item.tool_length_mm);
        note += " mm, work offset at X";
        add(item.wcs_origin_mm.x());
        note += " Y";
        add(item.wcs_origin_mm.y());
        note += " Z";
        add(item.wcs_origin_mm.z());
        text.comment(note + " in the machine");
        text.forgetPosition();
        orientation = Orientation::Rotary;
        rotaryFeedReference();
    }

    /// _FR, _TC, _ST, _MODE, X0 Y0 Z0, A B C, X1 Y1 Z1, _DIR, _FR_I, _DMODE; mode 57 turns about X, the new Y, the new Z.
    void write(const TiltedPlane& item) {
        const SwivelDefinition& swivel = file.control.swivel;
        std::string call = "CYCLE800(" + std::to_string(swivel.retract) + ",\"" + swivel.data_set + "\"," +
                           std::to_string(swivel.status) + ",57";
        const auto add = [&](double value, int decimals) {
            call += ',';
            appendFixed(call, toFixed(value, decimals), decimals);
        };
        for (Eigen::Index i = 0; i < 3; ++i) add(item.origin_mm[i], text.linearDecimals());
        for (const double angle : item.angles_rad) add(base::degFromRad(angle), text.rotaryDecimals());
        call += ",0,0,0," + std::to_string(swivel.direction) + ",0," + std::to_string(swivel.display) + ')';
        text.block(call);
        text.forgetPosition();
        orientation = Orientation::Plane;
    }
    void write(const PlaneOff&) {
        text.block("CYCLE800()");
        text.forgetPosition();
        orientation = Orientation::Rotary;
    }

    // --- motions ---
    void write(const RadiusCompensation& item) { compensation = item; }
    void compensationWords() {
        if (!compensation) return;
        const auto side = compensation->side;
        text.word(side == CutterCompensation::Side::Off    ? "G40"
                  : side == CutterCompensation::Side::Left ? "G41"
                                                           : "G42");
        // The D of the compensation is the edge of the whole tool: behind it the first one holds again.
        const bool off = side == CutterCompensation::Side::Off;
        const std::int64_t edge = off ? 1 : compensation->offset_number.value_or(told_edge);
        if (edge != told_edge) {
            text.value("D", edge, 0);
            text.forgetLinear();
        }
        told_edge = edge;
        compensation.reset();
    }

    void write(const Approach& item) {
        text.open();
        text.motionCode(0);
        text.linear(0, item.point_mm.x());
        text.linear(1, item.point_mm.y());
        orientationWords(item);
        text.close();
        text.open();
        if (item.kind == MotionKind::Feed) text.feedMode(feedModeOf(item.feed));
        text.motionCode(item.kind == MotionKind::Rapid ? 0 : 1);
        text.linear(2, item.point_mm.z());
        if (item.kind == MotionKind::Feed) text.feed(item.feed);
        text.close();
    }

    void write(const Move& item) {
        const bool feeds = item.kind == MotionKind::Feed;
        const bool timed = item.moves_per_min > 0.0;
        text.open();
        compensationWords();
        if (feeds) text.feedMode(timed ? "G93" : feedModeOf(item.feed));
        const std::size_t before = text.size();
        text.motionCode(feeds ? 1 : 0);
        text.points(item.point_mm);
        orientationWords(item);
        if (feeds && !timed)
            text.feed(item.feed);
        else if (timed && text.size() > before)
            text.inverseTime(item.moves_per_min);
        // A point that equals the last one in print: the machine has nothing to do.
        text.closeOrDrop();
    }

    void write(const ArcMove& item) {
        const bool timed = item.moves_per_min > 0.0;
        text.open();
        text.feedMode(timed ? "G93" : feedModeOf(item.feed));
        text.motionCode(item.clockwise ? 2 : 3);
        // A full circle ends where it starts: its end point is printed whether it changed or not.
        text.forgetLinear(0);
        text.forgetLinear(1);
        text.points(item.end_mm);
        text.coordinate("I", item.center_from_start_mm.x());
        text.coordinate("J", item.center_from_start_mm.y());
        if (orientation == Orientation::Rotary) text.rotary(item.rotary_rad);
        if (timed)
            text.inverseTime(item.moves_per_min);
        else
            text.feed(item.feed);
        text.close();
    }

    /// Modal call of a drilling cycle; the feed is the one that holds (840D sl Programming Manual Job Planning, cycles).
    void write(const HoleCycle& item) {
        text.open();
        feedWords(item.feed);
        text.closeOrDrop();
        text.block("MCALL " + holeCycleCall(item, text.linearDecimals()));
        text.forgetMotionCode();
    }
    void write(const HolePosition& item) {
        text.open();
        text.motionCode(0);
        text.forgetLinear(0);
        text.forgetLinear(1);
        text.linear(0, item.x_mm);
        text.linear(1, item.y_mm);
        if (orientation == Orientation::Rotary) text.rotary(item.rotary_rad);
        text.close();
        // The cycle leaves the tool at its retract height.
        text.forgetLinear(2);
    }
    void write(const HoleCycleOff&) {
        text.block("MCALL");
        text.forgetPosition();
    }
};

SinumerikWriter::SinumerikWriter(TextSink out, const MachineFile& file, const ProgramHead& head, BlockListener listener)
    : state_(std::make_unique<State>(std::move(out), file, head, std::move(listener))) {
    if (head.comments.empty()) state_->text.comment(head.program_name);
    for (const std::string& line : head.comments) state_->text.comment(line);
}

SinumerikWriter::~SinumerikWriter() = default;

void SinumerikWriter::step(const NcStep& step) {
    state_->text.setClLine(step.cl_line);
    std::visit([this](const auto& item) { state_->write(item); }, step.item);
}

std::size_t SinumerikWriter::finish() {
    state_->text.flush();
    return state_->text.blocks();
}

}  // namespace cusp::post
