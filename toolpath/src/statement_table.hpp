// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Word → what is done with it: the one place that says which statements the reader knows.
#pragma once

#include "reader_context.hpp"

#include <string_view>

namespace cusp::toolpath::detail {

/// `word` is the statement's leading word in upper case, `body` the text behind its slash.
using Handler = void (*)(ReaderContext& context, std::string_view word, std::string_view body);

struct StatementEntry {
    std::string_view word;
    Handler handler;
    DialectSet dialects = every_dialect;
    /// The word may be followed by other things than a slash; they are the body then.
    bool any_form = false;
};

/// Null when the dialect has no such statement.
[[nodiscard]] const StatementEntry* findStatement(std::string_view word, Dialect dialect);

/// For words that move the tool, or change where it goes, in ways not read so far: always an error.
void unsupportedMotion(ReaderContext& context, std::string_view word, std::string_view body);
/// A statement that no table entry knows.
void unknownStatement(ReaderContext& context, const StatementHead& head, std::string_view text);

// motion_statements.cpp
/// The body of a GOTO of 3 or 6 numbers, in one pass without fields. False when it is anything else, with nothing changed
/// or reported: `handleGoto` then says what is wrong.
[[nodiscard]] bool readPlainGoto(ReaderContext& context, std::string_view body, LinearMotion& motion);
void handleGoto(ReaderContext& context, std::string_view word, std::string_view body);
void handleRapid(ReaderContext& context, std::string_view word, std::string_view body);
void handleFrom(ReaderContext& context, std::string_view word, std::string_view body);
void handleTlaxis(ReaderContext& context, std::string_view word, std::string_view body);
void handleMultax(ReaderContext& context, std::string_view word, std::string_view body);
void handleGodlta(ReaderContext& context, std::string_view word, std::string_view body);
void handleGohome(ReaderContext& context, std::string_view word, std::string_view body);

// arc_statements.cpp
/// NX, SolidWorks CAM, plain APT: centre, axis, radius; the GOTO that follows is the end.
void handleCircle(ReaderContext& context, std::string_view word, std::string_view body);
void handleIndirv(ReaderContext& context, std::string_view word, std::string_view body);
/// CATIA: `TLON,GOFWD/(CIRCLE/centre,radius),ON,(LINE/point,point)`.
void handleTlon(ReaderContext& context, std::string_view word, std::string_view body);
/// Creo and others: `MOVARC/centre,axis,radius,ANGLE,degrees` or with CENTER, AXIS, RADIUS; then the end GOTO.
void handleMovarc(ReaderContext& context, std::string_view word, std::string_view body);
/// The GOTO behind CIRCLE was read: makes the arc, or reports why there is none.
void completeArc(ReaderContext& context, const CutterLocation& end);
/// Something else than a GOTO follows CIRCLE, or nothing does: reports it.
void abandonArc(ReaderContext& context);

// spline_statements.cpp
void handleNurbs(ReaderContext& context, std::string_view word, std::string_view body);
/// KNOT and CNTRL, which belong to the NURBS before them.
void handleSplineData(ReaderContext& context, std::string_view word, std::string_view body);
/// To be called when another statement follows, or none: hands the curve out.
void finishSpline(ReaderContext& context, std::string_view next_word);

// cycle_statements.cpp
void handleCycle(ReaderContext& context, std::string_view word, std::string_view body);
void handleCutcom(ReaderContext& context, std::string_view word, std::string_view body);

// process_statements.cpp
void handleFedrat(ReaderContext& context, std::string_view word, std::string_view body);
void handleSpindl(ReaderContext& context, std::string_view word, std::string_view body);
void handleCoolnt(ReaderContext& context, std::string_view word, std::string_view body);
void handleDelay(ReaderContext& context, std::string_view word, std::string_view body);
void handleTolerance(ReaderContext& context, std::string_view word, std::string_view body);
void handleStop(ReaderContext& context, std::string_view word, std::string_view body);

// tool_statements.cpp
void handleCutter(ReaderContext& context, std::string_view word, std::string_view body);
void handleTldata(ReaderContext& context, std::string_view word, std::string_view body);
void handleToolPath(ReaderContext& context, std::string_view word, std::string_view body);
void handleToolno(ReaderContext& context, std::string_view word, std::string_view body);
void handleTprint(ReaderContext& context, std::string_view word, std::string_view body);
void handleLoad(ReaderContext& context, std::string_view word, std::string_view body);
void handleTurret(ReaderContext& context, std::string_view word, std::string_view body);

// frame_statements.cpp
void handleUnits(ReaderContext& context, std::string_view word, std::string_view body);
void handleMsys(ReaderContext& context, std::string_view word, std::string_view body);
void handleCsys(ReaderContext& context, std::string_view word, std::string_view body);
/// ORIGIN and TRANS: only what moves nothing.
void handleShift(ReaderContext& context, std::string_view word, std::string_view body);
/// SET/MODE,ABSOL.
void handleSet(ReaderContext& context, std::string_view word, std::string_view body);
void handleTrntyp(ReaderContext& context, std::string_view word, std::string_view body);
/// Comments that carry records: CATIA's in its dialect, and those that cusp's writer makes.
void handleComment(ReaderContext& context, std::string_view comment);
/// To be called when anything but a comment follows: a frame that is cut short is reported.
void finishFrame(ReaderContext& context);

// text_statements.cpp
void handleRemark(ReaderContext& context, std::string_view word, std::string_view body);
void handleEnd(ReaderContext& context, std::string_view word, std::string_view body);
void handleEndOfPath(ReaderContext& context, std::string_view word, std::string_view body);
/// Display, tolerances, tape, the tool to be made ready next: nothing for the machine.
void handleMeaningless(ReaderContext& context, std::string_view word, std::string_view body);

}  // namespace cusp::toolpath::detail
