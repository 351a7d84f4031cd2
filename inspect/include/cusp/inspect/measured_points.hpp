// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Measured points as every reader delivers them: positions in mm, and what else the file said.
#pragma once

#include <cusp/geometry/frames.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cusp::inspect {

using geometry::RigidTransform;
using geometry::Vector3;

/// What a measured point is: a point of the surface, or the centre of the probe's ball that touched it.
enum class PointKind { Surface, Centre };

/// Points in the order of the file, lengths in mm, in the frame the file has. The vectors but `positions` are empty or of
/// the same size.
struct MeasuredPoints {
    std::string source;  ///< the file's name, for messages
    std::string format;  ///< "csv", "dmis", "pc-dmis", "calypso", "pcd", "ply", "qif"
    std::vector<Vector3> positions;
    std::vector<Vector3> directions;     ///< unit vectors i, j, k of the file
    std::vector<std::uint64_t> lines;    ///< line of each point, counted from 1
    std::vector<std::int32_t> sections;  ///< index into `section_labels`, −1 for none
    std::vector<std::string> section_labels;
    std::vector<double> weights;            ///< of a column "weight", none negative
    double mm_per_unit = 1.0;               ///< already applied
    bool unit_stated = false;               ///< by the file or by the caller; otherwise mm was assumed
    std::optional<PointKind> kind;          ///< stated by the file or by the caller
    std::optional<double> probe_radius_mm;  ///< stated by the file

    [[nodiscard]] std::size_t size() const { return positions.size(); }
};

}  // namespace cusp::inspect
