// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Collecting problems and turning them into text.
#include <cusp/base/diagnostics.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace cusp::base {
namespace {

std::string_view wordFor(Severity severity) {
    switch (severity) {
        case Severity::Error: return "error";
        case Severity::Warning: return "warning";
        case Severity::Note: return "note";
    }
    return "error";
}

/// A hostile file must not steer the terminal: control characters of quoted input are written as \xNN.
void appendPrintable(std::string& out, std::string_view text) {
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20U || byte == 0x7FU)
            fmt::format_to(std::back_inserter(out), "\\x{:02x}", byte);
        else
            out += c;
    }
}

}  // namespace

std::string toText(const Diagnostic& diagnostic) {
    std::string out;
    const Location& where = diagnostic.where;
    appendPrintable(out, where.file);
    if (where.line > 0) {
        if (!out.empty()) out += ':';
        fmt::format_to(std::back_inserter(out), "{}", where.line);
        if (where.column > 0) fmt::format_to(std::back_inserter(out), ":{}", where.column);
    }
    if (!out.empty()) out += ": ";
    out += wordFor(diagnostic.severity);
    out += ": ";
    if (!where.key.empty()) {
        appendPrintable(out, where.key);
        out += ": ";
    }
    appendPrintable(out, diagnostic.message);
    if (!diagnostic.code.empty()) {
        out += " [";
        appendPrintable(out, diagnostic.code);
        out += ']';
    }
    return out;
}

void Diagnostics::add(Diagnostic diagnostic) {
    const bool is_error = diagnostic.severity == Severity::Error;
    if (is_error) ++error_count_;
    if (diagnostic.severity == Severity::Warning) ++warning_count_;
    if (items_.size() < cap_) {
        items_.push_back(std::move(diagnostic));
        return;
    }
    ++suppressed_;
    if (!is_error) return;
    const auto is_lesser = [](const Diagnostic& item) { return item.severity != Severity::Error; };
    const auto victim = std::find_if(items_.rbegin(), items_.rend(), is_lesser);
    if (victim == items_.rend()) return;
    items_.erase(std::next(victim).base());
    items_.push_back(std::move(diagnostic));
}

void Diagnostics::error(std::string_view code, std::string message, Location where) {
    add({Severity::Error, std::string(code), std::move(message), std::move(where)});
}

void Diagnostics::warning(std::string_view code, std::string message, Location where) {
    add({Severity::Warning, std::string(code), std::move(message), std::move(where)});
}

void Diagnostics::note(std::string_view code, std::string message, Location where) {
    add({Severity::Note, std::string(code), std::move(message), std::move(where)});
}

void Diagnostics::append(const Diagnostics& other) {
    // A copy: `other` may be this list itself, and `add` moves items about.
    // NOLINTNEXTLINE(performance-unnecessary-copy-initialization)
    const Diagnostics source = other;
    std::size_t kept_errors = 0;
    std::size_t kept_warnings = 0;
    for (const Diagnostic& item : source.items_) {
        if (item.severity == Severity::Error) ++kept_errors;
        if (item.severity == Severity::Warning) ++kept_warnings;
        add(item);
    }
    error_count_ += source.error_count_ - kept_errors;
    warning_count_ += source.warning_count_ - kept_warnings;
    suppressed_ += source.suppressed_;
}

std::string toText(const Diagnostics& diagnostics) {
    std::string out;
    for (const Diagnostic& item : diagnostics) out += toText(item) + "\n";
    if (diagnostics.suppressed() > 0) out += fmt::format("… and {} more\n", diagnostics.suppressed());
    return out;
}

}  // namespace cusp::base
