// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// UNITS, MSYS, CSYS and the frames and operation names that CATIA writes as comments.
#include "head_scan.hpp"
#include "number_scan.hpp"
#include "statement_table.hpp"

#include <fmt/format.h>

namespace cusp::toolpath::detail {
namespace {

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

void emitFrame(ReaderContext& context, const geometry::Matrix3& rotation, const geometry::Vector3& origin) {
    ProgrammingFrame frame;
    frame.part_from_programming.linear() = rotation;
    frame.part_from_programming.translation() = origin * context.mm_per_unit;
    context.emit(frame);
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
    context.report.error("cl.frame", "$$*CATIA0 is not followed by a name and the three rows of its matrix",
                         {context.file_name, context.frame_rows.line, 0, {}});
    context.frame_rows = FrameRows{};
}

void completeFrame(ReaderContext& context) {
    const std::array<double, 12>& v = context.frame_rows.values;
    const geometry::Vector3 z(v[2], v[6], v[10]);
    const std::optional<geometry::Matrix3> rotation =
        frameFromAxes(geometry::Vector3(v[0], v[4], v[8]), geometry::Vector3(v[1], v[5], v[9]));
    if (!rotation || !((rotation->col(2) - z).norm() <= orthonormal_tolerance)) {
        context.report.error("cl.frame", "$$*CATIA0: the matrix is not a rotation with an origin",
                             {context.file_name, context.frame_rows.line, 0, {}});
        return;
    }
    emitFrame(context, *rotation, geometry::Vector3(v[3], v[7], v[11]));
}

}  // namespace

void handleUnits(ReaderContext& context, std::string_view word, std::string_view body) {
    const Fields fields(body);
    const std::optional<LengthUnit> unit = fields.size() == 1 ? lengthUnitFromWord(fields[0].text) : std::nullopt;
    if (!unit) {
        context.error("cl.unit", fmt::format("{}/{} is not understood; MM or INCHES is", word, quoted(body)));
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
                                                      quoted(fields[0].text)));
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
    emitFrame(context, *rotation, geometry::Vector3(v[0], v[1], v[2]));
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
    const std::optional<geometry::Matrix3> rotation =
        frameFromAxes(geometry::Vector3(v[0], v[4], v[8]), geometry::Vector3(v[1], v[5], v[9]));
    if (!rotation || !((rotation->col(2) - geometry::Vector3(v[2], v[6], v[10])).norm() <= orthonormal_tolerance)) {
        context.error("cl.frame", fmt::format("{}: the matrix is not a rotation with an origin", word));
        return;
    }
    // The points stay in the world frame (TRNTYP/WORLD); Z is the tool axis of the 3+2 plane.
    WorkPlane plane;
    plane.programming_from_plane.linear() = *rotation;
    plane.programming_from_plane.translation() = geometry::Vector3(v[3], v[7], v[11]) * context.mm_per_unit;
    context.emit(plane);
    context.declared_axis = rotation->col(2);
    context.axis = context.declared_axis;
}

void handleTrntyp(ReaderContext& context, std::string_view word, std::string_view body) {
    if (const Fields fields(body); fields.empty() || !fields[0].is("WORLD")) {
        unsupportedMotion(context, fmt::format("{}/{}", word, quoted(body)), body);
    }
}

void handleComment(ReaderContext& context, std::string_view comment) {
    constexpr std::string_view frame_mark = "*CATIA0";
    constexpr std::string_view operation_mark = "OPERATION NAME :";
    const std::string_view text = trimmed(comment);
    if (startsWithWord(text, frame_mark)) {
        finishFrame(context);
        context.frame_rows = FrameRows{4, context.line, {}};
        return;
    }
    if (int& expected = context.frame_rows.expected; expected > 0) {
        constexpr int rows = 3;
        const auto row = static_cast<std::size_t>(rows - expected);
        if (expected <= rows && !takeRow(text, &context.frame_rows.values[row * 4])) {
            cutShort(context);
        } else if (--expected == 0) {
            completeFrame(context);
        }
        return;
    }
    if (startsWithWord(text, operation_mark)) {
        context.emit(OperationStart{std::string(trimmed(text.substr(operation_mark.size())))});
    }
}

void finishFrame(ReaderContext& context) {
    if (context.frame_rows.expected > 0) {
        cutShort(context);
    }
}

}  // namespace cusp::toolpath::detail
