// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of the CL reader: any bytes end in records or problems, the block size changes neither, and what
// was read can be written and read again.
#include "cl_text.hpp"

#include <cusp/toolpath/cl_writer.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace {

using namespace cusp::toolpath;

/// What was read without error is written, read and written again to the same text.
void writeAndReadBack(const test::ReadOut& out) {
    const auto text = clText({"", out.dialect, 1.0, out.records});
    if (!text) {
        return;  // a tool without a number, in plain APT
    }
    const test::ReadOut again = test::readOut(*text);
    if (again.report.hasErrors() || again.records.size() != out.records.size() ||
        clText({"", out.dialect, 1.0, again.records}).value_or("") != *text) {
        std::abort();
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    ClReaderOptions options;
    const test::ReadOut whole = test::readOut(text, options);
    options.block_bytes = 1 + size % 61;
    const test::ReadOut pieces = test::readOut(text, options);
    if (whole.text != pieces.text || whole.problems != pieces.problems) {
        std::abort();
    }
    constexpr double largest_mm = 1e6;  // beyond it the last bits of a point matter to the tests of arcs
    double extent_mm = 0.0;
    for (const ClRecord& record : whole.records) {
        if (const auto* motion = std::get_if<LinearMotion>(&record.statement)) {
            extent_mm = std::max(extent_mm, motion->location.tip_mm.norm());
            const bool unit = std::abs(motion->location.axis.norm() - 1.0) < 1e-12;
            if (!unit || !motion->location.tip_mm.allFinite()) {
                std::abort();
            }
        }
        if (const auto* arc = std::get_if<ArcMotion>(&record.statement)) {
            extent_mm = std::max({extent_mm, arc->end.tip_mm.norm(), arc->center_mm.norm()});
            const bool unit = std::abs(arc->normal.norm() - 1.0) < 1e-12;
            const double off_mm =
                std::abs((arc->end.tip_mm - arc->center_mm).cross(arc->normal).norm() - arc->radius_mm);
            const double extent = 1.0 + arc->end.tip_mm.norm() + arc->center_mm.norm();
            if (!unit || !(arc->radius_mm > 0.0) || !(off_mm <= arc_tolerance_mm + 1e-12 * extent)) {
                std::abort();
            }
        }
    }
    if (!whole.report.hasErrors() && extent_mm < largest_mm) {
        writeAndReadBack(whole);
    }
    return 0;
}
