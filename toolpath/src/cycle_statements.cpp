// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// CYCLE in the words of CATIA, NX and SolidWorks CAM, and CUTCOM.
#include "feed_unit.hpp"
#include "statement_table.hpp"

#include <array>
#include <fmt/format.h>
#include <vector>

namespace cusp::toolpath::detail {
namespace {

using Kind = CycleStart::Kind;

struct CycleWord {
    std::string_view word;
    Kind kind;
};
// SolidWorks CAM's DEEP2 has a first peck and further ones; REAM goes in and out at the feed, which is Bore here.
constexpr std::array<CycleWord, 7> cycle_words{{{"DRILL", Kind::Drill},
                                                {"DEEP", Kind::Deep},
                                                {"DEEP2", Kind::Deep},
                                                {"BRKCHP", Kind::BreakChip},
                                                {"BORE", Kind::Bore},
                                                {"REAM", Kind::Bore},
                                                {"TAP", Kind::Tap}}};

std::optional<Kind> kindOf(const Field& field) {
    for (const CycleWord& entry : cycle_words) {
        if (field.is(entry.word)) {
            return entry.kind;
        }
    }
    return std::nullopt;
}

/// Collects a cycle field by field; the first problem is reported and ends it.
class CycleParser {
public:
    CycleParser(ReaderContext& context, std::string_view word, const Fields& fields)
        : context_(context), word_(word), fields_(fields) {}

    [[nodiscard]] bool parse(Kind kind) {
        cycle_.kind = kind;
        while (ok_ && at_ < fields_.size()) {
            takeField();
        }
        if (ok_) {
            assignPositions();
        }
        return ok_ && check();
    }
    [[nodiscard]] const CycleStart& cycle() const { return cycle_; }

private:
    void takeField();
    void takeFeed(const FeedUnit& unit);
    void takeRetract(bool is_return);
    void takeDwell();
    void assignPositions();
    [[nodiscard]] bool check();

    void fail(const std::string& message) {
        if (ok_) {
            context_.error("cl.cycle", fmt::format("{}: {}", word_, message));
        }
        ok_ = false;
    }
    /// The number behind the keyword in hand.
    double number(std::string_view keyword) {
        if (at_ < fields_.size() && fields_[at_].is_number) {
            return fields_[at_++].number;
        }
        fail(fmt::format("a number is expected behind {}", keyword));
        return 0.0;
    }
    double length(std::string_view keyword) { return number(keyword) * context_.mm_per_unit; }

    ReaderContext& context_;
    std::string_view word_;
    const Fields& fields_;
    std::size_t at_ = 1;
    bool ok_ = true;
    bool has_depth_ = false;
    CycleStart cycle_;
    std::vector<double> positions_;            ///< numbers without a keyword
    std::optional<FeedUnit> positional_unit_;  ///< of the second of them
};

void CycleParser::takeField() {
    const Field& field = fields_[at_++];
    if (field.is_number) {
        positions_.push_back(field.number);
    } else if (field.is("DEPTH") || field.is("FEDTO")) {
        // NX counts FEDTO as a height, the others as a depth.
        const double sign = field.is("FEDTO") && context_.dialect->dialect == Dialect::Nx ? -1.0 : 1.0;
        cycle_.depth_mm = sign * length(field.text);
        has_depth_ = true;
    } else if ((field.is("CLEAR") || field.is("RAPTO")) && !cycle_.clearance_mm) {
        cycle_.clearance_mm = length(field.text);
    } else if (field.is("RTRCTO") || field.is("RETURN")) {
        takeRetract(field.is("RETURN"));
    } else if (field.is("1STPECK")) {
        cycle_.first_peck_mm = length(field.text);
    } else if (field.is("SUBPECK") || field.is("STEP")) {
        cycle_.peck_mm = length(field.text);
    } else if (field.is("PITCH")) {
        cycle_.feed = FeedRate{length(field.text), FeedRate::Unit::MmPerRev};
    } else if (field.is("DWELL")) {
        takeDwell();
    } else if (at_ == 2 && cycle_.kind == Kind::Drill && (field.is("DEEP") || field.is("BRKCHP"))) {
        cycle_.kind = field.is("DEEP") ? Kind::Deep : Kind::BreakChip;  // NX: CYCLE/DRILL,DEEP
    } else if (const std::optional<FeedUnit> unit = feedUnit(context_, field)) {
        takeFeed(*unit);
    } else {
        fail(fmt::format("'{}' is not understood", inQuotes(field.text)));
    }
}

/// The unit of the feed before it where depth and feed came without keywords, else of the feed behind it.
void CycleParser::takeFeed(const FeedUnit& unit) {
    if (positions_.size() >= 2) {
        positional_unit_ = unit;
    } else {
        cycle_.feed = feedRate(number("the feed's unit"), unit);
    }
}

void CycleParser::takeRetract(bool is_return) {
    if (at_ < fields_.size() && fields_[at_].is("AUTO")) {
        ++at_;
        return;
    }
    const double height_mm = length("the retract word");
    if (!is_return || height_mm != 0.0) {
        cycle_.retract_mm = height_mm;  // CATIA's RETURN,0 goes back to the clearance
    }
}

void CycleParser::takeDwell() {
    const bool word_first = at_ < fields_.size() && fields_[at_].is("REV");
    at_ += word_first ? 1U : 0U;
    double dwell = number("DWELL");
    const bool word_last = at_ < fields_.size() && fields_[at_].is("REV");
    at_ += word_last ? 1U : 0U;
    if (word_first || word_last) {
        if (!context_.spindle_rpm || !(*context_.spindle_rpm > 0.0)) {
            fail("DWELL in revolutions, but no spindle speed in RPM holds here");
            return;
        }
        dwell = dwell * 60.0 / *context_.spindle_rpm;
    }
    if (dwell != 0.0) {
        cycle_.dwell_s = dwell;
    }
}

/// Numbers without keywords are, in this order, the depth, the feed, the clearance; two of them without a unit are depth
/// and clearance (inferred from CATIA files: the clearance is where the tool waits above the hole).
void CycleParser::assignPositions() {
    std::size_t next = 0;
    const double unit = context_.mm_per_unit;
    if (!has_depth_ && next < positions_.size()) {
        cycle_.depth_mm = positions_[next++] * unit;
    }
    const std::size_t left = positions_.size() - next;
    if (!cycle_.feed && (left == 2 || (left == 1 && positional_unit_))) {
        cycle_.feed = feedRate(positions_[next++], positional_unit_.value_or(FeedUnit{unit, FeedRate::Unit::MmPerS}));
    }
    if (!cycle_.clearance_mm && next < positions_.size()) {
        cycle_.clearance_mm = positions_[next++] * unit;
    }
    if (next < positions_.size()) {
        fail("more numbers than depth, feed and clearance");
    }
}

bool CycleParser::check() {
    const bool pecks = cycle_.kind == Kind::Deep || cycle_.kind == Kind::BreakChip;
    if (cycle_.first_peck_mm && !cycle_.peck_mm) {
        cycle_.peck_mm = cycle_.first_peck_mm;
    }
    if (!(cycle_.depth_mm > 0.0)) {
        fail(fmt::format("the depth must lie below the hole's location; it is {:.6g} mm", cycle_.depth_mm));
    } else if (cycle_.clearance_mm && !(*cycle_.clearance_mm >= 0.0)) {
        fail(fmt::format("the clearance {:.6g} mm lies below the hole's location", *cycle_.clearance_mm));
    } else if (cycle_.retract_mm && *cycle_.retract_mm < cycle_.clearance_mm.value_or(0.0)) {
        fail(fmt::format("the retract height {:.6g} mm lies below the clearance", *cycle_.retract_mm));
    } else if (cycle_.feed && !(cycle_.feed->value > 0.0)) {
        fail("the feed must be more than 0");
    } else if (cycle_.dwell_s && !(*cycle_.dwell_s > 0.0)) {
        fail("a dwell cannot be negative");
    } else if (pecks && !(cycle_.peck_mm && *cycle_.peck_mm > 0.0 && cycle_.first_peck_mm.value_or(1.0) > 0.0)) {
        fail("drilling in pecks needs the size of the peck");
    } else if (!pecks && cycle_.peck_mm) {
        fail("a peck is given, but this cycle goes to depth at once");
    }
    return ok_;
}

}  // namespace

void handleCycle(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    if (fields.size() == 1 && fields[0].is("OFF")) {
        if (context.cycle_on) {
            context.cycle_on = false;
            context.emit(CycleEnd{});
        }
        return;
    }
    if (context.dialect->dialect == Dialect::SolidWorksCam && fields.size() == 1 && fields[0].is("INIT")) {
        return;  // announces the cycle that follows
    }
    const std::optional<Kind> kind = fields.empty() ? std::nullopt : kindOf(fields[0]);
    const std::string name = fields.empty() ? std::string(word) : fmt::format("{}/{}", word, inQuotes(fields[0].text));
    if (!kind) {
        unsupportedMotion(context, name, body);
        return;
    }
    abandonArc(context);
    context.requireUnit();
    CycleParser parser(context, name, fields);
    const bool understood = parser.parse(*kind);
    context.cycle_on = true;  // the locations are holes either way
    if (understood) {
        context.callOwedTool();
        context.emit(parser.cycle());
    }
}

void handleCutcom(ReaderContext& context, std::string_view word, std::string_view body) {
    using Side = CutterCompensation::Side;
    const Fields fields(body);
    CutterCompensation command;
    if (fields.size() == 1 && fields[0].is("OFF")) {
        if (context.compensation == Side::Off) {
            return;
        }
    } else if (!fields.empty() && fields.size() <= 2 && (fields[0].is("LEFT") || fields[0].is("RIGHT"))) {
        command.side = fields[0].is("LEFT") ? Side::Left : Side::Right;
        if (fields.size() == 2) {
            constexpr double most = 1e6;
            const double number = fields[1].number;
            if (!fields[1].is_number || number < 0.0 || number > most || number != std::floor(number)) {
                context.error("cl.cutcom",
                              fmt::format("{}: '{}' is not the number of an offset", word, inQuotes(fields[1].text)));
                return;
            }
            command.offset_number = static_cast<std::int64_t>(number);
        }
    } else {
        unsupportedMotion(context, fields.empty() ? std::string(word) : fmt::format("{}/{}", word, inQuotes(body)),
                          body);
        return;
    }
    context.compensation = command.side;
    context.emit(command);
}

}  // namespace cusp::toolpath::detail
