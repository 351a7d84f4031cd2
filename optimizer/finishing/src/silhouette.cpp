// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The core circle of a cutter projects to an ellipse; its corner radius is the offset.
#include "silhouette.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cusp::finishing {

namespace {

using Vector2 = Eigen::Vector2d;

class Silhouette {
public:
    /// Coordinates across the feed: to the left, and along the normal.
    Silhouette(const geometry::Cutter& cutter, double lead_rad, double tilt_rad) : r_(cutter.corner_radius_mm) {
        const Vector2 axis{std::cos(lead_rad) * std::sin(tilt_rad), std::cos(lead_rad) * std::cos(tilt_rad)};
        core_ = cutter.corner_e_mm * cutter.corner_e_mm * (Eigen::Matrix2d::Identity() - axis * axis.transpose());
        contact_ = at(0.0);
    }
    /// Relative to the contact, where the outward normal of the silhouette is turned from straight down by `angle`.
    [[nodiscard]] Vector2 beside(double angle) const { return at(angle) - contact_; }

private:
    [[nodiscard]] Vector2 at(double angle) const {
        const Vector2 down{std::sin(angle), -std::cos(angle)};
        const Vector2 along = core_ * down;
        const double reach = std::sqrt(std::max(0.0, down.dot(along)));
        Vector2 point = r_ * down;
        if (reach > 1e-12) point += along / reach;
        return point;
    }

    double r_;
    Eigen::Matrix2d core_;
    Vector2 contact_ = Vector2::Zero();
};

double surfaceHeight(double x_mm, double curvature_per_mm) {
    const double bend = curvature_per_mm * x_mm;
    return bend * x_mm / (1.0 + std::sqrt(std::max(0.0, 1.0 - bend * bend)));
}

double halfWidth(const Silhouette& shape, double side, double curvature_per_mm, double height_mm) {
    constexpr int looks = 64;
    const auto gap = [&](double angle) {
        const Vector2 point = shape.beside(side * angle);
        return point.y() - surfaceHeight(point.x(), curvature_per_mm);
    };
    double inside = 0.0;
    for (int i = 1; i <= looks; ++i) {
        const double share = static_cast<double>(i) / looks;
        double outside = share * share * share * std::numbers::pi / 2.0;
        if (gap(outside) <= height_mm && i < looks) {
            inside = outside;
            continue;
        }
        for (int k = 0; k < 40; ++k) {
            const double middle = (inside + outside) / 2.0;
            (gap(middle) <= height_mm ? inside : outside) = middle;
        }
        break;
    }
    return std::abs(shape.beside(side * inside).x());
}

}  // namespace

double stripWidth(const geometry::Cutter& cutter, double lead_rad, double tilt_rad, double curvature_per_mm,
                  double height_mm) {
    const Silhouette shape(cutter, lead_rad, tilt_rad);
    return 2.0 * std::min(halfWidth(shape, 1.0, curvature_per_mm, height_mm),
                          halfWidth(shape, -1.0, curvature_per_mm, height_mm));
}

}  // namespace cusp::finishing
