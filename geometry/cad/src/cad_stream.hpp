// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What the CAD reader hands over: faces as rational B-splines and edges, as plain numbers in a stream of bytes.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/surface_face.hpp>
#include <cusp/geometry/surface_forms.hpp>
#include <cusp/geometry/trim_edge.hpp>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::geometry::cad {

struct StreamedFace {
    BSplineForm surface;
    bool reversed = false;  ///< the material lies on the side of du × dv
};

struct StreamedUse {
    std::size_t face = 0;
    BSplineCurveForm parameters;
};

struct StreamedEdge {
    bool is_point = false;  ///< a pole: no curve in space
    BSplineCurveForm curve;
    std::vector<StreamedUse> uses;
};

/// All in mm.
struct CadModel {
    std::vector<StreamedFace> faces;
    std::vector<StreamedEdge> edges;
};

/// Numbers as eight bytes each, in the order of the processor: both ends run on one machine.
[[nodiscard]] std::string toStream(const CadModel& model);
/// Error `cad.stream`: the reader wrote something else, which is a fault of cusp or of the library behind it.
[[nodiscard]] base::Result<CadModel> fromStream(std::string_view bytes, const std::string& file_name);

}  // namespace cusp::geometry::cad
