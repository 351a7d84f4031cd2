// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Drop-cutter: how far down an upright cutter comes on a shape, exactly.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/closest_point.hpp>
#include <cusp/geometry/cutter.hpp>
#include <cusp/geometry/triangle_mesh.hpp>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

namespace cusp::tilt {

/// Where a cutter that comes down along −Z is stopped; mm.
struct DropContact {
    double tip_z_mm = 0.0;
    geometry::Vector3 contact_mm = geometry::Vector3::Zero();  ///< the point of the shape that stops it
    std::uint32_t place = no_place;                            ///< triangle or face; a hint for the next drop near by

    static constexpr std::uint32_t no_place = std::numeric_limits<std::uint32_t>::max();
};

/// The one question of the three-axis planner.
class DropShape {
public:
    virtual ~DropShape() = default;

    /// Empty where the cutter passes beside the shape. `hint`: the `place` of a drop near by, for speed; the answer does not
    /// depend on it beyond the last digits. May be called from several threads at once.
    [[nodiscard]] virtual std::optional<DropContact> drop(double x_mm, double y_mm,
                                                          std::uint32_t hint = DropContact::no_place) const = 0;
    [[nodiscard]] virtual Eigen::AlignedBox3d bounds() const = 0;
    [[nodiscard]] virtual const geometry::Cutter& cutter() const = 0;
};

/// On triangles: the exact contact with vertices, edges and facets (Hwang, Chang 1998: the cutter stops at the highest tip
/// height over all of them), each in closed form; for the corner of a toroidal cutter on an edge by Newton's method to the
/// last digit. Triangles count on both sides. A tree of boxes leaves out what cannot stop the cutter higher.
class MeshDrop : public DropShape {
public:
    /// The mesh need not be closed. Errors: `simulation.cutter`; `tilt.empty-mesh`.
    [[nodiscard]] static base::Result<MeshDrop> make(const geometry::TriangleMesh& mesh,
                                                     const geometry::Cutter& cutter);
    MeshDrop(MeshDrop&&) noexcept;
    MeshDrop& operator=(MeshDrop&&) noexcept;
    MeshDrop(const MeshDrop&) = delete;
    MeshDrop& operator=(const MeshDrop&) = delete;
    ~MeshDrop() override;

    [[nodiscard]] std::optional<DropContact> drop(double x_mm, double y_mm,
                                                  std::uint32_t hint = DropContact::no_place) const override;
    [[nodiscard]] Eigen::AlignedBox3d bounds() const override;
    [[nodiscard]] const geometry::Cutter& cutter() const override;

private:
    struct Index;
    explicit MeshDrop(std::unique_ptr<const Index> index);
    std::unique_ptr<const Index> index_;
};

/// A ball end mill on any nominal shape, smooth ones without a mesh in between: the ball comes down by steps that its
/// clearance proves free (the nearest point is certified, geometry/README.md), until less than 1e-7 mm of clearance is left.
/// It never goes through anything thinner than that; where it stops above the exact height, the difference is below
/// 1e-7 mm / cos(slope), and on walls steeper than 89° it may stop higher.
class BallDrop : public DropShape {
public:
    /// `shape` must outlive this. Errors: `simulation.cutter`; `tilt.not-a-ball`.
    [[nodiscard]] static base::Result<BallDrop> make(const geometry::NominalShape& shape,
                                                     const geometry::Cutter& cutter);

    [[nodiscard]] std::optional<DropContact> drop(double x_mm, double y_mm,
                                                  std::uint32_t hint = DropContact::no_place) const override;
    [[nodiscard]] Eigen::AlignedBox3d bounds() const override { return shape_->bounds(); }
    [[nodiscard]] const geometry::Cutter& cutter() const override { return cutter_; }

private:
    BallDrop(const geometry::NominalShape& shape, const geometry::Cutter& cutter) : shape_(&shape), cutter_(cutter) {}
    const geometry::NominalShape* shape_;
    geometry::Cutter cutter_;
};

}  // namespace cusp::tilt
