// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The criteria of Fountas 2017 on the contacts of a CL file, whoever made it.
#pragma once

#include <cusp/optimizer/finishing/cut_contact.hpp>

#include <cstddef>
#include <span>

namespace cusp::finishing {

/// Least, mean and greatest of something; all 0 where there was nothing.
struct Spread {
    double least = 0.0;
    double mean = 0.0;
    double most = 0.0;
    std::size_t count = 0;

    void take(double value);
};

struct PathCriteria {
    std::size_t cc_points = 0;
    std::size_t passes = 0;
    /// Eq. 1–3: between neighbouring contacts of a pass, along the normal. Eq. 1 gives a curvature and eq. 3 needs its inverse;
    /// the angle is that between the normals within the plane of chord and normal, since turned about the chord (geodesic
    /// torsion) they would count for a bend that is none.
    Spread chord_error_mm;
    Spread effective_radius_mm;  ///< eq. 4, where it is finite
    Spread lead_rad;
    Spread tilt_rad;
    /// Along the surface to the next pass on either side, and the ridge between (eq. 4 with the curvature across the feed);
    /// below 0 where the cutter is flatter than the surface is hollow and cuts into it.
    Spread step_over_mm;
    Spread scallop_mm;
    double undercut_edge_mm = 0.0;   ///< h_u: the most, of flat cutters with the edge radius given
    double cutting_length_mm = 0.0;  ///< over the contacts
    std::size_t singular_leads = 0;  ///< contacts where eq. 4 has no value (lead 0 and no ball)
};

/// Eq. 1–3 for two contacts, mm.
[[nodiscard]] double chordError(const CutContact& from, const CutContact& to);

/// `cutters` as in the path. `edge_radius_mm`: of the inserts of flat cutters, for h_u.
[[nodiscard]] PathCriteria judgeContacts(std::span<const CutContact> contacts,
                                         std::span<const geometry::Cutter> cutters, double edge_radius_mm = 0.0);

}  // namespace cusp::finishing
