// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reads measured points from a text, for tests.
#pragma once

#include <cusp/inspect/point_reader.hpp>

#include <sstream>
#include <string>

namespace cusp::inspect::test {

struct PointsRead {
    MeasuredPoints points;
    std::string errors;
    std::string remarks;  ///< warnings and notes
};

inline PointsRead readText(const std::string& text, const PointReaderOptions& options = {}) {
    std::istringstream in(text);
    base::Diagnostics report;
    auto read = readMeasuredPoints(in, "", options, report);
    PointsRead out;
    out.remarks = toText(report);
    if (read)
        out.points = *std::move(read);
    else
        out.errors = toText(read.error());
    return out;
}

}  // namespace cusp::inspect::test
