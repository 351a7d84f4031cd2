// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What went wrong and where: the one form in which every room reports problems.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::base {

enum class Severity { Note, Warning, Error };

/// Where a problem lies. Lines and columns count from 1; 0 means "not known". `key` is the dotted path in a TOML file
/// ("rotary.A.min_deg").
struct Location {
    std::string file;
    std::size_t line = 0;
    std::size_t column = 0;
    std::string key;
};

/// One problem. `code` is stable and dotted ("cl.unknown-statement"); `message` is for a machinist to read. Both texts
/// are contracts, held by tests.
struct Diagnostic {
    Severity severity = Severity::Error;
    std::string code;
    std::string message;
    Location where;
};

/// "P.apt:12:5: error: rotary.A.min_deg: message [code]", leaving out what is not known.
[[nodiscard]] std::string toText(const Diagnostic& diagnostic);

/// An ordered list of problems. Counts every problem but keeps at most `cap` texts, so that a broken file of a million
/// lines ends in a page, not in a flood. An error is kept in preference to an earlier warning when the list is full.
class Diagnostics {
public:
    static constexpr std::size_t default_cap = 100;

    explicit Diagnostics(std::size_t cap = default_cap) : cap_(cap) {}

    void add(Diagnostic diagnostic);
    void error(std::string_view code, std::string message, Location where = {});
    void warning(std::string_view code, std::string message, Location where = {});
    void note(std::string_view code, std::string message, Location where = {});
    void append(const Diagnostics& other);

    [[nodiscard]] bool hasErrors() const { return error_count_ > 0; }
    [[nodiscard]] std::size_t errorCount() const { return error_count_; }
    [[nodiscard]] std::size_t warningCount() const { return warning_count_; }
    /// Problems counted but not kept.
    [[nodiscard]] std::size_t suppressed() const { return suppressed_; }
    [[nodiscard]] bool empty() const { return items_.empty(); }
    [[nodiscard]] std::size_t size() const { return items_.size(); }
    [[nodiscard]] auto begin() const { return items_.begin(); }
    [[nodiscard]] auto end() const { return items_.end(); }
    [[nodiscard]] const Diagnostic& front() const { return items_.front(); }

private:
    std::vector<Diagnostic> items_;
    std::size_t cap_;
    std::size_t error_count_ = 0;
    std::size_t warning_count_ = 0;
    std::size_t suppressed_ = 0;
};

/// All texts, one per line, then "… and N more" when some were not kept.
[[nodiscard]] std::string toText(const Diagnostics& diagnostics);

}  // namespace cusp::base
