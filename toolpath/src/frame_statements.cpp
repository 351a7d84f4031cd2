// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// UNITS, MSYS, CSYS and the frames and operation names that CATIA writes as comments.
#include "head_scan.hpp"
#include "number_scan.hpp"
#include "statement_table.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace cusp::toolpath::detail {
namespace {

constexpr std::string_view catia_frame = "*CATIA0";
constexpr std::string_view own_frame = " CUSP FRAME";
constexpr std::string_view own_plane = " CUSP PLANE";

// Frames are printed with 5 to 7 decimals.
constexpr double orthonormal_tolerance = 1e-3;

/// A right-handed frame from x and y as printed, made orthonormal keeping x; nothing if they are not nearly so. Axes that
/// are orthonormal to the last bits are kept, so that a frame once read stays the same when written and read again.
std::optional<geometry::Matrix3> frameFromAxes(const geometry::Vector3& x, const geometry::Vector3& y) {
    if (!(std::abs(x.norm() - 1.0) <= orthonormal_tolerance) || !(std::abs(y.norm() - 1.0) <= orthonormal_tolerance) ||
        !(std::abs(x.dot(y)) <= orthonormal_tolerance)) {
        return std::nullopt;
    }
    constexpr double last_bits = 4e-15;
    geometry::Matrix3 frame;
    frame.col(0) = x;
    frame.col(1) = y;
    if (!(std::abs(x.norm() - 1.0) <= last_bits) || !(std::abs(y.norm() - 1.0) <= last_bits) ||
        !(std::abs(x.dot(y)) <= last_bits)) {
        frame.col(0) = x.normalized();
        frame.col(1) = frame.col(0).cross(y).normalized().cross(frame.col(0));
    }
    frame.col(2) = frame.col(0).cross(frame.col(1));
    return frame;
}

const char* unitName(double mm_per_unit) { return mm_per_unit == 1.0 ? "mm" : "inch"; }

/// Four numbers separated by blanks, one row of `$$*CATIA0`.
bool takeRow(std::string_view text, double* row) {
    for (int i = 0; i < 4; ++i) {
        text = trimmed(text);
        const char* const end = scanNumber(text.data(), text.data() + text.size(), row[i]);
        if (end == nullptr) {
            return false;
        }
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    }
    return trimmed(text).empty();
}

void cutShort(ReaderContext& context) {
    context.report.error("cl.frame",
                         fmt::format("$${} is not followed by {}the three rows of its matrix", context.frame_rows.mark,
                                     context.frame_rows.mark == catia_frame ? "a name and " : ""),
                         {context.file_name, context.frame_rows.line, 0, {}});
    context.frame_rows = FrameRows{};
}

geometry::RigidTransform transformOf(const geometry::Matrix3& rotation, const geometry::Vector3& origin_mm) {
    geometry::RigidTransform transform = geometry::RigidTransform::Identity();
    transform.linear() = rotation;
    transform.translation() = origin_mm;
    return transform;
}

/// The rotation in three rows of `R | t`, if it is one.
std::optional<geometry::Matrix3> rotationOf(const std::array<double, 12>& v) {
    const geometry::Vector3 z(v[2], v[6], v[10]);
    std::optional<geometry::Matrix3> rotation =
        frameFromAxes(geometry::Vector3(v[0], v[4], v[8]), geometry::Vector3(v[1], v[5], v[9]));
    if (rotation && !((rotation->col(2) - z).norm() <= orthonormal_tolerance)) {
        rotation.reset();
    }
    return rotation;
}

void completeFrame(ReaderContext& context) {
    const FrameRows rows = std::exchange(context.frame_rows, FrameRows{});
    const std::array<double, 12>& v = rows.values;
    const std::optional<geometry::Matrix3> rotation = rotationOf(v);
    if (!rotation) {
        context.report.error("cl.frame", fmt::format("$${}: the matrix is not a rotation with an origin", rows.mark),
                             {context.file_name, rows.line, 0, {}});
        return;
    }
    const geometry::RigidTransform transform =
        transformOf(*rotation, geometry::Vector3(v[3], v[7], v[11]) * context.mm_per_unit);
    if (rows.is_plane) {
        context.emit(WorkPlane{transform});
    } else {
        context.emit(ProgrammingFrame{transform});
    }
}

}  // namespace

void handleUnits(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    const std::optional<LengthUnit> unit = fields.size() == 1 ? lengthUnitFromWord(fields[0].text) : std::nullopt;
    if (!unit) {
        context.error("cl.unit", fmt::format("{}/{} is not understood; MM or INCHES is", word, inQuotes(body)));
        return;
    }
    if (context.unit_source == UnitSource::Unknown) {
        context.requireUnit();  // too late for the points before, and too far behind for the look-ahead
    } else if (mmPerUnitOf(*unit) != context.mm_per_unit) {
        context.error(
            "cl.unit-contradiction",
            fmt::format("{}/{}, but the file was read in {} up to here: a change of unit inside a file is not read",
                        word, fields[0].text, unitName(context.mm_per_unit)));
    } else if (context.options.mm_per_unit && *context.options.mm_per_unit != mmPerUnitOf(*unit)) {
        context.warning("cl.unit-option", fmt::format("the file says {}/{}; the unit given for it is not used", word,
                                                      inQuotes(fields[0].text)));
    }
}

void handleMsys(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    std::array<double, 9> v{};
    if (fields.size() != v.size()) {
        context.error("cl.syntax",
                      fmt::format("{} takes 9 values (origin, X and Y direction), not {}", word, fields.size()));
        return;
    }
    if (!takeNumbers(context, word, fields, 0, v.size(), v.data())) {
        return;
    }
    const std::optional<geometry::Matrix3> rotation =
        frameFromAxes(geometry::Vector3(v[3], v[4], v[5]), geometry::Vector3(v[6], v[7], v[8]));
    if (!rotation) {
        context.error("cl.frame", fmt::format("{}: the X and Y directions are not perpendicular unit vectors", word));
        return;
    }
    context.emit(ProgrammingFrame{transformOf(*rotation, geometry::Vector3(v[0], v[1], v[2]) * context.mm_per_unit)});
}

void handleCsys(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    std::array<double, 12> v{};
    if (fields.size() != v.size()) {
        context.error("cl.syntax",
                      fmt::format("{} takes 12 values (three rows of a matrix), not {}", word, fields.size()));
        return;
    }
    if (!takeNumbers(context, word, fields, 0, v.size(), v.data())) {
        return;
    }
    const std::optional<geometry::Matrix3> rotation = rotationOf(v);
    if (!rotation) {
        context.error("cl.frame", fmt::format("{}: the matrix is not a rotation with an origin", word));
        return;
    }
    // The points stay in the world frame (TRNTYP/WORLD); Z is the tool axis of the 3+2 plane.
    context.emit(WorkPlane{transformOf(*rotation, geometry::Vector3(v[3], v[7], v[11]) * context.mm_per_unit)});
    context.declared_axis = rotation->col(2);
    context.axis = context.declared_axis;
}

void handleShift(ReaderContext& context, std::string_view word, std::string_view body) {
    // Whatever a system means by it, by nothing at all nothing is shifted.
    const Fields fields(body);
    const bool nothing = !fields.empty() && !fields.truncated() &&
                         std::all_of(fields.begin(), fields.end(),
                                     [](const Field& field) { return field.is_number && field.number == 0.0; });
    if (!nothing) {
        unsupportedMotion(context, word, body);
    }
}

void handleSet(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    if (fields.size() != 2 || !fields[0].is("MODE") || !fields[1].is("ABSOL")) {
        unsupportedMotion(context, fmt::format("{}/{}", word, inQuotes(body)), body);
    }
}

void handleTrntyp(ReaderContext& context, std::string_view word, std::string_view body) {
    if (const Fields fields(body); fields.empty() || !fields[0].is("WORLD")) {
        unsupportedMotion(context, fmt::format("{}/{}", word, inQuotes(body)), body);
    }
}

void handleComment(ReaderContext& context, std::string_view comment) {
    constexpr std::string_view catia_operation = "OPERATION NAME :";
    constexpr std::string_view own_operation = "CUSP OPERATION";
    constexpr int rows = 3;
    const std::string_view text = trimmed(comment);
    const bool catia = context.dialect->comments_carry_records;
    if (catia && startsWithWord(text, catia_frame)) {
        finishFrame(context);
        context.frame_rows = FrameRows{catia_frame, false, rows + 1, context.line, {}};
    } else if (equalsWord(text, trimmed(own_frame)) || equalsWord(text, trimmed(own_plane))) {
        finishFrame(context);
        const bool is_plane = equalsWord(text, trimmed(own_plane));
        context.frame_rows = FrameRows{is_plane ? own_plane : own_frame, is_plane, rows, context.line, {}};
    } else if (int& expected = context.frame_rows.expected; expected > 0) {
        const auto row = static_cast<std::size_t>(rows - expected);
        if (expected <= rows && !takeRow(text, &context.frame_rows.values[row * 4])) {
            cutShort(context);
        } else if (--expected == 0) {
            completeFrame(context);
        }
    } else if (catia && startsWithWord(text, catia_operation)) {
        context.emit(OperationStart{std::string(trimmed(text.substr(catia_operation.size())))});
    } else if (startsWithWord(text, own_operation)) {
        context.emit(OperationStart{std::string(trimmed(text.substr(own_operation.size())))});
    }
}

void finishFrame(ReaderContext& context) {
    if (context.frame_rows.expected > 0) {
        cutShort(context);
    }
}

}  // namespace cusp::toolpath::detail
