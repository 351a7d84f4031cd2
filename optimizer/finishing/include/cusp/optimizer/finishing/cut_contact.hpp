// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where the cutter of any CL file touches the surface: contact points and normals, which the file does not hold.
#pragma once

#include <cusp/geometry/closest_point.hpp>
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/optimizer/finishing/contact_path.hpp>
#include <cusp/simulation/tool_move.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace cusp::finishing {

/// A location at which the tool cuts, with the place of the surface it touches.
struct CutContact {
    Vector3 position = Vector3::Zero();  ///< on the surface
    FeedFrame frame;
    LeadTilt angles;
    /// Of the surface across the feed, > 0 concave; absent where the nominal is a mesh.
    std::optional<double> cross_curvature_per_mm;
    double gap_mm = 0.0;  ///< from the surface to the cutter, < 0 where the cutter is in it
    std::uint32_t pass = 0;
    std::uint32_t cutter = 0;  ///< index into CutterPath::cutters
    std::uint32_t line = 0;    ///< of the CL file
};

struct ContactOptions {
    /// A location counts as cutting when the cutter comes this near to the surface, at feed.
    double reach_mm = 0.05;
    /// Between two contacts the feed turns by no more within a pass: a zig-zag that stays on the surface is two passes.
    double turn_rad = 1.0;
};

/// The contacts of a path with a nominal shape. At each location the corner circle's distance to the surface is followed
/// around: of the places where it turns, the one nearest to the surface is the contact (of a cutter that cuts in on both
/// sides, a high one between two low ones). Passes end at links by rapid or off the surface, and at turns.
[[nodiscard]] std::vector<CutContact> findContacts(const simulation::CutterPath& path,
                                                   const geometry::NominalShape& shape,
                                                   const ContactOptions& options = {});

/// The contacts of a planned path, as planned.
[[nodiscard]] std::vector<CutContact> contactsOf(const ContactPath& path);

}  // namespace cusp::finishing
