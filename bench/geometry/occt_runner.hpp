// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The same footpoints by OCCT's extrema, the fastest way that searches the whole surface: one object, algorithm Tree.
#pragma once

#include <cusp/geometry/surface_forms.hpp>

#include <memory>

namespace cusp::bench {

class OcctRunner {
public:
    explicit OcctRunner(const geometry::BSplineForm& form);
    ~OcctRunner();
    /// Distance in mm; negative when OCCT finds no extremum (its search does not include the boundary).
    [[nodiscard]] double distance(const geometry::Vector3& query);

private:
    struct Surface;
    std::unique_ptr<Surface> surface_;
};

}  // namespace cusp::bench
