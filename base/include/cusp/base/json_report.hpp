// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The `--json` summaries: one stamp, one form of diagnostics, and no number that JSON cannot say.
#pragma once

#include <cusp/base/result.hpp>

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace cusp::base {

/// Keys keep the order in which they were written.
using Json = nlohmann::ordered_json;

/// {"schema": …, "command": …, "version": …}: what every summary starts with. `schema` counts up when keys change.
[[nodiscard]] Json jsonReport(std::string_view command, std::int64_t schema);

/// {"errors": n, "warnings": n, "suppressed": n, "items": [{"severity", "code", "message", "file", "line", "column",
/// "key"}…]}; of a location only what is known.
[[nodiscard]] Json diagnosticsToJson(const Diagnostics& diagnostics);

/// The text of a document, indented by two blanks, with a line feed at its end; bytes that are no UTF-8 become U+FFFD.
/// Error: `json.not-finite`, with the JSON pointer of a NaN or infinity as key (JSON would silently turn it into null).
[[nodiscard]] Result<std::string> jsonText(const Json& document);

}  // namespace cusp::base
