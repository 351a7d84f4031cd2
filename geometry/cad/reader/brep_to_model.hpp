// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// An OCCT shape as faces and edges of our own.
#pragma once

#include "cad_stream.hpp"

#include <TopoDS_Shape.hxx>

namespace cusp::geometry::cad {

/// Every face as a rational B-spline, every edge with its curve in space and in the parameters of each face that uses it. May
/// throw what OCCT throws.
[[nodiscard]] CadModel modelOf(const TopoDS_Shape& shape);

}  // namespace cusp::geometry::cad
