// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Text for people, the end of the program, and statements without meaning for the machine.
#include "statement_table.hpp"

namespace cusp::toolpath::detail {

void handleRemark(ReaderContext& context, std::string_view word, std::string_view body) {
    Remark::Kind kind = Remark::Kind::Message;
    if (word == "PARTNO") {
        kind = Remark::Kind::PartName;
    } else if (word == "INSERT") {
        kind = Remark::Kind::Insert;
    }
    context.emit(Remark{kind, std::string(trimmed(body))});
}

void handleEnd(ReaderContext& context, std::string_view /*word*/, std::string_view /*body*/) {
    context.program_ended = true;
    context.emit(ProgramEnd{});
}

void handleEndOfPath(ReaderContext& context, std::string_view /*word*/, std::string_view /*body*/) {
    // The end of the file only if nothing follows: a CLSF has one per operation.
    context.path_ended = true;
}

void handleMeaningless(ReaderContext& /*context*/, std::string_view /*word*/, std::string_view /*body*/) {}

}  // namespace cusp::toolpath::detail
