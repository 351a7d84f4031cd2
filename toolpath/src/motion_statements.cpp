// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// GOTO and what decides how the next GOTO is to be taken: RAPID, FROM, TLAXIS, MULTAX.
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

LinearMotion motionTo(ReaderContext& context, const std::array<double, 6>& values) {
    LinearMotion motion;
    motion.location.tip_mm = geometry::Vector3(values[0], values[1], values[2]) * context.mm_per_unit;
    motion.location.axis = context.axis;
    motion.kind = context.rapid ? MotionKind::Rapid : MotionKind::Feed;
    context.rapid = false;
    context.motion_seen = true;
    return motion;
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
        context.axis = axis / length;
    } else if (count != 3 || !axisIsClear(context)) {
        return false;
    }
    motion = motionTo(context, values);
    return true;
}

void handleGoto(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    if (fields.size() != 3 && fields.size() != 6) {
        context.error("cl.syntax", fmt::format("{} takes 3 values (point) or 6 (point and tool axis), not {}{}", word,
                                               fields.size(), fields.truncated() ? " or more" : ""));
        return;
    }
    std::array<double, 6> values{};
    if (!takeNumbers(context, word, fields, 0, fields.size(), values.data())) {
        return;
    }
    const std::optional<geometry::Vector3> axis =
        fields.size() == 6 ? unitAxis(context, word, &values[3]) : impliedAxis(context);
    if (!axis) {
        return;
    }
    context.axis = *axis;
    context.requireUnit();
    context.settleTool();
    context.emit(motionTo(context, values));
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
    // Where the tool is said to stand before the first move. It moves nothing, but its axis counts for what follows.
    const Fields fields(body);
    std::array<double, 6> values{};
    if (fields.size() != 3 && fields.size() != 6) {
        context.error("cl.syntax",
                      fmt::format("{} takes 3 values (point) or 6 (point and tool axis), not {}", word, fields.size()));
    } else if (takeNumbers(context, word, fields, 0, fields.size(), values.data()) && fields.size() == 6) {
        context.axis = unitAxis(context, word, &values[3]).value_or(context.axis);
    }
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
        context.error("cl.syntax", fmt::format("{}/{} is not understood; ON, OFF or nothing is", word, quoted(body)));
        return;
    }
    context.multax = fields.empty() || fields[0].is("ON");
    if (!context.multax) {
        context.axis = context.declared_axis;
    }
}

void handleOnlyOff(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    if (fields.size() == 1 && fields[0].is("OFF")) {
        return;  // nothing of the kind can be on: switching it on is an error
    }
    unsupportedMotion(context, fields.empty() ? std::string(word) : fmt::format("{}/{}", word, quoted(fields[0].text)),
                      body);
}

}  // namespace cusp::toolpath::detail
