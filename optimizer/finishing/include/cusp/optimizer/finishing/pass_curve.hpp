// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The curve on a face that a pass follows with its contact points.
#pragma once

#include <cusp/geometry/surface_face.hpp>
#include <cusp/optimizer/finishing/tool_placement.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace cusp::finishing {

using FaceParameters = std::array<double, 2>;

/// A point of a pass: the surface there and the frame of the feed.
struct PassPoint {
    geometry::SurfacePoint surface;
    FeedFrame frame;
    FaceParameters uv{};
};

/// A curve in the parameters of a face, continuous with its tangent, over t in [0, 1]. It lies on the surface everywhere.
class PassCurve {
public:
    /// At least two samples, taken at equal steps of t; between them cubic Hermite pieces. The face must outlive this. `lane`
    /// counts the places across a face: the pieces of a pass that a hole or a bay cuts have the same one.
    PassCurve(const geometry::SurfaceFace& face, std::uint32_t face_index, std::vector<FaceParameters> samples,
              std::uint32_t lane);

    [[nodiscard]] FaceParameters parameters(double t) const;
    [[nodiscard]] Vector3 position(double t) const;
    /// Where the curve stands still or the surface has no normal, the frame is that of the nearest place that has one.
    [[nodiscard]] PassPoint at(double t) const;
    /// Along the surface, mm, by `parts` chords.
    [[nodiscard]] double length(int parts = 32) const;
    void reverse();

    [[nodiscard]] std::uint32_t faceIndex() const { return face_index_; }
    [[nodiscard]] std::uint32_t lane() const { return lane_; }
    [[nodiscard]] const geometry::SurfaceFace& face() const { return *face_; }
    [[nodiscard]] const std::vector<FaceParameters>& samples() const { return samples_; }

private:
    struct Place {
        FaceParameters uv{};
        FaceParameters slope{};
    };
    [[nodiscard]] Place placeAt(double t) const;
    [[nodiscard]] FaceParameters slopeOf(std::size_t sample) const;

    const geometry::SurfaceFace* face_;
    std::uint32_t face_index_;
    std::vector<FaceParameters> samples_;
    std::uint32_t lane_;
};

}  // namespace cusp::finishing
