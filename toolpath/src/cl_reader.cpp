// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The reader: opens the stream, takes statement after statement to its handler, and hands out the records.
#include "head_scan.hpp"
#include "line_source.hpp"
#include "reader_context.hpp"
#include "statement.hpp"
#include "statement_table.hpp"

#include <cusp/toolpath/cl_reader.hpp>

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <iostream>

namespace cusp::toolpath {

using namespace detail;

struct ClReader::State {
    State(std::istream& in, std::string file_name, ClReaderOptions options)
        : source(in, options.block_bytes, options.max_statement_bytes), splitter(source, options.max_statement_bytes) {
        context.options = options;
        context.file_name = std::move(file_name);
        context.dialect = &traitsOf(options.dialect.value_or(Dialect::Apt));
    }

    void open();
    [[nodiscard]] bool next(ClRecord& record);
    /// Reads one statement. True when it was a plain GOTO, already in `record`.
    [[nodiscard]] bool step(ClRecord& record);
    void dispatch(const Statement& statement);
    void afterEnd(const StatementHead& head, std::string_view text);
    void endOfInput(StatementSplitter::Status status);
    void finish();

    ReaderContext context;
    LineSource source;
    StatementSplitter splitter;
    bool opened = false;
    bool finished = false;
};

void ClReader::State::open() {
    opened = true;
    constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
    std::string_view head = source.peek(head_bytes);
    if (head.substr(0, byte_order_mark.size()) == byte_order_mark) {
        source.skip(byte_order_mark.size());
        head.remove_prefix(byte_order_mark.size());
    }
    if (source.isBinary() && head.size() < head_bytes - byte_order_mark.size()) {
        context.line = 1;
        endOfInput(StatementSplitter::Status::Binary);
        return;
    }
    const HeadFindings findings = scanHead(head);
    context.dialect = &traitsOf(context.options.dialect.value_or(findings.dialect.value_or(Dialect::Apt)));
    if (findings.stated) {
        context.unit_source = UnitSource::Stated;
        context.mm_per_unit = mmPerUnitOf(*findings.stated);
    } else if (context.options.mm_per_unit) {
        context.unit_source = UnitSource::Option;
        context.mm_per_unit = *context.options.mm_per_unit;
    } else if (findings.implied) {
        context.unit_source = UnitSource::Implied;
        context.mm_per_unit = mmPerUnitOf(*findings.implied);
    }
}

bool ClReader::State::next(ClRecord& record) {
    if (!opened) {
        open();
    }
    for (;;) {
        if (context.taken < context.records.size()) {
            record = std::move(context.records[context.taken++]);
            return true;
        }
        context.records.clear();
        context.taken = 0;
        if (finished) {
            return false;
        }
        if (step(record)) {
            return true;
        }
    }
}

bool ClReader::State::step(ClRecord& record) {
    Statement statement;
    const StatementSplitter::Status status = splitter.next(statement);
    context.line = statement.line;
    if (status != StatementSplitter::Status::Statement) {
        endOfInput(status);
        return false;
    }
    // Nearly every statement of a long file is a GOTO: it passes without a look at the table.
    constexpr std::string_view go = "GOTO";
    if (context.gotoIsPlain() && statement.text.substr(0, go.size()) == go) {
        std::string_view body = statement.text.substr(go.size());
        while (!body.empty() && isBlank(body.front())) {
            body.remove_prefix(1);
        }
        if (!body.empty() && body.front() == '/') {
            body.remove_prefix(1);
            if (readPlainGoto(context, body, record.statement.emplace<LinearMotion>())) {
                record.line = statement.line;
                return true;
            }
        }
    }
    dispatch(statement);
    if (context.stopped) {
        finished = true;
    }
    return false;
}

void ClReader::State::dispatch(const Statement& statement) {
    if (statement.is_comment) {
        if (!context.program_ended) {
            handleComment(context, statement.text);
        }
        return;
    }
    finishFrame(context);
    const StatementHead head(statement.text);
    if (context.program_ended) {
        afterEnd(head, statement.text);
        return;
    }
    finishSpline(context, head.word());
    const StatementEntry* const entry = findStatement(head.word(), context.dialect->dialect);
    if (entry == nullptr) {
        unknownStatement(context, head, statement.text);
    } else if (!head.isPlain() && !entry->any_form && entry->handler != unsupportedMotion) {
        context.error("cl.syntax",
                      fmt::format("{}: a slash or the end of the statement is expected behind the word", head.word()));
    } else {
        entry->handler(context, head.word(), head.body());
    }
    context.program_begun = context.program_begun || entry != nullptr;
}

void ClReader::State::afterEnd(const StatementHead& head, std::string_view text) {
    const StatementEntry* const entry = findStatement(head.word(), context.dialect->dialect);
    if (entry == nullptr || !head.isPlain()) {
        context.warning("cl.after-end",
                        fmt::format("text behind the end of the program is not read: '{}'", inQuotes(text)));
        finish();
    } else if (entry->handler != handleEnd && entry->handler != handleMeaningless &&
               entry->handler != handleEndOfPath) {
        context.error("cl.after-end", fmt::format("{} behind the end of the program is not read", head.word()));
        finish();
    }
}

void ClReader::State::endOfInput(StatementSplitter::Status status) {
    using Status = StatementSplitter::Status;
    switch (status) {
        case Status::TooLong:
            context.stop("cl.line-too-long",
                         fmt::format("a statement of more than {} bytes; this does not look like a CL file",
                                     context.options.max_statement_bytes));
            break;
        case Status::TooMany: context.stop("cl.too-many-lines", "more than 4294967295 lines"); break;
        case Status::Binary: context.stop("cl.binary", "this is not a text file: it contains NUL bytes"); break;
        case Status::ReadError: context.stop("io.read", "the file could not be read to its end"); break;
        case Status::OpenContinuation:
            context.stop("cl.continuation", "the file ends inside a statement that $ continues");
            break;
        case Status::End:
        case Status::Statement: break;
    }
    if (!context.stopped) {
        finishFrame(context);
        abandonArc(context);
        finishSpline(context, {});
        if (context.path_ended && !context.program_ended) {
            context.emit(ProgramEnd{});
        } else if (!context.program_ended && context.motion_seen) {
            context.error(
                "cl.no-end",
                "the file ends without FINI, END or END-OF-PATH: it has been cut short; if it is whole, add FINI");
        }
    }
    finish();
}

void ClReader::State::finish() {
    finished = true;
    if (!context.stopped && !context.motion_seen && !context.report.hasErrors()) {
        context.error("cl.no-motion", "the file moves no tool: no GOTO in it");
    }
}

ClReader::ClReader(std::istream& in, std::string file_name, ClReaderOptions options)
    : state_(std::make_unique<State>(in, std::move(file_name), options)) {}
ClReader::~ClReader() = default;
ClReader::ClReader(ClReader&&) noexcept = default;
ClReader& ClReader::operator=(ClReader&&) noexcept = default;

bool ClReader::next(ClRecord& record) { return state_->next(record); }
const base::Diagnostics& ClReader::report() const { return state_->context.report; }
Dialect ClReader::dialect() const { return state_->context.dialect->dialect; }
double ClReader::mmPerUnit() const { return state_->context.mm_per_unit; }

base::Result<ToolPath> readToolPath(std::istream& in, const std::string& file_name, const ClReaderOptions& options,
                                    base::Diagnostics& warnings) {
    ClReader reader(in, file_name, options);
    ToolPath path;
    path.file_name = file_name;
    ClRecord record;
    while (reader.next(record)) {
        path.records.push_back(record);
    }
    if (reader.report().hasErrors()) {
        return base::fail(reader.report());
    }
    warnings.append(reader.report());
    path.dialect = reader.dialect();
    path.mm_per_unit = reader.mmPerUnit();
    return path;
}

base::Result<ToolPath> readToolPathFile(const std::string& path, const ClReaderOptions& options,
                                        base::Diagnostics& warnings) {
    if (path == "-") {
        return readToolPath(std::cin, "<stdin>", options, warnings);
    }
    errno = 0;
    std::ifstream in(path, std::ios::binary);
    if (!in) {
        return base::fail("io.open", fmt::format("cannot open the file: {}", std::strerror(errno)), {path, 0, 0, {}});
    }
    return readToolPath(in, path, options, warnings);
}

}  // namespace cusp::toolpath
