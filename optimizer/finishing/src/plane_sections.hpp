// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where planes cut a face: curves in its parameters.
#pragma once

#include <cusp/optimizer/finishing/pass_curve.hpp>

#include <array>
#include <cstddef>
#include <vector>

namespace cusp::finishing {

/// Heights of a face over a plane through the origin, on a grid of its parameters; sections at any height come from it.
class PlaneSections {
public:
    /// The face must outlive this. `normal` is a unit vector.
    PlaneSections(const geometry::SurfaceFace& face, const Vector3& normal);

    /// Least and greatest height on the face, to the grid and then refined, mm.
    [[nodiscard]] std::array<double, 2> range() const { return range_; }
    /// The curves of the section, each with `samples` points within 1e-9 mm of the plane, equally spaced in a parameter
    /// of the face where one runs along the curve, else along the surface. Curves shorter than `least_mm` are left out. Closed curves end where they begin.
    [[nodiscard]] std::vector<std::vector<FaceParameters>> at(double height_mm, std::size_t samples,
                                                              double least_mm) const;

private:
    using Chain = std::vector<FaceParameters>;
    [[nodiscard]] double heightOf(const FaceParameters& uv) const;
    [[nodiscard]] FaceParameters onPlane(FaceParameters uv, double height_mm) const;
    [[nodiscard]] FaceParameters crossing(std::size_t edge, double height_mm) const;
    [[nodiscard]] std::vector<Chain> chains(double height_mm) const;
    [[nodiscard]] std::array<std::size_t, 2> endsOf(std::size_t edge) const;
    [[nodiscard]] FaceParameters cornerOf(std::size_t corner) const;
    void joinCell(std::size_t i, std::size_t j, double height_mm,
                  std::vector<std::array<std::size_t, 2>>& neighbours) const;
    [[nodiscard]] std::vector<double> measure(const Chain& chain) const;
    [[nodiscard]] Chain evenly(const Chain& chain, double height_mm, std::size_t samples, double least_mm) const;
    void refineRange();

    const geometry::SurfaceFace* face_;
    Vector3 normal_;
    std::vector<double> grid_u_;
    std::vector<double> grid_v_;
    std::vector<double> heights_;
    std::array<double, 2> range_{};
};

}  // namespace cusp::finishing
