// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// How much of a solid that does not change a moving tool's shank, holder and head go through: the question a search asks often.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/simulation/milling.hpp>
#include <cusp/simulation/stock.hpp>

#include <memory>
#include <span>

namespace cusp::simulation {

struct CollisionQuery {
    double sweep_tolerance_mm = 0.01;
    double touch_tolerance_mm = 0.01;
    bool with_cutter = false;  ///< the cutter must not touch either (fixtures, tables)
    std::uint32_t first_move = 0;
};

struct CollisionVolume {
    double volume_mm3 = 0.0;  ///< of the union over all moves
    double depth_mm = 0.0;    ///< of the deepest
    std::vector<Collision> collisions;
};

/// A solid with a field of distances around it, so that moves that stay clear cost a few look-ups each.
class CollisionField {
public:
    explicit CollisionField(Stock solid);
    CollisionField(CollisionField&&) noexcept;
    CollisionField& operator=(CollisionField&&) noexcept;
    CollisionField(const CollisionField&) = delete;
    CollisionField& operator=(const CollisionField&) = delete;
    ~CollisionField();

    /// The union of what the assembly's parts sweep, within the solid: each piece counts once, for the first move that meets
    /// it. May be called from several threads at once; the same bits at any number of them.
    [[nodiscard]] CollisionVolume measure(std::span<const ToolMove> moves, std::span<const ToolAssembly> assemblies,
                                          const CollisionQuery& query = {}) const;

    [[nodiscard]] const Stock& solid() const;
    /// Lower bound of the distance to the solid, 0 inside.
    [[nodiscard]] double clearance(const geometry::Vector3& point) const;

private:
    class Field;
    Stock solid_;
    std::unique_ptr<const Field> field_;
};

}  // namespace cusp::simulation
