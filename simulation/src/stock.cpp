// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Making stocks, and reading them.
#include <cusp/simulation/stock.hpp>

#include "dexel_tile.hpp"
#include "solid_rays.hpp"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace cusp::simulation {

using geometry::Vector3;

namespace {

/// Rays are numbered by 32 bits in places; more than this along one axis is no milling simulation.
constexpr double most_nodes = 60000.0;

base::Result<DexelLattice> checked(const Eigen::AlignedBox3d& box, const StockOptions& options) {
    const Vector3 size = box.sizes();
    if (box.isEmpty() || !size.allFinite() || !(size.minCoeff() > 0.0))
        return base::fail("simulation.stock", "the stock has no volume: its box is empty or flat");
    const double resolution = options.resolution_mm;
    if (!(resolution > 0.0) || !(size.maxCoeff() / resolution <= most_nodes))
        return base::fail(
            "simulation.resolution",
            fmt::format("a resolution of {} mm is not possible: it must be above 0 and give at most {:.0f} "
                        "rays along the {:g} mm of the stock",
                        resolution, most_nodes, size.maxCoeff()));
    if (resolution > size.minCoeff())
        return base::fail("simulation.resolution",
                          fmt::format("a resolution of {:g} mm is coarser than the stock is wide ({:g} mm)", resolution,
                                      size.minCoeff()));
    DexelLattice lattice = DexelLattice::over(box, resolution);
    const std::uint64_t needed = Stock::memoryOf(lattice);
    constexpr double mb = 1e6;
    if (needed > options.memory_bytes)
        return base::fail(
            "simulation.memory",
            fmt::format("{} × {} × {} mm at {} mm take {:.0f} MB, more than the {:.0f} MB allowed; {:.3g} mm would fit",
                        size[0], size[1], size[2], resolution, static_cast<double>(needed) / mb,
                        static_cast<double>(options.memory_bytes) / mb,
                        1.05 * resolution *
                            std::sqrt(static_cast<double>(needed) / static_cast<double>(options.memory_bytes))));
    return lattice;
}

/// Fills every tile, in parallel, with the spans `spans_of(axis, u, v, out)` appends for its rays.
template <class SpansOf>
void fill(Stock& stock, const SpansOf& spans_of) {
    for (int axis = 0; axis < 3; ++axis) {
        auto& tiles = StockAccess::tiles(stock, axis);
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size()), [&](const auto& range) {
            std::vector<DexelSpan> spans;
            for (std::size_t index = range.begin(); index < range.end(); ++index) {
                const TileFrame frame(stock.lattice(), axis, index);
                auto tile = std::make_shared<DexelTile>();
                for (std::size_t i = frame.first_u; i < frame.first_u + DexelTile::side; ++i)
                    for (std::size_t j = frame.first_v; j < frame.first_v + DexelTile::side; ++j) {
                        spans.clear();
                        if (i < frame.end_u && j < frame.end_v) spans_of(axis, i, j, spans);
                        tile->append(frame.index(i, j), spans);
                    }
                tiles[index] = std::move(tile);
            }
        });
    }
}

/// Looks from a grid of places in and around a shape: none may see an edge where it ends, and none around it may be inside.
base::Result<void> checkEncloses(const geometry::NominalShape& shape) {
    constexpr int places = 12;
    constexpr double around = 0.05;  // of the size of the shape
    const Eigen::AlignedBox3d box = shape.bounds();
    const Vector3 grow = Vector3::Constant(around * box.sizes().maxCoeff());
    const Eigen::AlignedBox3d outer(Vector3(box.min() - grow), Vector3(box.max() + grow));
    std::vector<Vector3> points;
    for (int i = 0; i < places; ++i)
        for (int j = 0; j < places; ++j)
            for (int k = 0; k < places; ++k)
                points.emplace_back(outer.min() + outer.sizes().cwiseProduct(Vector3(i, j, k)) / (places - 1));
    std::vector<geometry::Footpoint> found(points.size());
    shape.closest(points, found, false);
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Vector3& at = found[i].position;
        if (found[i].on_boundary)
            return base::fail("simulation.open-shape",
                              fmt::format("the shape does not close a volume: it ends at X{:.3f} Y{:.3f} Z{:.3f}; the "
                                          "stock must be a solid, or a box",
                                          at.x(), at.y(), at.z()));
        if (found[i].distance_mm < 0.0 && !box.contains(points[i]))
            return base::fail(
                "simulation.open-shape",
                fmt::format("the shape does not close a volume: at X{:.3f} Y{:.3f} Z{:.3f} its material is "
                            "on the outside; the stock must be a solid, or a box",
                            at.x(), at.y(), at.z()));
    }
    return {};
}

}  // namespace

DexelLattice DexelLattice::over(const Eigen::AlignedBox3d& box, double resolution_mm) {
    DexelLattice lattice;
    lattice.box = box;
    for (int axis = 0; axis < 3; ++axis) {
        const double size = box.sizes()[axis];
        // A size that is a multiple but for rounding gets no extra ray.
        lattice.count[axis] = static_cast<std::size_t>(std::max(1.0, std::ceil(size / resolution_mm * (1.0 - 1e-12))));
        lattice.step_mm[axis] = size / static_cast<double>(lattice.count[axis]);
    }
    return lattice;
}

std::uint64_t Stock::memoryOf(const DexelLattice& lattice) {
    std::uint64_t bytes = std::uint64_t{64} << 20U;  // sweeps of a batch of moves, working copies
    for (int axis = 0; axis < 3; ++axis) {
        const std::uint64_t tiles = static_cast<std::uint64_t>(StockAccess::tilesAlong(lattice, (axis + 1) % 3)) *
                                    StockAccess::tilesAlong(lattice, (axis + 2) % 3);
        // Twice the spans of a block: cuts leave more of them, and vectors grow in steps.
        bytes += tiles * (sizeof(DexelTile) + 48 + 2 * DexelTile::rays * sizeof(DexelSpan));
    }
    return bytes;
}

base::Result<Stock> Stock::box(const Eigen::AlignedBox3d& box, const StockOptions& options) {
    const auto lattice = checked(box, options);
    if (!lattice) return base::fail(lattice.error());
    Stock stock = StockAccess::make(*lattice, options.memory_bytes);
    fill(stock, [&](int axis, std::size_t, std::size_t, std::vector<DexelSpan>& out) {
        out.push_back({box.min()[axis], box.max()[axis], DexelSpan::no_cut, DexelSpan::no_cut});
    });
    return stock;
}

base::Result<Stock> Stock::mesh(const geometry::TriangleMesh& mesh, const StockOptions& options) {
    const geometry::MeshEdges edges = geometry::checkEdges(mesh);
    if (mesh.triangles.empty() || !edges.isClosed())
        return base::fail(
            "simulation.open-mesh",
            fmt::format("the mesh does not close a volume: {} edges of one triangle only, {} of more than "
                        "two, {} between triangles that face opposite ways",
                        edges.open, edges.crowded, edges.reversed));
    Eigen::AlignedBox3d box;
    for (const auto& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle) box.extend(mesh.vertices[corner]);
    const auto lattice = checked(box, options);
    if (!lattice) return base::fail(lattice.error());
    Stock stock = StockAccess::make(*lattice, options.memory_bytes);
    std::array<MeshRays, 3> rays{MeshRays(mesh, *lattice, 0), MeshRays(mesh, *lattice, 1), MeshRays(mesh, *lattice, 2)};
    fill(stock, [&](int axis, std::size_t u, std::size_t v, std::vector<DexelSpan>& out) {
        rays[static_cast<std::size_t>(axis)].spans(u, v, out);
    });
    if (!(stock.volume() > 0.0))
        return base::fail("simulation.stock",
                          "the mesh is inside out, or too thin for the resolution: no ray is in it");
    return stock;
}

base::Result<Stock> Stock::shape(const geometry::NominalShape& shape, const Eigen::AlignedBox3d& box,
                                 const StockOptions& options) {
    const auto lattice = checked(box, options);
    if (!lattice) return base::fail(lattice.error());
    Stock stock = StockAccess::make(*lattice, options.memory_bytes);
    fill(stock, [&](int axis, std::size_t u, std::size_t v, std::vector<DexelSpan>& out) {
        Vector3 origin = Vector3::Zero();
        origin[(axis + 1) % 3] = lattice->node((axis + 1) % 3, u);
        origin[(axis + 2) % 3] = lattice->node((axis + 2) % 3, v);
        shapeSpans(shape, *lattice, axis, origin, out);
    });
    return stock;
}

base::Result<Stock> Stock::solid(const geometry::NominalShape& shape, const StockOptions& options) {
    if (const auto size = checked(shape.bounds(), options); !size) return base::fail(size.error());
    if (const auto ok = checkEncloses(shape); !ok) return base::fail(ok.error());
    return Stock::shape(shape, shape.bounds(), options);
}

std::span<const DexelSpan> Stock::ray(int axis, std::size_t u, std::size_t v) const {
    const std::size_t across = StockAccess::tilesAlong(lattice_, (axis + 2) % 3);
    const auto& tile = tiles_[axis][u / DexelTile::side * across + v / DexelTile::side];
    return tile->ray(u % DexelTile::side * DexelTile::side + v % DexelTile::side);
}

double Stock::volume() const {
    double volume = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
        double length = 0.0;
        for (const Tile& tile : tiles_[axis])
            for (std::size_t i = 0; i < DexelTile::rays; ++i)
                for (const DexelSpan& span : tile->ray(i)) length += span.to_mm - span.from_mm;
        volume += length * lattice_.step_mm[(axis + 1) % 3] * lattice_.step_mm[(axis + 2) % 3];
    }
    return volume / 3.0;
}

bool Stock::contains(const Vector3& point) const {
    if (!lattice_.box.contains(point)) return false;
    const auto nearest = [&](int axis) {
        const double at = std::floor((point[axis] - lattice_.box.min()[axis]) / lattice_.step_mm[axis]);
        return std::min(static_cast<std::size_t>(std::max(at, 0.0)), lattice_.count[axis] - 1);
    };
    const auto spans = ray(2, nearest(0), nearest(1));
    return std::any_of(spans.begin(), spans.end(),
                       [&](const DexelSpan& span) { return span.from_mm <= point[2] && point[2] <= span.to_mm; });
}

}  // namespace cusp::simulation
