// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reads CL text and prints what came out, so that tests compare meaning line by line.
#pragma once

#include <cusp/toolpath/cl_reader.hpp>

#include <string>
#include <vector>

namespace cusp::toolpath::test {

struct ReadOut {
    std::vector<ClRecord> records;
    Dialect dialect = Dialect::Apt;
    double mm_per_unit = 0.0;
    base::Diagnostics report;
    /// One line per record: its line in the file, its kind, its values with full precision.
    std::string text;
    /// `base::toText` of the report, without the file's name.
    std::string problems;
};

[[nodiscard]] ReadOut readOut(std::istream& in, const ClReaderOptions& options = {});
[[nodiscard]] ReadOut readOut(const std::string& cl_text, const ClReaderOptions& options = {});

/// Reads `body` as plain APT in mm, followed by a GOTO and FINI where `body` has none: the text of the records of
/// `body` alone, or its problems.
[[nodiscard]] std::string recordsOf(const std::string& body);
[[nodiscard]] std::string problemsOf(const std::string& body);

[[nodiscard]] std::string fileText(const std::string& path);

[[nodiscard]] std::string textOf(const ClRecord& record);

}  // namespace cusp::toolpath::test
