// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The pieces of the profile, and the one of them on which a line is met.
#include "drop_profile.hpp"

#include <cusp/simulation/cutter_body.hpp>

#include <algorithm>
#include <numbers>

namespace cusp::tilt::detail {
namespace {

/// Way along the line at which the distance from the axis is `rho`.
double wayAt(double rho, double aside) { return rho > aside ? std::sqrt((rho - aside) * (rho + aside)) : 0.0; }

/// On a cone of slope 1/k the line is met where s/rho = k.
double coneContact(double aside, double k) { return aside * k / std::sqrt((1.0 - k) * (1.0 + k)); }

}  // namespace

base::Result<DropProfile> DropProfile::make(const geometry::Cutter& cutter) {
    const auto body = simulation::CutterBody::make(cutter);
    if (!body) return base::fail(body.error());
    DropProfile profile;
    const double a = cutter.point_angle_rad;
    const double b = cutter.taper_angle_rad;
    const double r = cutter.corner_radius_mm;
    // As in CutterBody: the corner touches the bottom line through the tip and the flank line through d/2.
    const double reach = cutter.diameter_mm / 2.0 * std::cos(b) - r;
    profile.corner_radius_ = r;
    profile.corner_rho_ = std::max(0.0, (reach * std::cos(a) + r * std::sin(b)) / std::cos(a + b));
    profile.corner_z_ = (reach * std::sin(a) + r * std::cos(b)) / std::cos(a + b);
    profile.bottom_angle_ = a;
    profile.bottom_tan_ = std::tan(a);
    profile.bottom_end_ = profile.corner_rho_ + r * std::sin(a);
    profile.corner_end_ = profile.corner_rho_ + r * std::cos(b);
    profile.corner_end_height_ = profile.corner_z_ - r * std::sin(b);
    profile.flank_angle_ = b;
    profile.flank_is_upright_ = b <= 0.0;
    profile.flank_cot_ = profile.flank_is_upright_ ? 0.0 : 1.0 / std::tan(b);
    profile.radius_ = profile.flank_is_upright_ ? profile.corner_end_ : body->largestRadius();
    return profile;
}

double DropProfile::lineContact(double aside, double slope) const {
    if (slope <= 0.0) return 0.0;
    const double bottom_way = wayAt(bottom_end_, aside);
    if (bottom_way > 0.0 && slope < bottom_tan_ * bottom_way / bottom_end_)
        return coneContact(aside, slope / bottom_tan_);
    const double corner_way = wayAt(corner_end_, aside);
    const bool on_corner = flank_is_upright_ || (corner_way > 0.0 && slope < flank_cot_ * corner_way / corner_end_);
    if (on_corner) return corner_radius_ > 0.0 ? cornerContact(aside, slope, bottom_way) : corner_way;
    const double k = slope / flank_cot_;
    const double end = wayAt(radius_, aside);
    return k < 1.0 ? std::clamp(coneContact(aside, k), corner_way, end) : end;
}

/// A ball in closed form. On a torus the contact is at the angle t of the corner arc with
/// sin t · √(rho² − aside²) = slope · rho · cos t, rho = e + r sin t: one root between the ends of the arc, by Newton's
/// method kept within its bracket.
double DropProfile::cornerContact(double aside, double slope, double least) const {
    if (corner_rho_ <= 0.0) {
        const double left = corner_radius_ * corner_radius_ - aside * aside;
        return std::max(least, (left > 0.0 ? std::sqrt(left) : 0.0) * slope / std::sqrt(1.0 + slope * slope));
    }
    double low = bottom_angle_;
    if (aside > bottom_end_) low = std::asin(std::min(1.0, (aside - corner_rho_) / corner_radius_));
    double high = std::numbers::pi / 2.0 - flank_angle_;
    double t = std::clamp(std::atan(slope), low, high);
    constexpr int most_steps = 60;
    constexpr double angle_tolerance = 1e-15;
    for (int step = 0; step < most_steps && high - low > angle_tolerance; ++step) {
        const double sine = std::sin(t);
        const double cosine = std::cos(t);
        const double rho = corner_rho_ + corner_radius_ * sine;
        const double way = wayAt(rho, aside);
        const double value = sine * way - slope * rho * cosine;
        (value > 0.0 ? high : low) = t;
        const double rise = way > 0.0 ? sine * rho * corner_radius_ * cosine / way : 0.0;
        const double by_t = cosine * way + rise - slope * (corner_radius_ * cosine * cosine - rho * sine);
        double next = by_t > 0.0 ? t - value / by_t : low;
        if (!(next > low && next < high)) next = (low + high) / 2.0;
        if (std::abs(next - t) < angle_tolerance) break;
        t = next;
    }
    return std::max(least, wayAt(corner_rho_ + corner_radius_ * std::sin(t), aside));
}

}  // namespace cusp::tilt::detail
