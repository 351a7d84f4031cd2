// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How much of a part a tilted tool's shank and holder overlap along a path, in a millisecond: the question of the search.
#pragma once

#include <cusp/geometry/closest_point.hpp>
#include <cusp/optimizer/tilt/tilt_job.hpp>
#include <cusp/toolpath/cl_record.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cusp::tilt::detail {

/// Shank and holder as the spheres that fit into them along the axis, and the lower faces of wider rings as points. What is
/// overlapped is a circular segment at each height (as if the part were flat there). Spheres stand so close that they miss
/// the body by 0.01 mm at most; 0.05 mm of guard are added, fading out towards the cutter. The proof of a winner is the
/// simulation's, on the exact bodies and all the motion in between.
class ClearanceProbe {
public:
    /// `shape` must outlive this. `cell_mm`: of the field of distances around the part.
    ClearanceProbe(const geometry::NominalShape& shape, const TiltTool& tool, double stick_out_mm, double cell_mm);
    /// The same part and field with the holder elsewhere.
    ClearanceProbe(const ClearanceProbe& other, const TiltTool& tool, double stick_out_mm);

    /// Sure: only what overlaps beyond the field's own error, by the field alone. Exact: everything.
    enum class Look : std::uint8_t { Sure, Exact };
    /// mm³: mean along the poses of the volume overlapped at each.
    [[nodiscard]] double overlap(std::span<const toolpath::CutterLocation> poses, Look look) const;

private:
    struct Sphere {
        double height = 0.0;
        double radius = 0.0;
        double step = 0.0;  ///< to the next sphere
    };
    struct Face {
        double height = 0.0;
        double radius = 0.0;
        double area = 0.0;  ///< that each point stands for
        std::vector<std::array<double, 2>> points;
    };
    struct Field {
        Eigen::AlignedBox3d box;
        Eigen::AlignedBox3d part;
        std::array<int, 3> count{};
        double cell = 0.0;
        std::vector<float> distance;
    };

    void place(const TiltTool& tool, double stick_out_mm);
    void addRing(double from, double lower_radius, double to, double upper_radius, bool fades);
    void addFace(double height, double inner_radius, double radius);
    void fill(double cell_mm, double reach_mm);
    /// Signed distance to the part, within a cell. An exact look finds it exactly where the field leaves open on which side of
    /// `wanted` it is; a sure one then takes it as on the free side.
    [[nodiscard]] double distance(const geometry::Vector3& point, double wanted, Look look) const;
    [[nodiscard]] double overlapAt(const toolpath::CutterLocation& pose, Look look) const;
    [[nodiscard]] double overlapOfFace(const Face& face, const toolpath::CutterLocation& pose, Look look) const;

    const geometry::NominalShape* shape_;
    std::vector<Sphere> spheres_;
    std::vector<Face> faces_;
    std::shared_ptr<Field> field_;
};

}  // namespace cusp::tilt::detail
