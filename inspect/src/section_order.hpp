// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The order of points along a section of any shape: folded, closed, or in several pieces.
#pragma once

#include <cusp/geometry/closest_point.hpp>
#include <cusp/inspect/measured_points.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace cusp::inspect {

/// A point of the nominal section with its unit tangent in the plane. Tangents follow axis × outward normal, so along a
/// connected piece all run the same way; zero where surface and plane are parallel.
struct SectionStation {
    Vector3 position = Vector3::Zero();
    Vector3 tangent = Vector3::Zero();
};

/// The plane a section lies in.
struct SectionPlane {
    int axis = 0;
    double position_mm = 0.0;
};

/// Moves points and their normals on the nominal to where surface and plane meet: Newton's steps along the surface, each
/// answered by the nominal itself.
[[nodiscard]] std::vector<SectionStation> stationsIn(const SectionPlane& plane, std::vector<Vector3> positions,
                                                     std::vector<Vector3> normals,
                                                     const geometry::NominalShape& nominal);

/// Length of an arc with this chord whose tangents turn by this angle, exact for a circle.
[[nodiscard]] double arcLength(const SectionStation& from, const SectionStation& to);

/// Length along the nominal section between two stations; nothing where the section does not lead from one to the other.
[[nodiscard]] std::optional<double> lengthAlong(const SectionPlane& plane, const SectionStation& from,
                                                const SectionStation& to, const geometry::NominalShape& nominal);

/// A connected piece: stations in order, and the length from each to the one before it (the first: 0).
struct SectionPiece {
    std::vector<std::uint32_t> stations;
    std::vector<double> step_mm;
};

/// Links every station to the nearest one ahead (chord and both tangents agree), shortest links first, each station once;
/// links much longer than the others must lead along the nominal. Ends that the nominal connects are joined. Pieces come in
/// the order of their first measured point and run in the direction in which they were measured; a closed one begins at its
/// first measured point.
[[nodiscard]] std::vector<SectionPiece> orderedPieces(const SectionPlane& plane,
                                                      const std::vector<SectionStation>& stations,
                                                      const geometry::NominalShape& nominal);

}  // namespace cusp::inspect
