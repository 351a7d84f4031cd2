// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From the words of G2 and G3 to the arc they describe.
#pragma once

#include "block_content.hpp"

#include <cusp/post/reader/executed_program.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace cusp::post::reader {

struct ArcRequest {
    Vector3 start_mm;
    Vector3 end_mm;
    std::string_view plane;  ///< G17, G18, G19
    bool clockwise = false;
    bool through = false;      ///< CIP
    bool incremental = false;  ///< G91, for the intermediate point of CIP
    double mm_per_unit = 1.0;
};

/// For AR with a centre and no end point in the plane: where the arc ends; nothing, and no problem, in other cases.
[[nodiscard]] std::optional<Vector3> endByAngle(const BlockContent& content, const ArcRequest& request,
                                                std::string& problem);

/// In the coordinates of the program. Nothing, with the reason in `problem`, when no arc fits.
[[nodiscard]] std::optional<Arc> makeArc(const BlockContent& content, const ArcRequest& request, std::string& problem);

}  // namespace cusp::post::reader
