// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The ledger on SQLite: one table, triggers against changes, a chain of digests.
#include <cusp/comm/dnc/ledger.hpp>

#include <cusp/base/hash.hpp>

#include <algorithm>
#include <limits>
#include <sqlite3.h>
#include <utility>

namespace cusp::comm {

namespace {

constexpr int busy_timeout_ms = 5000;

constexpr const char* schema =
    "CREATE TABLE IF NOT EXISTS audit (number INTEGER PRIMARY KEY AUTOINCREMENT, time_utc TEXT NOT NULL,"
    " transfer TEXT NOT NULL, event TEXT NOT NULL, program TEXT NOT NULL, digest TEXT NOT NULL, bytes INTEGER NOT NULL,"
    " machine TEXT NOT NULL, operator_label TEXT NOT NULL, link TEXT NOT NULL, detail TEXT NOT NULL,"
    " chain TEXT NOT NULL);"
    "CREATE TRIGGER IF NOT EXISTS audit_keeps BEFORE UPDATE ON audit"
    " BEGIN SELECT RAISE(ABORT, 'the ledger is append-only'); END;"
    "CREATE TRIGGER IF NOT EXISTS audit_stays BEFORE DELETE ON audit"
    " BEGIN SELECT RAISE(ABORT, 'the ledger is append-only'); END;";

constexpr const char* columns =
    "number, time_utc, transfer, event, program, digest, bytes, machine, operator_label, link, detail, chain";

struct Finalize {
    void operator()(sqlite3_stmt* statement) const { ::sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, Finalize>;

tl::unexpected<base::Diagnostics> failWith(sqlite3* database, const std::string& path) {
    return base::fail("io.ledger", std::string("ledger: ") + ::sqlite3_errmsg(database), {path, 0, 0, {}});
}

std::string textAt(sqlite3_stmt* statement, int column) {
    const auto* text = reinterpret_cast<const char*>(::sqlite3_column_text(statement, column));
    return text == nullptr ? std::string()
                           : std::string(text, static_cast<std::size_t>(::sqlite3_column_bytes(statement, column)));
}

LedgerEntry entryAt(sqlite3_stmt* row) {
    LedgerEntry out;
    out.number = ::sqlite3_column_int64(row, 0);
    out.time_utc = textAt(row, 1);
    out.transfer = textAt(row, 2);
    out.event = textAt(row, 3);
    out.program = textAt(row, 4);
    out.digest = textAt(row, 5);
    out.bytes = static_cast<std::uint64_t>(::sqlite3_column_int64(row, 6));
    out.machine = textAt(row, 7);
    out.operator_label = textAt(row, 8);
    out.link = textAt(row, 9);
    out.detail = textAt(row, 10);
    out.chain = textAt(row, 11);
    return out;
}

/// Each field with its length in front: no two entries have the same text.
std::string chainOf(const LedgerEntry& entry, const std::string& before) {
    std::string text;
    for (const std::string& field :
         {before, entry.time_utc, entry.transfer, entry.event, entry.program, entry.digest, std::to_string(entry.bytes),
          entry.machine, entry.operator_label, entry.link, entry.detail})
        text += std::to_string(field.size()) + ':' + field + '\n';
    return base::sha256Hex(text);
}

}  // namespace

struct Ledger::Connection {
    sqlite3* database = nullptr;
    std::string path;

    Connection() = default;
    Connection(const Connection&) = delete;
    Connection& operator=(const Connection&) = delete;
    ~Connection() { ::sqlite3_close(database); }

    [[nodiscard]] bool run(const char* sql) const {
        return ::sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK;
    }
    [[nodiscard]] base::Result<Statement> prepare(const std::string& sql) const {
        sqlite3_stmt* statement = nullptr;
        if (::sqlite3_prepare_v2(database, sql.c_str(), -1, &statement, nullptr) != SQLITE_OK)
            return failWith(database, path);
        return Statement(statement);
    }
    [[nodiscard]] base::Result<std::vector<LedgerEntry>> select(const std::string& tail) const {
        auto statement = prepare(std::string("SELECT ") + columns + " FROM audit " + tail);
        if (!statement) return base::fail(std::move(statement).error());
        std::vector<LedgerEntry> out;
        int step = SQLITE_ROW;
        while ((step = ::sqlite3_step(statement->get())) == SQLITE_ROW) out.push_back(entryAt(statement->get()));
        if (step != SQLITE_DONE) return failWith(database, path);
        return out;
    }
    [[nodiscard]] base::Result<void> insert(const LedgerEntry& entry) const;
};

base::Result<void> Ledger::Connection::insert(const LedgerEntry& entry) const {
    auto statement = prepare(
        "INSERT INTO audit (time_utc, transfer, event, program, digest, machine, operator_label, link, detail, chain, bytes)"
        " VALUES (?,?,?,?,?,?,?,?,?,?,?)");
    if (!statement) return base::fail(std::move(statement).error());
    int at = 0;
    for (const std::string* field : {&entry.time_utc, &entry.transfer, &entry.event, &entry.program, &entry.digest,
                                     &entry.machine, &entry.operator_label, &entry.link, &entry.detail, &entry.chain})
        ::sqlite3_bind_text(statement->get(), ++at, field->c_str(), static_cast<int>(field->size()), SQLITE_TRANSIENT);
    ::sqlite3_bind_int64(statement->get(), ++at, static_cast<std::int64_t>(entry.bytes));
    if (::sqlite3_step(statement->get()) != SQLITE_DONE) return failWith(database, path);
    return {};
}

Ledger::Ledger(std::unique_ptr<Connection> connection) : connection_(std::move(connection)) {}
Ledger::Ledger(Ledger&&) noexcept = default;
Ledger& Ledger::operator=(Ledger&&) noexcept = default;
Ledger::~Ledger() = default;

base::Result<Ledger> Ledger::open(const std::string& path) {
    auto connection = std::make_unique<Connection>();
    connection->path = path;
    const int flags = SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | SQLITE_OPEN_NOMUTEX;
    if (::sqlite3_open_v2(path.c_str(), &connection->database, flags, nullptr) != SQLITE_OK)
        return failWith(connection->database, path);
    ::sqlite3_busy_timeout(connection->database, busy_timeout_ms);
    if (!connection->run("PRAGMA synchronous = FULL") || !connection->run(schema))
        return failWith(connection->database, path);
    return Ledger(std::move(connection));
}

base::Result<std::int64_t> Ledger::append(const LedgerEntry& entry) {
    // Immediate: nobody else may append between reading the last link of the chain and writing the next.
    if (!connection_->run("BEGIN IMMEDIATE")) return failWith(connection_->database, connection_->path);
    const auto give_up = [this](base::Diagnostics why) {
        static_cast<void>(connection_->run("ROLLBACK"));
        return base::fail(std::move(why));
    };
    auto before = connection_->select("ORDER BY number DESC LIMIT 1");
    if (!before) return give_up(std::move(before).error());
    LedgerEntry linked = entry;
    linked.chain = chainOf(entry, before->empty() ? std::string() : before->front().chain);
    if (auto inserted = connection_->insert(linked); !inserted) return give_up(std::move(inserted).error());
    const std::int64_t number = ::sqlite3_last_insert_rowid(connection_->database);
    if (!connection_->run("COMMIT")) return give_up(failWith(connection_->database, connection_->path).value());
    return number;
}

base::Result<std::vector<LedgerEntry>> Ledger::last(std::size_t most) const {
    auto entries = connection_->select("ORDER BY number DESC LIMIT " + std::to_string(most));
    if (entries) std::reverse(entries->begin(), entries->end());
    return entries;
}

base::Result<std::int64_t> Ledger::firstBroken() const {
    const auto entries = connection_->select("ORDER BY number");
    if (!entries) return base::fail(entries.error());
    std::string before;
    for (const LedgerEntry& entry : *entries) {
        if (entry.chain != chainOf(entry, before)) return entry.number;
        before = entry.chain;
    }
    return 0;
}

}  // namespace cusp::comm
