// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The public face of the index, and many queries at once.
#include "surface_index.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cassert>
#include <utility>

namespace cusp::geometry {

ParametricSurface::ParametricSurface(std::vector<SurfaceFace> faces)
    : ParametricSurface(std::move(faces), std::vector<TrimEdge>()) {}
ParametricSurface::ParametricSurface(std::vector<SurfaceFace> faces, std::vector<TrimEdge> edges)
    : index_(std::make_unique<const Index>(std::move(faces), std::move(edges))) {}
ParametricSurface::ParametricSurface(ParametricSurface&&) noexcept = default;
ParametricSurface& ParametricSurface::operator=(ParametricSurface&&) noexcept = default;
ParametricSurface::~ParametricSurface() = default;

Footpoint ParametricSurface::closest(const Vector3& query) const { return index_->closest(query, nullptr); }

void ParametricSurface::closest(std::span<const Vector3> queries, std::span<Footpoint> footpoints, bool warm) const {
    assert(queries.size() == footpoints.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, queries.size(), 256), [&](const auto& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
            footpoints[i] = index_->closest(queries[i], warm ? &footpoints[i] : nullptr);
        }
    });
}

Eigen::AlignedBox3d ParametricSurface::bounds() const { return index_->bounds(); }

const std::vector<SurfaceFace>& ParametricSurface::faces() const { return index_->faces(); }

std::size_t ParametricSurface::trimmedFaces() const { return index_->trimmedFaces(); }

}  // namespace cusp::geometry
