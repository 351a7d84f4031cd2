// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Wording and repetition.
#include "findings.hpp"

#include <fmt/format.h>

namespace cusp::post::verify {

std::string nameOf(const reader::BlockPlace& place) {
    if (!place.block_number) return fmt::format("line {}", place.line);
    return fmt::format("block N{} (line {})", *place.block_number, place.line);
}

void Findings::error(std::string_view code, const reader::BlockPlace& place, std::string_view text) {
    report_.findings.error(code, fmt::format("{}: {}", nameOf(place), text), where(place));
}

void Findings::warning(std::string_view code, const reader::BlockPlace& place, std::string_view text) {
    report_.findings.warning(code, fmt::format("{}: {}", nameOf(place), text), where(place));
}

void Findings::missing(std::string_view code, std::string text) {
    report_.findings.error(code, std::move(text), {program_name_, 0, 0, {}});
}

void Findings::state(base::Severity severity, std::string_view code, const reader::BlockPlace& place,
                     const std::string& text, std::size_t cl_line) {
    auto found = last_.find(code);
    if (found == last_.end()) found = last_.emplace(std::string(code), std::string()).first;
    if (found->second == text) return;
    found->second = text;
    if (text.empty()) return;
    const std::string full = fmt::format("{} (CL line {})", text, cl_line);
    if (severity == base::Severity::Error)
        error(code, place, full);
    else
        warning(code, place, full);
}

void raise(Extreme& extreme, double value, const reader::BlockPlace& place, std::size_t cl_line) {
    if (value <= extreme.value) return;
    extreme = {value, place.line, place.block_number, cl_line};
}

}  // namespace cusp::post::verify
