// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of the CL reader: any bytes end in records or problems, and the block size changes neither.
#include "cl_text.hpp"

#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cusp::toolpath;
    const std::string text(data, data + size);
    ClReaderOptions options;
    const test::ReadOut whole = test::readOut(text, options);
    options.block_bytes = 1 + size % 61;
    const test::ReadOut pieces = test::readOut(text, options);
    if (whole.text != pieces.text || whole.problems != pieces.problems) {
        std::abort();
    }
    for (const ClRecord& record : whole.records) {
        if (const auto* motion = std::get_if<LinearMotion>(&record.statement)) {
            const bool unit = std::abs(motion->location.axis.norm() - 1.0) < 1e-12;
            if (!unit || !motion->location.tip_mm.allFinite()) {
                std::abort();
            }
        }
        if (const auto* arc = std::get_if<ArcMotion>(&record.statement)) {
            const bool unit = std::abs(arc->normal.norm() - 1.0) < 1e-12;
            const double off_mm =
                std::abs((arc->end.tip_mm - arc->center_mm).cross(arc->normal).norm() - arc->radius_mm);
            const double extent = 1.0 + arc->end.tip_mm.norm() + arc->center_mm.norm();
            if (!unit || !(arc->radius_mm > 0.0) || !(off_mm <= arc_tolerance_mm + 1e-12 * extent)) {
                std::abort();
            }
        }
    }
    return 0;
}
