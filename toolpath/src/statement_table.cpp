// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The table of statements.
#include "statement_table.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>

namespace cusp::toolpath::detail {
namespace {

constexpr DialectSet nx = only(Dialect::Nx);
constexpr DialectSet solidworks = only(Dialect::SolidWorksCam);

// Sorted by word; an entry for one dialect comes before that for every dialect.
constexpr std::array statements{
    StatementEntry{"AUTOPS", handleMeaningless},
    StatementEntry{"CALL", unsupportedMotion},
    StatementEntry{"CIRCLE", handleCircle},
    StatementEntry{"CNTRL", handleSplineData},
    StatementEntry{"COOLNT", handleCoolnt},
    StatementEntry{"COPY", unsupportedMotion},
    StatementEntry{"CSI_SET_EXTENSION_LENGTH", handleMeaningless, solidworks},
    StatementEntry{"CSI_SET_FLUTE_LENGTH", handleMeaningless, solidworks},
    StatementEntry{"CSYS", handleCsys, solidworks},
    StatementEntry{"CSYS", unsupportedMotion},
    StatementEntry{"CUTCOM", handleCutcom},
    StatementEntry{"CUTTER", handleCutter},
    StatementEntry{"CYCLE", handleCycle},
    StatementEntry{"DELAY", handleDelay},
    StatementEntry{"DISPLY", handleMeaningless},
    StatementEntry{"END", handleEnd},
    StatementEntry{"END-OF-PATH", handleEndOfPath},
    StatementEntry{"FEDRAT", handleFedrat},
    StatementEntry{"FINI", handleEnd},
    StatementEntry{"FROM", handleFrom},
    StatementEntry{"GOBACK", unsupportedMotion},
    StatementEntry{"GODLTA", handleGodlta},
    StatementEntry{"GODOWN", unsupportedMotion},
    StatementEntry{"GOFWD", unsupportedMotion},
    StatementEntry{"GOHOME", handleGohome},
    StatementEntry{"GOLFT", unsupportedMotion},
    StatementEntry{"GORGT", unsupportedMotion},
    StatementEntry{"GOTO", handleGoto},
    StatementEntry{"GOUP", unsupportedMotion},
    StatementEntry{"IF", unsupportedMotion},
    StatementEntry{"INDEX", unsupportedMotion},
    StatementEntry{"INDIRP", unsupportedMotion},
    StatementEntry{"INDIRV", handleIndirv},
    StatementEntry{"INSERT", handleRemark},
    StatementEntry{"INTOL", handleTolerance},
    StatementEntry{"JUMPTO", unsupportedMotion},
    StatementEntry{"KNOT", handleSplineData},
    StatementEntry{"LOAD", handleLoad},
    StatementEntry{"LOADTL", handleLoad},
    StatementEntry{"LOOPST", unsupportedMotion},
    StatementEntry{"MACRO", unsupportedMotion},
    StatementEntry{"MOVARC", handleMovarc},
    StatementEntry{"MSYS", handleMsys, nx},
    StatementEntry{"MULTAX", handleMultax},
    StatementEntry{"NURBS", handleNurbs},
    StatementEntry{"OPSTOP", handleStop},
    StatementEntry{"ORIGIN", handleShift},
    StatementEntry{"OUTTOL", handleTolerance},
    StatementEntry{"PAINT", handleMeaningless},
    StatementEntry{"PARTNO", handleRemark},
    StatementEntry{"PPRINT", handleRemark},
    StatementEntry{"RAPID", handleRapid},
    StatementEntry{"REWIND", handleMeaningless},
    StatementEntry{"ROTABL", unsupportedMotion},
    StatementEntry{"ROTHED", unsupportedMotion},
    StatementEntry{"SELECT", handleMeaningless, solidworks},
    StatementEntry{"SEQNO", handleMeaningless},
    StatementEntry{"SET", handleSet},
    StatementEntry{"SPINDL", handleSpindl},
    StatementEntry{"STOP", handleStop},
    StatementEntry{"SYN", unsupportedMotion},
    StatementEntry{"TLAXIS", handleTlaxis},
    StatementEntry{"TLDATA", handleTldata, nx},
    StatementEntry{"TLLFT", unsupportedMotion},
    StatementEntry{"TLON", handleTlon, every_dialect, true},
    StatementEntry{"TLRGT", unsupportedMotion},
    StatementEntry{"TOOL PATH", handleToolPath, nx},
    StatementEntry{"TOOLNO", handleToolno},
    StatementEntry{"TPRINT", handleTprint},
    StatementEntry{"TRACUT", unsupportedMotion},
    StatementEntry{"TRANS", handleShift},
    StatementEntry{"TRNTYP", handleTrntyp},
    StatementEntry{"TURRET", handleTurret},
    StatementEntry{"UNIT", handleUnits},
    StatementEntry{"UNITS", handleUnits},
};

constexpr bool sortedByWord() {
    for (std::size_t i = 1; i < statements.size(); ++i) {
        if (statements[i].word < statements[i - 1].word) {
            return false;
        }
    }
    return true;
}
static_assert(sortedByWord());

// Words by which an unknown statement betrays that it moves the tool: `L1) GOTO/…`, `P1=POINT/…` does not.
constexpr std::array<std::string_view, 10> moving_words{"CIRCLE", "CYCLE",  "GOBACK", "GODLTA", "GODOWN",
                                                        "GOFWD",  "GOHOME", "GOLFT",  "GORGT",  "GOTO"};

bool isWordCharacter(char c) {
    const char upper = upperCase(c);
    return (upper >= 'A' && upper <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

std::string_view movingWordIn(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        std::size_t end = at;
        while (end < text.size() && isWordCharacter(text[end])) {
            ++end;
        }
        for (const std::string_view word : moving_words) {
            if (equalsWord(text.substr(at, end - at), word)) {
                return word;
            }
        }
        at = std::max(end, at + 1);
    }
    return {};
}

/// `WORD` or `WORD/…` in one piece that begins with a letter, as against a sentence or a date.
bool looksLikeStatement(const StatementHead& head, std::string_view text) {
    const std::string_view word = head.word();
    return head.isPlain() && text.find('/') != std::string_view::npos && word.find(' ') == std::string_view::npos &&
           !word.empty() && word.front() >= 'A' && word.front() <= 'Z';
}

}  // namespace

const StatementEntry* findStatement(std::string_view word, Dialect dialect) {
    const auto* entry = std::lower_bound(statements.begin(), statements.end(), word,
                                         [](const StatementEntry& e, std::string_view w) { return e.word < w; });
    for (; entry != statements.end() && entry->word == word; ++entry) {
        if ((entry->dialects & only(dialect)) != 0) {
            return entry;
        }
    }
    return nullptr;
}

void unsupportedMotion(ReaderContext& context, std::string_view word, std::string_view /*body*/) {
    context.error("cl.unsupported-motion",
                  fmt::format("{} is not yet read; without it the tool would go elsewhere than the file says", word));
}

void unknownStatement(ReaderContext& context, const StatementHead& head, std::string_view text) {
    if (const std::string_view word = movingWordIn(text); !word.empty()) {
        context.error("cl.unsupported-motion",
                      fmt::format("'{}' is not understood, and {} in it may move the tool", inQuotes(text), word));
        return;
    }
    const bool statement = looksLikeStatement(head, text);
    if (!statement && !context.program_begun) {
        if (!context.preamble_noted) {
            context.preamble_noted = true;
            context.report.note("cl.preamble",
                                fmt::format("text before the first statement is passed over: '{}'", inQuotes(text)),
                                context.here());
        }
        return;
    }
    if (!statement && context.path_ended) {
        return;  // NX: "Tool Path Listing has 388 lines."
    }
    const std::string message = fmt::format("'{}' is not known to the reader and is passed over", inQuotes(text));
    if (context.options.strict) {
        context.error("cl.unknown-statement", message);
    } else {
        context.warning("cl.unknown-statement", message);
    }
}

}  // namespace cusp::toolpath::detail
