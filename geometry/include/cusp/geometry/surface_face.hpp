// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One face of a nominal shape: a grid of Bézier patches over a rectangle of parameters, and the side without material.
#pragma once

#include <cusp/geometry/bezier_patch.hpp>
#include <cusp/geometry/surface_point.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cusp::geometry {

/// Which of the two normals points out of the material.
enum class Outward : std::uint8_t { DuCrossDv, DvCrossDu };

/// A face over [u₀, uₘ] × [v₀, vₙ]; patch (i, j) covers [uᵢ, uᵢ₊₁] × [vⱼ, vⱼ₊₁]. Lengths in mm.
class SurfaceFace {
public:
    /// Breaks ascend strictly, at least two each way; `patches` holds (m · n) of them, v running faster.
    SurfaceFace(std::vector<double> breaks_u, std::vector<double> breaks_v, std::vector<BezierPatch> patches,
                Outward outward);

    /// Position and derivatives by u and v; parameters outside the rectangle count as its nearest point.
    [[nodiscard]] SurfacePoint evaluate(double u, double v) const;
    /// Unit, out of the material. At a pole, where du × dv vanishes, the limit from inside the face; zero only where the
    /// face has no area.
    [[nodiscard]] Vector3 normal(double u, double v) const;
    /// 1 when du × dv points out of the material, else −1.
    [[nodiscard]] double outwardSign() const { return outward_ == Outward::DuCrossDv ? 1.0 : -1.0; }

    [[nodiscard]] const std::vector<double>& breaksU() const { return breaks_u_; }
    [[nodiscard]] const std::vector<double>& breaksV() const { return breaks_v_; }
    [[nodiscard]] const std::vector<BezierPatch>& patches() const { return patches_; }
    /// Parameters of the face where patch `index` is at (s, t) of its own unit square.
    [[nodiscard]] std::array<double, 2> faceParameters(std::size_t index, double s, double t) const;

private:
    std::vector<double> breaks_u_;
    std::vector<double> breaks_v_;
    std::vector<BezierPatch> patches_;
    Outward outward_;
};

}  // namespace cusp::geometry
