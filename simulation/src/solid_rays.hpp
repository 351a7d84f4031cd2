// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where the rays of a lattice run inside a mesh or a shape.
#pragma once

#include <cusp/simulation/stock.hpp>

#include <cstdint>
#include <vector>

namespace cusp::simulation {

/// All rays along one axis through a closed mesh. A ray that meets an edge or a corner is counted as if it passed a hair's
/// breadth beside it, the same for all triangles there, so that it enters as often as it leaves.
class MeshRays {
public:
    MeshRays(const geometry::TriangleMesh& mesh, const DexelLattice& lattice, int axis);
    /// Appends the spans of the ray at node u, v.
    void spans(std::size_t u, std::size_t v, std::vector<DexelSpan>& out) const;

private:
    struct Crossing {
        double at_mm;
        int turn;  ///< +1 into the material, −1 out of it
    };
    template <class Visit>
    void rasterise(const geometry::TriangleMesh& mesh, const DexelLattice& lattice, const Visit& visit) const;

    int axis_;
    std::size_t across_;
    std::vector<std::uint64_t> first_;  ///< of each ray's crossings
    std::vector<Crossing> crossings_;
};

/// Appends the stretches with a negative signed distance, of the ray along `axis` through `origin`, within the lattice's box.
/// Steps as long as the distance is cannot miss a change of sign; where the ray grazes, what is thinner than a thousandth of
/// the step may be missed.
void shapeSpans(const geometry::NominalShape& shape, const DexelLattice& lattice, int axis,
                const geometry::Vector3& origin, std::vector<DexelSpan>& out);

}  // namespace cusp::simulation
