// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Pictures of meshes, drawn without a window, as PNG.
#pragma once

#include <cusp/geometry/triangle_mesh.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cusp::cli {

using Rgb = std::array<std::uint8_t, 3>;

class Picture {
public:
    Picture(std::size_t width, std::size_t height, Rgb ground);

    /// Looks at a box from ahead, right and above, all of it in the picture.
    void lookAt(const Eigen::AlignedBox3d& box);
    /// One colour a vertex; lit from the eye's left.
    void draw(const geometry::TriangleMesh& mesh, std::span<const Rgb> colors);
    /// A ring, in front of everything.
    void mark(const geometry::Vector3& at, Rgb color);
    [[nodiscard]] std::string png() const;

private:
    [[nodiscard]] geometry::Vector3 onPicture(const geometry::Vector3& point) const;
    void fill(const std::array<geometry::Vector3, 3>& corners, const std::array<geometry::Vector3, 3>& colors);

    std::size_t width_;
    std::size_t height_;
    geometry::Matrix3 view_ = geometry::Matrix3::Identity();  ///< rows: right, down, towards the eye
    geometry::Vector3 center_ = geometry::Vector3::Zero();
    double scale_ = 1.0;
    std::vector<Rgb> pixels_;
    std::vector<double> depth_;
};

/// PNG of 8-bit RGB rows (ISO/IEC 15948), deflated with fixed codes and runs (RFC 1951).
[[nodiscard]] std::string pngOf(std::span<const Rgb> pixels, std::size_t width, std::size_t height);

}  // namespace cusp::cli
