// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// FEDRAT, SPINDL, COOLNT, DELAY, STOP: what the machine does besides moving.
#include "feed_unit.hpp"
#include "head_scan.hpp"
#include "statement_table.hpp"

#include <cusp/base/units.hpp>

#include <fmt/format.h>

namespace cusp::toolpath::detail {
namespace {

/// A feed's unit word contradicts the unit that an earlier feed word implied for the whole file.
void checkImpliedUnit(ReaderContext& context, std::string_view feed_word, LengthUnit unit) {
    if (context.unit_source != UnitSource::Implied || context.unit_reported ||
        mmPerUnitOf(unit) == context.mm_per_unit) {
        return;
    }
    context.unit_reported = true;
    context.error(
        "cl.unit-contradiction",
        fmt::format("FEDRAT in {}, but the first feed of the file made its unit {}: the unit of the points is "
                    "not clear; say which with --units mm or --units inch",
                    feed_word, context.mm_per_unit == 1.0 ? "mm" : "inch"));
}

}  // namespace

std::optional<FeedUnit> feedUnit(ReaderContext& context, const Field& field) {
    const bool per_rev = field.is("MMPR") || field.is("IPR") || field.is("PERREV");
    const FeedRate::Unit unit = per_rev ? FeedRate::Unit::MmPerRev : FeedRate::Unit::MmPerS;
    if (const std::optional<LengthUnit> length = lengthUnitFromFeedWord(field.text)) {
        checkImpliedUnit(context, field.text, *length);
        return FeedUnit{mmPerUnitOf(*length), unit};
    }
    if (field.is("PERMIN") || field.is("PERREV")) {
        return FeedUnit{context.mm_per_unit, unit};
    }
    return std::nullopt;
}

FeedRate feedRate(double value, const FeedUnit& unit) {
    const double feed = value * unit.mm_per_unit;
    return {unit.unit == FeedRate::Unit::MmPerS ? base::mmPerSFromMmPerMin(feed) : feed, unit.unit};
}

void handleFedrat(ReaderContext& context, std::string_view word, std::string_view body) {
    std::optional<double> value;
    FeedUnit unit{context.mm_per_unit, FeedRate::Unit::MmPerS};
    const Fields fields(body);
    for (const Field& field : fields) {
        if (field.is_number && !value) {
            value = field.number;
        } else if (const std::optional<FeedUnit> stated = field.is_number ? std::nullopt : feedUnit(context, field)) {
            unit = *stated;
        } else {
            context.error("cl.feed", fmt::format("{}: '{}' is not understood", word, inQuotes(field.text)));
            return;
        }
    }
    if (!value || !(*value > 0.0)) {
        context.error("cl.feed", value ? fmt::format("{}: a feed of {} is not possible", word, *value)
                                       : fmt::format("{}: the feed is missing", word));
        return;
    }
    if (context.rapid) {
        context.rapid = false;
        context.warning("cl.rapid-cancelled",
                        "FEDRAT follows RAPID before any GOTO: the next move is made at this feed");
    }
    context.emit(feedRate(*value, unit));
}

void handleSpindl(ReaderContext& context, std::string_view word, std::string_view body) {
    constexpr double m_per_foot = 0.3048;
    SpindleCommand command;
    std::optional<double> speed;
    double factor = 1.0;
    bool off = false;
    std::optional<SpindleCommand::Turn> turn;
    const Field* gear = nullptr;  ///< the word RANGE; its value comes next
    const Fields fields(body);
    for (const Field& field : fields) {
        if (gear != nullptr && gear == &field - 1) {
            context.warning("cl.spindle",
                            fmt::format("{}: the gear range {} is left to the machine", word, inQuotes(field.text)));
        } else if (field.is_number && !speed) {
            speed = field.number;
        } else if (field.is("RPM") || field.is("ON")) {
        } else if (field.is("SFM") || field.is("SMM")) {
            command.unit = SpindleCommand::Unit::SurfaceMPerMin;
            factor = field.is("SFM") ? m_per_foot : 1.0;
        } else if (field.is("CLW") || field.is("CCLW")) {
            turn = field.is("CLW") ? SpindleCommand::Turn::Clockwise : SpindleCommand::Turn::CounterClockwise;
        } else if (field.is("OFF")) {
            off = true;
        } else if (field.is("RANGE") && gear == nullptr && &field + 1 != fields.end()) {
            gear = &field;
        } else {
            context.error("cl.spindle", fmt::format("{}: '{}' is not understood", word, inQuotes(field.text)));
            return;
        }
    }
    if (fields.empty() || (speed && !(*speed >= 0.0)) || (off && speed)) {
        context.error("cl.spindle", fmt::format("{}/{} is not understood", word, inQuotes(body)));
        return;
    }
    context.callOwedTool();
    context.last_turn = turn.value_or(context.last_turn);
    command.turn = off ? SpindleCommand::Turn::Off : context.last_turn;
    if (speed) {
        command.speed = *speed * factor;
        context.spindle_rpm = command.unit == SpindleCommand::Unit::Rpm ? command.speed : std::nullopt;
    }
    context.emit(command);
}

void handleCoolnt(ReaderContext& context, std::string_view word, std::string_view body) {
    using Kind = CoolantCommand::Kind;
    const Fields fields(body);
    std::optional<Kind> kind;
    // FLOOD,ON and ON,FLOOD say the same as FLOOD.
    const bool with_on = fields.size() == 2 && (fields[0].is("ON") || fields[1].is("ON"));
    if (fields.size() == 1 || with_on) {
        const Field& field = fields[with_on && fields[0].is("ON") ? 1 : 0];
        if (field.is("OFF") && !with_on) {
            kind = Kind::Off;
        } else if (field.is("ON") || field.is("FLOOD")) {
            kind = Kind::Flood;
        } else if (field.is("MIST")) {
            kind = Kind::Mist;
        } else if (field.is("THRU") || field.is("THROUGH")) {
            kind = Kind::Through;
        }
    }
    if (!kind) {
        const std::string message =
            fmt::format("{}/{} is not understood; the coolant stays as it is", word, inQuotes(body));
        if (context.options.strict) {
            context.error("cl.coolant", message);
        } else {
            context.warning("cl.coolant", message);
        }
        return;
    }
    context.callOwedTool();
    context.emit(CoolantCommand{*kind});
}

void handleDelay(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    const bool word_first = fields.size() == 2 && !fields[0].is_number;
    const std::size_t number_at = word_first ? 1 : 0;
    const std::size_t word_at = word_first ? 0 : 1;
    const bool revolutions = fields.size() == 2 && fields[word_at].is("REV");
    const bool seconds_word = fields.size() == 2 && fields[word_at].is("SEC");
    if (fields.empty() || fields.size() > 2 || (fields.size() == 2 && !revolutions && !seconds_word) ||
        !fields[number_at].is_number || !(fields[number_at].number >= 0.0)) {
        context.error("cl.delay", fmt::format("{}/{} is not understood; seconds, or revolutions with REV, are", word,
                                              inQuotes(body)));
        return;
    }
    double seconds = fields[number_at].number;
    if (revolutions) {
        if (!context.spindle_rpm || !(*context.spindle_rpm > 0.0)) {
            context.error("cl.delay", fmt::format("{} in revolutions, but no spindle speed in RPM holds here", word));
            return;
        }
        seconds = seconds * 60.0 / *context.spindle_rpm;
    }
    context.emit(Dwell{seconds});
}

void handleTolerance(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    if (fields.size() != 1 || !fields[0].is_number || !(fields[0].number >= 0.0)) {
        const std::string message = fmt::format("{}/{} is not understood and is passed over", word, inQuotes(body));
        if (context.options.strict) {
            context.error("cl.tolerance", message);
        } else {
            context.warning("cl.tolerance", message);
        }
        return;
    }
    context.emit(PathTolerance{word == "OUTTOL", fields[0].number * context.mm_per_unit});
}

void handleStop(ReaderContext& context, std::string_view word, std::string_view /*body*/) {
    context.emit(ProgramStop{word == "OPSTOP"});
}

}  // namespace cusp::toolpath::detail
