// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the statement handlers share: the modal state of the file being read, and where records and problems go.
#pragma once

#include "dialect.hpp"
#include "fields.hpp"
#include "statement.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::toolpath::detail {

/// What is known of where the tool is.
enum class Standing : std::uint8_t {
    Unknown,   ///< at no place the file has named
    AtTip,     ///< its tip at `ReaderContext::tip_mm`
    AboveHole  ///< somewhere above the hole at `tip_mm`
};

/// An arc whose end is still to come.
struct OpenArc {
    std::string_view word;  ///< of the statement, for messages
    std::uint32_t line = 0;
    geometry::Vector3 center_mm = geometry::Vector3::Zero();
    geometry::Vector3 normal = geometry::Vector3::UnitZ();  ///< as ArcMotion::normal
    std::optional<double> radius_mm;
    std::optional<double> sweep_rad;  ///< when the statement says it
};

enum class UnitSource : std::uint8_t { Unknown, Stated, Option, Implied };

/// The rows of a frame that the dialect writes as comments, while they are being collected.
struct FrameRows {
    std::string_view mark;  ///< the comment that announced them
    bool is_plane = false;  ///< of a WorkPlane, not of a ProgrammingFrame
    int expected = 0;       ///< lines still to come; more than 3 when a name is the first
    std::uint32_t line = 0;
    std::array<double, 12> values{};
};

/// What is known of the tool to be called next.
struct ToolDescription {
    std::optional<std::int64_t> number;
    std::string name;
    std::optional<geometry::Cutter> cutter;
    bool fresh = false;      ///< something was said of it since the last call
    bool noted = false;      ///< that the tool moves although the one described was not called was reported
    bool call_owed = false;  ///< the file changed the tool without a LOAD statement so far

    /// The next motion is an ordinary one as far as the tool goes.
    [[nodiscard]] bool isSettled() const { return !call_owed && (!fresh || noted); }
};

struct ReaderContext {
    ClReaderOptions options;
    std::string file_name;
    base::Diagnostics report;
    const DialectTraits* dialect = nullptr;
    double mm_per_unit = 1.0;
    UnitSource unit_source = UnitSource::Unknown;

    /// Records made and not yet handed out; `taken` of them are gone.
    std::vector<ClRecord> records;
    std::size_t taken = 0;
    std::uint32_t line = 0;  ///< of the statement in hand

    geometry::Vector3 axis = geometry::Vector3::UnitZ();           ///< of the last GOTO
    geometry::Vector3 declared_axis = geometry::Vector3::UnitZ();  ///< by TLAXIS
    geometry::Vector3 tip_mm = geometry::Vector3::Zero();          ///< of the last GOTO, GODLTA or FROM
    Standing standing = Standing::Unknown;
    std::optional<OpenArc> arc;                    ///< the next GOTO is its end
    std::optional<geometry::Vector3> first_sense;  ///< INDIRV
    std::optional<ClRecord> spline;                ///< NURBS, whose KNOT and CNTRL may follow
    bool cycle_on = false;                         ///< a GOTO is a hole
    CutterCompensation::Side compensation = CutterCompensation::Side::Off;
    bool multax = false;
    bool rapid = false;  ///< RAPID was read; the next GOTO is it
    bool motion_seen = false;
    bool unit_reported = false;
    bool program_begun = false;  ///< a known statement was read
    bool preamble_noted = false;
    bool path_ended = false;     ///< behind END-OF-PATH: free text may follow
    bool program_ended = false;  ///< behind FINI or END
    bool stopped = false;        ///< a problem ended the read
    std::optional<double> spindle_rpm;
    SpindleCommand::Turn last_turn = SpindleCommand::Turn::Clockwise;
    ToolDescription tool;
    std::optional<std::int64_t> loaded_number;
    FrameRows frame_rows;

    [[nodiscard]] base::Location here() const { return {file_name, line, 0, {}}; }
    void error(std::string_view code, std::string message) { report.error(code, std::move(message), here()); }
    void warning(std::string_view code, std::string message) { report.warning(code, std::move(message), here()); }
    /// A problem after which nothing can be understood.
    void stop(std::string_view code, std::string message) {
        error(code, std::move(message));
        stopped = true;
    }

    void emit(ClStatement statement) { records.push_back({std::move(statement), line}); }

    /// A GOTO here is a straight move and nothing else.
    [[nodiscard]] bool gotoIsPlain() const {
        return motion_seen && !program_ended && !arc && !spline && !cycle_on && frame_rows.expected == 0 &&
               tool.isSettled();
    }

    /// A length of the file in mm. Reports once when the file's unit is not known.
    void requireUnit();

    /// Before a motion: calls the owed tool, or reports that a tool was described but not called.
    void settleTool();

    /// Hands out the tool call that a new tool name or a new cutter owes, before the first thing done with the tool.
    void callOwedTool();
};

/// Text of the file as a message shows it: not more than 60 bytes of it.
[[nodiscard]] std::string inQuotes(std::string_view text);

/// Copies the numbers `first`… of the fields; reports `WORD: 'x' is not a number` and answers false otherwise.
[[nodiscard]] bool takeNumbers(ReaderContext& context, std::string_view word, const Fields& fields, std::size_t first,
                               std::size_t count, double* out);

/// `v` made a unit vector; one that is so within the last bits is kept as it is, so that what was once normalised
/// stays the same however often it is written and read.
[[nodiscard]] inline geometry::Vector3 normalisedOnce(const geometry::Vector3& v, double length) {
    constexpr double last_bits = 1e-15;
    return std::abs(length - 1.0) <= last_bits ? v : geometry::Vector3(v / length);
}

/// A unit vector from three numbers printed with a few decimals; reports `cl.axis` when the length is not 1 within 1e-3.
[[nodiscard]] std::optional<geometry::Vector3> unitAxis(ReaderContext& context, std::string_view word,
                                                        const double* ijk);

}  // namespace cusp::toolpath::detail
