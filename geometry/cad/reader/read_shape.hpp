// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A STEP or IGES file as an OCCT shape, in mm.
#pragma once

#include <TopoDS_Shape.hxx>

#include <string>
#include <vector>

namespace cusp::geometry::cad {

struct ReadShape {
    TopoDS_Shape shape;
    std::string error_code;  ///< empty when there is a shape
    std::string message;
    std::vector<std::string> warnings;  ///< "code: message"
};

/// All roots of the file; those that cannot be translated are warnings. May throw what OCCT throws.
[[nodiscard]] ReadShape readShape(bool step, const std::string& path);

}  // namespace cusp::geometry::cad
