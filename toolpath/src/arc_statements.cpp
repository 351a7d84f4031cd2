// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Arcs: CIRCLE and MOVARC before their end GOTO, CATIA's INDIRV and TLON.
#include "statement_table.hpp"

#include <cusp/base/units.hpp>

#include <algorithm>
#include <fmt/format.h>
#include <iterator>
#include <numbers>
#include <span>
#include <utility>

namespace cusp::toolpath::detail {
namespace {

using geometry::Vector3;

constexpr double full_turn_rad = 2.0 * std::numbers::pi;

void arcError(ReaderContext& context, std::uint32_t line, std::string message) {
    context.report.error("cl.arc", std::move(message), {context.file_name, line, 0, {}});
}

/// Where a point lies seen from the arc's axis.
struct OnArc {
    double height_mm;  ///< along the normal
    Vector3 radial;    ///< from the axis to the point
    double radius_mm;
};

OnArc seenFromAxis(const Vector3& point, const Vector3& center, const Vector3& normal) {
    const Vector3 from_center = point - center;
    const double height_mm = from_center.dot(normal);
    const Vector3 radial = from_center - height_mm * normal;
    return {height_mm, radial, radial.norm()};
}

/// Right-handed angle about `normal` in [0, 2π).
double sweepRad(const Vector3& from, const Vector3& to, const Vector3& normal) {
    const double angle = std::atan2(from.cross(to).dot(normal), from.dot(to));
    return angle < 0.0 ? angle + full_turn_rad : angle;
}

/// Whether start and end belong together; reports what is wrong with them.
bool isPossible(ReaderContext& context, const OpenArc& arc, const CutterLocation& end, const OnArc& start_seen,
                const OnArc& end_seen, double radius_mm) {
    constexpr double same_axis = 1e-6;
    if ((end.axis - context.axis).norm() > same_axis) {
        arcError(context, arc.line, fmt::format("{}: the tool axis turns between start and end of the arc", arc.word));
        return false;
    }
    if (!(radius_mm > arc_tolerance_mm)) {
        arcError(context, arc.line,
                 fmt::format("{}: the radius is {:.6g} mm; it must be more than {} mm", arc.word, radius_mm,
                             arc_tolerance_mm));
        return false;
    }
    const double start_error_mm = std::abs(start_seen.radius_mm - radius_mm);
    const double end_error_mm = std::abs(end_seen.radius_mm - radius_mm);
    if (!(std::max(start_error_mm, end_error_mm) <= arc_tolerance_mm)) {
        arcError(context, arc.line,
                 fmt::format("{}: the radius is {:.6g} mm, but the start lies {:.6g} mm and the end {:.6g} mm from the "
                             "centre; they may differ by {} mm",
                             arc.word, radius_mm, start_seen.radius_mm, end_seen.radius_mm, arc_tolerance_mm));
        return false;
    }
    return true;
}

/// Whether the arc turns by the angle its statement says; reports it when not. A statement whose axis points the other way
/// would say so here.
bool turnsAsStated(ReaderContext& context, const OpenArc& arc, const OnArc& start, const OnArc& end, double radius_mm,
                   bool full_circle) {
    if (!arc.sweep_rad) {
        return true;
    }
    const double sweep_rad = full_circle ? full_turn_rad : sweepRad(start.radial, end.radial, arc.normal);
    // Angles are printed with a few decimals.
    constexpr double printed_rad = base::radFromDeg(0.01);
    if (std::abs(sweep_rad - *arc.sweep_rad) <= printed_rad + 2.0 * arc_tolerance_mm / radius_mm) {
        return true;
    }
    arcError(
        context, arc.line,
        fmt::format("{}: the angle is {:.6g} degrees, but from its start to its end the arc turns by {:.6g} about its "
                    "axis",
                    arc.word, base::degFromRad(*arc.sweep_rad), base::degFromRad(sweep_rad)));
    return false;
}

/// One whole turn: the end is printed as the start is, or rounding put it a little before the start.
bool isFullCircle(const OnArc& start, const OnArc& end, const Vector3& normal) {
    constexpr double same_place_mm = 1e-9;
    const double chord_mm = (end.radial - start.radial).norm();
    return chord_mm <= same_place_mm ||
           (chord_mm <= arc_tolerance_mm && sweepRad(start.radial, end.radial, normal) > std::numbers::pi);
}

void makeArc(ReaderContext& context, const OpenArc& arc, const CutterLocation& end) {
    const OnArc start_seen = seenFromAxis(context.tip_mm, arc.center_mm, arc.normal);
    const OnArc end_seen = seenFromAxis(end.tip_mm, arc.center_mm, arc.normal);
    const double radius_mm = arc.radius_mm.value_or(start_seen.radius_mm);
    if (context.standing != Standing::AtTip) {
        arcError(context, arc.line,
                 fmt::format("{}: where the arc starts is not known: no GOTO right before it", arc.word));
    } else if (isPossible(context, arc, end, start_seen, end_seen, radius_mm)) {
        // Some systems print a centre above or below the plane; the record's lies in it.
        constexpr double in_plane_mm = 1e-9;
        Vector3 center_mm = arc.center_mm;
        if (std::abs(start_seen.height_mm) > in_plane_mm) {
            center_mm += start_seen.height_mm * arc.normal;
        }
        if (context.rapid) {
            context.warning("cl.rapid-cancelled", "RAPID before an arc: the arc is made at the feed");
        }
        const bool full_circle = isFullCircle(start_seen, end_seen, arc.normal);
        if (turnsAsStated(context, arc, start_seen, end_seen, radius_mm, full_circle)) {
            context.records.push_back({ArcMotion{end, center_mm, arc.normal, radius_mm, full_circle}, arc.line});
        }
    }
    context.rapid = false;
    context.motion_seen = true;
    context.axis = end.axis;
    context.tip_mm = end.tip_mm;
    context.standing = Standing::AtTip;
}

/// The numbers in `…(WORD/numbers)…`; empty when there are none.
Fields listBehind(std::string_view text, std::string_view word) {
    const std::size_t at = text.find(word);
    if (at == std::string_view::npos) {
        return Fields({});
    }
    const std::string_view list = text.substr(at + word.size());
    return Fields(list.substr(0, list.find(')')));
}

/// CATIA's arc as it is written.
struct DrivenArc {
    Vector3 center_mm;
    double radius_mm = 0.0;
    Vector3 line_first_mm;
    Vector3 line_second_mm;
    int intersection = 1;  ///< which meeting of circle and line ends the arc, counted along the motion
};

std::optional<DrivenArc> drivenArc(const ReaderContext& context, std::string_view body) {
    std::string text;
    std::copy_if(body.begin(), body.end(), std::back_inserter(text), [](char c) { return !isBlank(c); });
    std::transform(text.begin(), text.end(), text.begin(), upperCase);
    const std::size_t close = text.find(')');
    const std::size_t line = text.find(",(LINE/");
    if (!text.starts_with(",GOFWD/(CIRCLE/") || close >= line || line == std::string::npos || text.back() != ')') {
        return std::nullopt;
    }
    DrivenArc arc;
    const std::string until = text.substr(close + 1, line - close - 1);
    if (until == ",ON,2,INTOF") {
        arc.intersection = 2;
    } else if (until != ",ON" && until != ",ON,1,INTOF") {
        return std::nullopt;
    }
    const Fields circle = listBehind(text, "(CIRCLE/");
    const Fields points = listBehind(text, "(LINE/");
    const auto number = [](const Field& field) { return field.is_number; };
    if (circle.size() != 4 || points.size() != 6 || !std::all_of(circle.begin(), circle.end(), number) ||
        !std::all_of(points.begin(), points.end(), number)) {
        return std::nullopt;
    }
    const auto point = [&context](const Fields& f, std::size_t i) {
        return Vector3(Vector3(f[i].number, f[i + 1].number, f[i + 2].number) * context.mm_per_unit);
    };
    arc.center_mm = point(circle, 0);
    arc.radius_mm = circle[3].number * context.mm_per_unit;
    arc.line_first_mm = point(points, 0);
    arc.line_second_mm = point(points, 3);
    return arc;
}

/// Where the arc ends: the meeting of circle and line that the statement names. Reports when there is none, or when the
/// line's own end is the other one.
std::optional<Vector3> endOfDrivenArc(ReaderContext& context, const DrivenArc& arc, const Vector3& normal) {
    const Vector3 along = arc.line_second_mm - arc.line_first_mm;
    const Vector3 from_center = arc.line_first_mm - arc.center_mm;
    // |from_center + t·along| = radius
    const double a = along.squaredNorm();
    const double half_b = from_center.dot(along);
    const double c = from_center.squaredNorm() - arc.radius_mm * arc.radius_mm;
    const double discriminant = half_b * half_b - a * c;
    if (!(a > 0.0) || !(discriminant >= 0.0)) {
        arcError(context, context.line, "TLON: the line does not meet the circle");
        return std::nullopt;
    }
    const double root = std::sqrt(discriminant);
    std::array<Vector3, 2> meetings{arc.line_first_mm + (-half_b - root) / a * along,
                                    arc.line_first_mm + (-half_b + root) / a * along};
    const Vector3 start = context.tip_mm - arc.center_mm;
    const auto sweep = [&](const Vector3& point) {
        // A meeting at the start itself is reached last, after a whole turn.
        return (point - context.tip_mm).norm() <= arc_tolerance_mm ? full_turn_rad
                                                                   : sweepRad(start, point - arc.center_mm, normal);
    };
    if (sweep(meetings[1]) < sweep(meetings[0])) {
        std::swap(meetings[0], meetings[1]);
    }
    Vector3 end = meetings[static_cast<std::size_t>(arc.intersection - 1)];
    if (std::abs((arc.line_second_mm - arc.center_mm).norm() - arc.radius_mm) > arc_tolerance_mm) {
        return end;
    }
    if ((end - arc.line_second_mm).norm() <= 2.0 * arc_tolerance_mm) {
        return arc.line_second_mm;  // as printed
    }
    arcError(context, context.line,
             fmt::format("TLON: the line ends on the circle at {:.6g},{:.6g},{:.6g}, but the arc meets it first "
                         "elsewhere: where the arc ends is not clear",
                         arc.line_second_mm.x(), arc.line_second_mm.y(), arc.line_second_mm.z()));
    return std::nullopt;
}

/// What CIRCLE and MOVARC begin with: centre and axis, the first six numbers. Nothing where no arc may begin; it is reported.
/// `name` outlives the statement, as `word` does not.
std::optional<OpenArc> beginArc(ReaderContext& context, std::string_view word, const char* name,
                                std::span<const double> numbers) {
    const std::optional<Vector3> axis = unitAxis(context, word, &numbers[3]);
    if (!axis) {
        return std::nullopt;
    }
    if (context.cycle_on) {
        context.error("cl.arc", fmt::format("{} while a cycle is on is not understood", word));
        return std::nullopt;
    }
    abandonArc(context);
    OpenArc arc;
    arc.word = name;
    arc.line = context.line;
    arc.center_mm = Vector3(numbers[0], numbers[1], numbers[2]) * context.mm_per_unit;
    arc.normal = *axis;
    return arc;
}

}  // namespace

void handleCircle(ReaderContext& context, std::string_view word, std::string_view body) {
    // NX adds tolerances, tool diameter and corner radius to centre, axis and radius; SolidWorks CAM leaves out the radius.
    constexpr std::size_t least = 6;
    const Fields fields(body);
    const std::size_t most = context.dialect->dialect == Dialect::Nx ? 11 : 7;
    if (fields.size() < least || fields.size() > most) {
        context.error("cl.arc", fmt::format("{} takes {} to {} values (centre, axis, radius …), not {}{}", word, least,
                                            most, fields.size(), fields.truncated() ? " or more" : ""));
        return;
    }
    std::array<double, 11> v{};
    if (!takeNumbers(context, word, fields, 0, fields.size(), v.data())) {
        return;
    }
    std::optional<OpenArc> arc = beginArc(context, word, "CIRCLE", v);
    if (!arc) {
        return;
    }
    arc->normal *= context.dialect->circle_axis_sign;
    if (fields.size() > least) {
        arc->radius_mm = v[6] * context.mm_per_unit;
    }
    context.arc = arc;
}

void handleMovarc(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    std::array<double, 7> v{};
    std::optional<double> angle_deg;
    std::size_t count = 0;
    bool understood = !fields.truncated();
    for (std::size_t i = 0; i < fields.size() && understood; ++i) {
        const Field& field = fields[i];
        const bool number_follows = i + 1 < fields.size() && fields[i + 1].is_number;
        if (field.is_number) {
            understood = count < v.size();
            v[std::min(count++, v.size() - 1)] = field.number;
        } else if (field.is("ANGLE") && number_follows && count == v.size()) {
            angle_deg = fields[++i].number;
        } else {
            // The words that may stand before centre, axis and radius.
            understood = number_follows && ((field.is("CENTER") && count == 0) || (field.is("AXIS") && count == 3) ||
                                            (field.is("RADIUS") && count == 6));
        }
    }
    if (!understood || count != v.size()) {
        context.error("cl.arc",
                      fmt::format("{}/{} is not understood; centre, axis, radius and ANGLE are", word, inQuotes(body)));
        return;
    }
    std::optional<OpenArc> arc = beginArc(context, word, "MOVARC", v);
    if (!arc) {
        return;
    }
    arc->radius_mm = v[6] * context.mm_per_unit;
    if (angle_deg) {
        arc->sweep_rad = base::radFromDeg(*angle_deg);
    }
    context.arc = arc;
}

void completeArc(ReaderContext& context, const CutterLocation& end) {
    const OpenArc arc = *context.arc;
    context.arc.reset();
    makeArc(context, arc, end);
}

void abandonArc(ReaderContext& context) {
    if (context.arc) {
        arcError(context, context.arc->line,
                 fmt::format("{} is not followed by a GOTO that says where the arc ends", context.arc->word));
        context.arc.reset();
    }
}

void handleIndirv(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    std::array<double, 3> v{};
    if (fields.size() != v.size()) {
        context.error("cl.syntax", fmt::format("{} takes 3 values, not {}", word, fields.size()));
    } else if (takeNumbers(context, word, fields, 0, v.size(), v.data())) {
        context.first_sense = unitAxis(context, word, v.data());
    }
}

void handleTlon(ReaderContext& context, std::string_view word, std::string_view body) {
    abandonArc(context);
    const std::optional<DrivenArc> driven = drivenArc(context, body);
    const std::optional<Vector3> sense = std::exchange(context.first_sense, std::nullopt);
    if (!driven) {
        context.error("cl.unsupported-motion",
                      fmt::format("'{}{}' is not understood; {},GOFWD/(CIRCLE/centre,radius),ON,(LINE/…) is", word,
                                  inQuotes(body), word));
        return;
    }
    if (!sense || context.standing != Standing::AtTip || context.cycle_on) {
        context.error("cl.arc", fmt::format("{}: the arc needs a GOTO and an INDIRV before it, and no cycle", word));
        return;
    }
    const Vector3 start = context.tip_mm - driven->center_mm;
    const Vector3 turn = start.cross(*sense);
    // INDIRV is the tangent at the start; a vector that points at the centre says nothing about the plane.
    constexpr double least_sine = 0.1;
    if (!(turn.norm() > least_sine * start.norm())) {
        context.error("cl.arc",
                      fmt::format("{}: INDIRV points along the radius: the sense of the arc is not clear", word));
        return;
    }
    const Vector3 normal = turn.normalized();
    context.requireUnit();
    context.settleTool();
    if (const std::optional<Vector3> end = endOfDrivenArc(context, *driven, normal)) {
        makeArc(context, {"TLON", context.line, driven->center_mm, normal, driven->radius_mm, std::nullopt},
                {*end, context.axis});
    }
}

}  // namespace cusp::toolpath::detail
