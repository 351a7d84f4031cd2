// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// GOTO and its relatives, and what decides how the next GOTO is to be taken: RAPID, FROM, TLAXIS, MULTAX.
#include "number_scan.hpp"
#include "statement_table.hpp"

#include <fmt/format.h>

namespace cusp::toolpath::detail {
namespace {

/// Up to 6 comma-separated numbers and nothing else; their count, or 0.
std::size_t scanCoordinates(std::string_view body, std::array<double, 6>& values) {
    const char* p = body.data();
    const char* const last = p + body.size();
    for (std::size_t count = 0; count < values.size();) {
        while (p != last && isBlank(*p)) {
            ++p;
        }
        p = scanNumber(p, last, values[count]);
        if (p == nullptr) {
            return 0;
        }
        ++count;
        while (p != last && isBlank(*p)) {
            ++p;
        }
        if (p == last) {
            return count;
        }
        if (*p++ != ',') {
            return 0;
        }
    }
    return 0;
}

/// The axis of the last GOTO is also the one a GOTO with three values has.
bool axisIsClear(const ReaderContext& context) {
    return context.dialect->axis_rule == AxisRule::Modal || context.multax || context.axis == context.declared_axis;
}

/// The axis of a GOTO with three values.
std::optional<geometry::Vector3> impliedAxis(ReaderContext& context) {
    if (context.dialect->axis_rule == AxisRule::Modal || context.multax) {
        return context.axis;
    }
    // Without MULTAX the declared axis holds. If the points before it were given with another one, the file means
    // something that is not known here.
    constexpr double same_axis = 1e-6;
    if ((context.axis - context.declared_axis).norm() > same_axis) {
        context.error(
            "cl.axis",
            "GOTO has 3 values, but the GOTO before it had a tool axis other than TLAXIS and MULTAX is not on: "
            "which axis holds here is not clear");
        return std::nullopt;
    }
    return context.declared_axis;
}

LinearMotion motionTo(ReaderContext& context, const geometry::Vector3& tip_mm) {
    LinearMotion motion;
    motion.location.tip_mm = tip_mm;
    motion.location.axis = context.axis;
    motion.kind = context.rapid ? MotionKind::Rapid : MotionKind::Feed;
    context.rapid = false;
    context.motion_seen = true;
    context.tip_mm = tip_mm;
    context.standing = Standing::AtTip;
    return motion;
}

/// A point with all that can be on: a hole where a cycle is, the end of an arc, else a straight move.
void goTo(ReaderContext& context, const geometry::Vector3& tip_mm, const geometry::Vector3& axis) {
    context.requireUnit();
    context.settleTool();
    if (context.arc) {
        completeArc(context, {tip_mm, axis});
        return;
    }
    context.axis = axis;
    const LinearMotion motion = motionTo(context, tip_mm);
    if (context.cycle_on) {
        context.standing = Standing::AboveHole;
        context.emit(HoleLocation{motion.location});
    } else {
        context.emit(motion);
    }
}

/// FROM's or GOTO's 3 or 6 numbers.
std::size_t takePose(ReaderContext& context, std::string_view word, std::string_view body,
                     std::array<double, 6>& values) {
    const Fields fields(body);
    if (fields.size() != 3 && fields.size() != 6) {
        context.error("cl.syntax", fmt::format("{} takes 3 values (point) or 6 (point and tool axis), not {}{}", word,
                                               fields.size(), fields.truncated() ? " or more" : ""));
        return 0;
    }
    return takeNumbers(context, word, fields, 0, fields.size(), values.data()) ? fields.size() : 0;
}

geometry::Vector3 pointOf(const ReaderContext& context, const std::array<double, 6>& values) {
    return geometry::Vector3(values[0], values[1], values[2]) * context.mm_per_unit;
}

}  // namespace

bool readPlainGoto(ReaderContext& context, std::string_view body, LinearMotion& motion) {
    std::array<double, 6> values;
    const std::size_t count = scanCoordinates(body, values);
    if (count == 6) {
        constexpr double length_tolerance = 1e-3;
        const geometry::Vector3 axis(values[3], values[4], values[5]);
        const double length = axis.norm();
        if (!(std::abs(length - 1.0) <= length_tolerance)) {
            return false;
        }
        context.axis = normalisedOnce(axis, length);
    } else if (count != 3 || !axisIsClear(context)) {
        return false;
    }
    motion = motionTo(context, pointOf(context, values));
    return true;
}

void handleGoto(ReaderContext& context, std::string_view word, std::string_view body) {
    std::array<double, 6> values{};
    const std::size_t count = takePose(context, word, body, values);
    if (count == 0) {
        return;
    }
    const std::optional<geometry::Vector3> axis =
        count == 6 ? unitAxis(context, word, &values[3]) : impliedAxis(context);
    if (axis) {
        goTo(context, pointOf(context, values), *axis);
    }
}

void handleGodlta(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    std::array<double, 3> values{};
    if (fields.size() != 1 && fields.size() != 3) {
        context.error("cl.syntax", fmt::format("{} takes 3 values (step) or 1 (step along the tool axis), not {}", word,
                                               fields.size()));
        return;
    }
    if (!takeNumbers(context, word, fields, 0, fields.size(), values.data())) {
        return;
    }
    if (context.standing == Standing::Unknown) {
        context.error("cl.start-unknown",
                      fmt::format("{}: where the tool stands is not known: no GOTO or FROM before it", word));
        return;
    }
    abandonArc(context);
    const geometry::Vector3 step = fields.size() == 1 ? geometry::Vector3(values[0] * context.axis)
                                                      : geometry::Vector3(values[0], values[1], values[2]);
    goTo(context, context.tip_mm + step * context.mm_per_unit, context.axis);
}

void handleGohome(ReaderContext& context, std::string_view word, std::string_view body) {
    if (!trimmed(body).empty()) {
        context.error("cl.syntax", fmt::format("{} with values is not understood", word));
        return;
    }
    abandonArc(context);
    context.rapid = false;
    context.standing = Standing::Unknown;
    context.emit(HomeReturn{});
}

void handleRapid(ReaderContext& context, std::string_view word, std::string_view body) {
    if (const Fields fields(body); !fields.empty()) {
        context.error("cl.syntax",
                      fmt::format("{} with values is not understood; RAPID alone makes the next GOTO rapid", word));
        return;
    }
    context.rapid = true;
}

void handleFrom(ReaderContext& context, std::string_view word, std::string_view body) {
    std::array<double, 6> values{};
    const std::size_t count = takePose(context, word, body, values);
    if (count == 0) {
        return;
    }
    if (count == 6) {
        const std::optional<geometry::Vector3> axis = unitAxis(context, word, &values[3]);
        if (!axis) {
            return;
        }
        context.axis = *axis;
    }
    abandonArc(context);
    context.requireUnit();
    context.tip_mm = pointOf(context, values);
    context.standing = Standing::AtTip;
    context.emit(StartPosition{{context.tip_mm, context.axis}});
}

void handleTlaxis(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    std::array<double, 3> values{};
    if (fields.size() != 3) {
        context.error("cl.syntax", fmt::format("{} takes 3 values, not {}", word, fields.size()));
        return;
    }
    if (!takeNumbers(context, word, fields, 0, 3, values.data())) {
        return;
    }
    if (const std::optional<geometry::Vector3> axis = unitAxis(context, word, values.data())) {
        context.declared_axis = *axis;
        context.axis = *axis;
    }
}

void handleMultax(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    if (fields.size() > 1 || (fields.size() == 1 && !fields[0].is("ON") && !fields[0].is("OFF"))) {
        context.error("cl.syntax", fmt::format("{}/{} is not understood; ON, OFF or nothing is", word, inQuotes(body)));
        return;
    }
    context.multax = fields.empty() || fields[0].is("ON");
    if (!context.multax) {
        context.axis = context.declared_axis;
    }
}

}  // namespace cusp::toolpath::detail
