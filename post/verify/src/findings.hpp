// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Puts findings into words, and says the same thing once.
#pragma once

#include <cusp/post/reader/executed_program.hpp>
#include <cusp/post/verify/verify_program.hpp>

#include <map>
#include <string>
#include <string_view>

namespace cusp::post::verify {

/// "block N120 (line 14)" or "line 14".
[[nodiscard]] std::string nameOf(const reader::BlockPlace& place);

class Findings {
public:
    Findings(VerifyReport& report, std::string program_name)
        : report_(report), program_name_(std::move(program_name)) {}

    void error(std::string_view code, const reader::BlockPlace& place, std::string_view text);
    void warning(std::string_view code, const reader::BlockPlace& place, std::string_view text);
    /// About the CL file, with no block to name.
    void missing(std::string_view code, std::string text);

    /// States last for many blocks: reports `text` when it differs from what was last said under `code`, whatever block
    /// and CL line are named before and after it. An empty text says that all is well again.
    void state(base::Severity severity, std::string_view code, const reader::BlockPlace& place, const std::string& text,
               std::size_t cl_line);

private:
    [[nodiscard]] base::Location where(const reader::BlockPlace& place) const {
        return {program_name_, place.line, 0, {}};
    }

    VerifyReport& report_;
    std::string program_name_;
    std::map<std::string, std::string, std::less<>> last_;
};

void raise(Extreme& extreme, double value, const reader::BlockPlace& place, std::size_t cl_line);

}  // namespace cusp::post::verify
