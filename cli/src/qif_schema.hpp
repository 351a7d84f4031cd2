// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A QIF file against the schema of its standard, by xmllint.
#pragma once

#include <cusp/base/result.hpp>

#include <string>

namespace cusp::cli {

/// `schema` is the folder that holds QIFApplications/QIFDocument.xsd. No network is asked for anything.
/// Errors: `qif.schema` (each violation xmllint names, up to a page of them), `io.open` (no such schema),
/// `qif.validator` (xmllint is not installed, or did not end by itself).
[[nodiscard]] base::Result<void> checkAgainstQifSchema(const std::string& file, const std::string& schema);

}  // namespace cusp::cli
