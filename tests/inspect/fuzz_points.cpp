// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of the readers of measured points: any bytes end in points or problems, and the block size changes neither.
#include "points_text.hpp"

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cusp::inspect;
    const std::string text(data, data + size);
    const test::PointsRead whole = test::readText(text);
    const test::PointsRead pieces = test::readText(text, {.block_bytes = 1 + size % 61});
    if (whole.errors != pieces.errors || whole.remarks != pieces.remarks ||
        whole.points.positions != pieces.points.positions)
        std::abort();
    if (whole.errors.empty() == whole.points.positions.empty()) std::abort();
    for (const Vector3& position : whole.points.positions)
        if (!position.allFinite()) std::abort();
    return 0;
}
