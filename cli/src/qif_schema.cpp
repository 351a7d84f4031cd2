// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// xmllint in a process of its own.
#include "qif_schema.hpp"

#include <cusp/base/child_process.hpp>

#include <filesystem>
#include <fmt/format.h>
#include <sstream>

namespace cusp::cli {

namespace {

constexpr int says_invalid = 3;  // xmllint(1): validation error
constexpr double longest_s = 600.0;

}  // namespace

base::Result<void> checkAgainstQifSchema(const std::string& file, const std::string& schema) {
    const std::filesystem::path document = std::filesystem::path(schema) / "QIFApplications" / "QIFDocument.xsd";
    if (!std::filesystem::exists(document))
        return base::fail("io.open", "there is no such schema", {document.string(), 0, 0, {}});
    const auto outcome = base::runProcess(
        {"xmllint", "--nonet", "--noout", "--huge", "--schema", document.string(), file}, {.wall_s = longest_s});
    if (!outcome) return base::fail("qif.validator", "xmllint cannot be started; Debian has it in libxml2-utils");
    if (outcome->succeeded()) return {};
    if (outcome->exit_code != says_invalid)
        return base::fail("qif.validator", fmt::format("xmllint: {}", base::outcomeText(*outcome)), {file, 0, 0, {}});
    base::Diagnostics report;
    std::istringstream lines(outcome->errors);
    for (std::string line; std::getline(lines, line);)
        if (line.find("error") != std::string::npos) report.error("qif.schema", line);
    if (!report.hasErrors()) report.error("qif.schema", "the file does not follow the schema", {file, 0, 0, {}});
    return base::fail(std::move(report));
}

}  // namespace cusp::cli
