// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The contact points of a finishing path with the tool on each: passes discretised, orientation chosen.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/cutter.hpp>
#include <cusp/optimizer/finishing/pass_curve.hpp>
#include <cusp/optimizer/finishing/pass_layout.hpp>
#include <cusp/optimizer/finishing/plan_options.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace cusp::finishing {

struct ContactPoint {
    Vector3 position = Vector3::Zero();  ///< on the surface
    FeedFrame frame;
    toolpath::CutterLocation location;
    double lead_rad = 0.0;
    double cross_curvature_per_mm = 0.0;  ///< > 0: concave across the feed
    FaceParameters uv{};
    std::uint32_t face = 0;
    std::uint32_t pass = 0;
    std::uint32_t lane = 0;  ///< PassCurve::lane
};

struct ContactPath {
    geometry::Cutter cutter;
    PlanOptions options;
    std::vector<ContactPoint> points;  ///< pass after pass, in the direction of travel
    std::uint32_t passes = 0;

    [[nodiscard]] std::span<const ContactPoint> pass(std::uint32_t index) const;
};

/// A part to be finished: all of it, or the faces named.
struct Workpiece {
    std::span<const geometry::SurfaceFace> faces;
    const geometry::ParametricSurface* shape = nullptr;  ///< where faces are trimmed
};

/// Lays the passes out and walks along them. Errors: those of `layOutPasses`, `finishing.option`, `finishing.cutter` for a
/// cutter that is no flat, ball or toroidal mill, `finishing.too-many-points`.
[[nodiscard]] base::Result<ContactPath> planContacts(const Workpiece& part, const geometry::Cutter& cutter,
                                                     const PlanOptions& options);

/// The same along passes that are already laid out.
[[nodiscard]] base::Result<ContactPath> walkPasses(const std::vector<PassCurve>& passes, const geometry::Cutter& cutter,
                                                   const PlanOptions& options);

}  // namespace cusp::finishing
