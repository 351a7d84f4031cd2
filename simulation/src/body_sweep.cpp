// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// First and last point of a ray in a swept body, by planes below the distance.
//
// Let G(s, t) be the distance of the ray's point s to the body at time t. Where the tool only shifts, G is convex in (s, t)
// together, so the swept stretch of a ray is one, and every tangent plane of G bounds it from below: the entry is where two
// such planes, of opposite slope in t, first allow G ≤ 0, and with the second taken at the first's zero they close in on it
// as Newton's method does.
// Where the axis turns by θ, points move on curves as seen from the tool, with |y''| ≤ K = θ²·w + 2θL (w the farthest point
// of the body from the tip, L the length of the move) along t, and 2θ·|Δs| more where s changes too. A part is made so short
// that K ≤ 2ε: planes are then wrong by at most K/2 = ε. Two places in the sweep, Δs and Δt apart, have nothing between them
// that is farther outside than (K·Δt² + 2θ·Δt·Δs)/8; where this is more than ε, the ray takes the part in two halves.
#include "body_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cusp::simulation {

using geometry::Vector3;

namespace {

constexpr double most_turn_rad = 0.1;
/// On the distance: 1e-6 mm along rays that enter at 1 in 10.
constexpr double stop_mm = 1e-7;
constexpr int most_steps = 100;
/// What the search may have left open when it ran out of steps.
constexpr double close_mm = 1e-5;
constexpr int most_levels = 8;

/// The box of a turned body at a pose: the cylinder around it.
void extend(Eigen::AlignedBox3d& box, const CutterBody& body, const Vector3& tip, const Vector3& axis) {
    const Vector3 reach = body.largestRadius() * (Vector3::Ones() - axis.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
    for (const double height : {body.base(), body.height()}) {
        const Vector3 center = tip + height * axis;
        box.extend(Vector3(center - reach));
        box.extend(Vector3(center + reach));
    }
}

}  // namespace

void BodySweep::split(const ToolMove& move, const CutterBody& body, double tolerance_mm, std::uint32_t tag,
                      std::vector<BodySweep>& out) {
    constexpr double no_turn_rad = 1e-9;
    const double angle = geometry::angleBetween(move.from.axis, move.to.axis);
    const double turn = angle > no_turn_rad ? angle : 0.0;
    const Vector3 way = move.to.tip_mm - move.from.tip_mm;
    const double far = std::hypot(std::max(std::abs(body.base()), body.height()), body.largestRadius());
    const double bend = turn * turn * far + 2.0 * turn * way.norm();
    const int parts = std::max({1, static_cast<int>(std::ceil(turn / most_turn_rad)),
                                static_cast<int>(std::ceil(std::sqrt(bend / (2.0 * tolerance_mm))))});
    // The way the axis turns; where it does not, any direction across it, the feed if there is one.
    Vector3 side = turn > 0.0 ? Vector3(move.to.axis - move.to.axis.dot(move.from.axis) * move.from.axis)
                              : Vector3(way - way.dot(move.from.axis) * move.from.axis);
    if (side.squaredNorm() < 1e-24) side = move.from.axis.unitOrthogonal();
    side.normalize();
    for (int i = 0; i < parts; ++i) {
        const double middle = turn * (i + 0.5) / parts;
        BodySweep part;
        part.body_ = &body;
        part.tag_ = tag;
        part.way_ = way / parts;
        part.tip_ = move.from.tip_mm + i * part.way_;
        const Vector3 axis = std::cos(middle) * move.from.axis + std::sin(middle) * side;
        const Vector3 turned_side = std::cos(middle) * side - std::sin(middle) * move.from.axis;
        part.frame_.row(0) = turned_side;
        part.frame_.row(1) = axis.cross(turned_side);
        part.frame_.row(2) = axis;
        const Vector3 local = part.frame_ * part.way_;
        part.local_way_ = {local[0], local[1], local[2]};
        part.turn_rad_ = turn / parts;
        part.bend_mm_ = bend / (static_cast<double>(parts) * parts);
        part.tolerance_mm_ = tolerance_mm;
        part.by_ball_ = turn == 0.0 && body.ballRadius() > 0.0;
        const double half = 0.5 * part.turn_rad_;
        extend(part.box_, body, part.tip_, std::cos(half) * axis - std::sin(half) * turned_side);
        extend(part.box_, body, part.tip_ + part.way_, std::cos(half) * axis + std::sin(half) * turned_side);
        // Between both ends the body bulges by no more than the sagitta of K.
        const Vector3 bulge = Vector3::Constant(part.bend_mm_ / 8.0);
        part.box_ = Eigen::AlignedBox3d(Vector3(part.box_.min() - bulge), Vector3(part.box_.max() + bulge));
        out.push_back(part);
    }
}

BodySweep::Probe BodySweep::probe(const Ray& ray, double s, double t) const {
    const double y1 = ray.at[0] + s * ray.direction[0] - t * local_way_[0];
    const double y2 = ray.at[1] + s * ray.direction[1] - t * local_way_[1];
    const double y3 = ray.at[2] + s * ray.direction[2] - t * local_way_[2];
    if (turn_rad_ == 0.0) {
        const double beside = std::sqrt(y1 * y1 + y2 * y2);
        const CutterBody::Value still = body_->at(beside, y3);
        const double outward = beside > 1e-12 ? still.by_rho / beside : 0.0;
        return {still.distance_mm,
                still.by_z * ray.direction[2] + outward * (y1 * ray.direction[0] + y2 * ray.direction[1]),
                -still.by_z * local_way_[2] - outward * (y1 * local_way_[0] + y2 * local_way_[1])};
    }
    // Taylor: the angle is at most 0.05, the first term left out 2e-14.
    const double angle = turn_rad_ * (t - 0.5);
    const double square = angle * angle;
    const double sine = angle * (1.0 - square / 6.0 * (1.0 - square / 20.0));
    const double cosine = 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0));
    const double z = cosine * y3 + sine * y1;
    const double across = cosine * y1 - sine * y3;
    const double rho = std::sqrt(across * across + y2 * y2);
    const CutterBody::Value value = body_->at(rho, z);
    const double radial = rho > 1e-12 ? value.by_rho / rho : 0.0;
    const double z_by_s = cosine * ray.direction[2] + sine * ray.direction[0];
    const double across_by_s = cosine * ray.direction[0] - sine * ray.direction[2];
    const double z_by_t = turn_rad_ * across - (cosine * local_way_[2] + sine * local_way_[0]);
    const double across_by_t = -turn_rad_ * z - (cosine * local_way_[0] - sine * local_way_[2]);
    return {value.distance_mm, value.by_z * z_by_s + radial * (across * across_by_s + y2 * ray.direction[1]),
            value.by_z * z_by_t + radial * (across * across_by_t - y2 * local_way_[1])};
}

namespace {

/// A plane below G: `value + by_s·s + by_t·t`.
struct Plane {
    double value = 0.0, by_s = 0.0, by_t = 0.0;
    bool known = false;
};

/// The first s from here on where a line below G allows G ≤ 0; infinite where it never does.
double rootOf(double value, double by_s, double s) {
    const double here = value + by_s * s;
    if (here <= 0.0) return s;
    return by_s < 0.0 ? s - here / by_s : std::numeric_limits<double>::infinity();
}

/// Where both planes together first allow it: the combination that does not depend on t.
double rootOf(const Plane& falling, const Plane& rising, double s) {
    const double share = rising.by_t / (rising.by_t - falling.by_t);
    return rootOf(share * falling.value + (1.0 - share) * rising.value,
                  share * falling.by_s + (1.0 - share) * rising.by_s, s);
}

}  // namespace

/// Where in time the distance is least, as far as its slopes tell. What was seen at one s is a good guess at the next, and
/// forgotten where it turns out wrong.
class BodySweep::TimeSearch {
public:
    TimeSearch(double from, double to) : from_(from), to_(to), low_(from), high_(to) {}

    void saw(double t, double by_t) {
        if (by_t < 0.0) {
            low_ = t;
            low_slope_ = by_t;
            if (high_ <= low_ + least * (to_ - from_)) forget(high_, high_slope_, to_);
        } else {
            high_ = t;
            high_slope_ = by_t;
            if (low_ >= high_ - least * (to_ - from_)) forget(low_, low_slope_, from_);
        }
    }
    /// `vertex`: where the planes below G meet.
    [[nodiscard]] double next(int step, double vertex) const {
        if (high_slope_ == 0.0) return high_;
        if (low_slope_ == 0.0) return low_;
        const double middle = 0.5 * (low_ + high_);
        if (step % 4 == 3) return middle;
        const double guess = step % 2 == 1 && std::isfinite(vertex)
                                 ? vertex
                                 : low_ - (high_ - low_) * low_slope_ / (high_slope_ - low_slope_);
        return guess > low_ && guess < high_ ? guess : middle;
    }

private:
    static constexpr double least = 1e-7;
    static void forget(double& end, double& slope, double to) {
        end = to;
        slope = 0.0;
    }

    double from_, to_, low_, high_;
    double low_slope_ = 0.0;   ///< < 0; 0 where nothing is known
    double high_slope_ = 0.0;  ///< > 0; likewise
};

bool BodySweep::enter(const Ray& ray, double low, double high, double from, double to, double& s, double& t) const {
    Plane falling;  // by_t < 0: the body comes closer later
    Plane rising;
    TimeSearch search(from, to);
    s = low;
    t = std::clamp(t, from, to);
    for (int step = 0; step < most_steps; ++step) {
        const Probe here = probe(ray, s, t);
        if (here.value <= stop_mm) return true;
        // Forwards only: the turning can bring the ray closer by θ per mm more than the slope says.
        const double by_s = here.by_s - turn_rad_;
        const Plane plane{here.value - by_s * s - here.by_t * t, by_s, here.by_t, true};
        (here.by_t < 0.0 ? falling : rising) = plane;
        search.saw(t, here.by_t);
        const double end = here.by_t < 0.0 ? to : from;
        double root = rootOf(plane.value + plane.by_t * end, by_s, s);
        double vertex = std::numeric_limits<double>::quiet_NaN();
        if (falling.known && rising.known) {
            root = std::max(root, rootOf(falling, rising, s));
            vertex = -(falling.value + falling.by_s * root) / falling.by_t;
        }
        if (root > high) return false;
        s = root;
        if (here.by_t != 0.0 && t != end) t = search.next(step, vertex);
    }
    return probe(ray, s, t).value <= close_mm;
}

BodySweep::Capsule BodySweep::capsule(const Ray& ray) const {
    const double r = body_->ballRadius();
    const auto dot = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
        return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const std::array<double, 3> at{ray.at[0], ray.at[1], ray.at[2] - r};
    const double way_way = dot(local_way_, local_way_);
    const double at_way = dot(at, local_way_);
    const double along_way = dot(ray.direction, local_way_);
    const double at_along = dot(at, ray.direction);
    const double at_at = dot(at, at) - r * r;
    // The cylinder about the way of the centre: |q + s·e|² = r², with the parts of both across the way.
    const double share = way_way > 0.0 ? 1.0 / way_way : 0.0;
    const double a = 1.0 - along_way * along_way * share;
    const double b = at_along - at_way * along_way * share;
    const double c = at_at - at_way * at_way * share;
    const double inside = b * b - a * c;
    if (inside < 0.0) return {};
    Capsule out;
    out.hit = true;
    const double root = std::sqrt(inside);
    const auto end = [&](double sign, double& s, double& t) {
        constexpr double along = 1e-9;
        s = a > along ? (-b + sign * root) / a : 0.0;
        t = (at_way + s * along_way) * share;
        if (a > along && way_way > 0.0 && t >= 0.0 && t <= 1.0) return;
        // Over one of the ends, or along the way: the ball there, or whichever of both comes first.
        const auto ball = [&](double time) {
            const double ball_b = at_along - time * along_way;
            const double ball_c = at_at - 2.0 * time * at_way + time * time * way_way;
            const double there = ball_b * ball_b - ball_c;
            return there < 0.0 ? std::numeric_limits<double>::quiet_NaN() : -ball_b + sign * std::sqrt(there);
        };
        t = a > along ? (t < 0.0 || way_way == 0.0 ? 0.0 : 1.0) : (along_way * sign > 0.0 ? 1.0 : 0.0);
        s = ball(t);
        if (std::isnan(s)) out.hit = false;
    };
    end(-1.0, out.entry, out.entry_time);
    if (out.hit) end(1.0, out.exit, out.exit_time);
    return out;
}

bool BodySweep::cutByBall(const Ray& ray, double low, double high, Pieces& out) const {
    const double r = body_->ballRadius();
    const auto height = [&](double s, double t) { return ray.at[2] + s * ray.direction[2] - t * local_way_[2]; };
    const Capsule ball = capsule(ray);
    const double highest = std::max(height(low, 0.0), height(high, 0.0)) + std::max(0.0, -local_way_[2]);
    if (highest <= std::min(r, body_->height())) {
        // Only the ball's lower half is near.
        const double from = std::max(low, ball.entry);
        const double to = std::min(high, ball.exit);
        if (ball.hit && to > from) out.emplace_back(from, to);
        return true;
    }
    if (!ball.hit || body_->height() < r || height(ball.entry, ball.entry_time) > r) return false;
    // The way in is on the lower half, and so is no other's; the way out is looked for from the far end.
    if (ball.entry >= high) return true;
    double exit = -high;
    double exit_time = ball.exit_time;
    const Ray back{ray.at, {-ray.direction[0], -ray.direction[1], -ray.direction[2]}};
    if (!enter(back, -high, -std::max(low, ball.entry), 0.0, 1.0, exit, exit_time)) return true;
    if (-exit > std::max(low, ball.entry)) out.emplace_back(std::max(low, ball.entry), -exit);
    return true;
}

void BodySweep::cut(const Ray& ray, double low, double high, double from, double to, int level, Pieces& out) const {
    double entry = low;
    double entry_time = 0.5 * (from + to);
    if (!enter(ray, low, high, from, to, entry, entry_time)) return;
    const Ray back{ray.at, {-ray.direction[0], -ray.direction[1], -ray.direction[2]}};
    double exit = -high;
    double exit_time = entry_time;
    if (!enter(back, -high, -entry, from, to, exit, exit_time)) return;
    exit = -exit;
    const double apart = std::abs(exit_time - entry_time);
    const double gap = (bend_mm_ * apart * apart + 2.0 * turn_rad_ * apart * (exit - entry)) / 8.0;
    if (gap > tolerance_mm_ && level < most_levels) {
        const double middle = 0.5 * (from + to);
        cut(ray, entry, exit, from, middle, level + 1, out);
        cut(ray, entry, exit, middle, to, level + 1, out);
        return;
    }
    if (exit > entry) out.emplace_back(entry, exit);
}

bool BodySweep::asUprightBall(UprightBall& out) const {
    if (!by_ball_ || body_->height() < 2.0 * body_->ballRadius()) return false;
    for (int axis = 0; axis < 3; ++axis)
        if (frame_(2, axis) == 1.0) {
            out = {
                body_->ballRadius(), body_->height(), {tip_[0], tip_[1], tip_[2]}, {way_[0], way_[1], way_[2]}, axis};
            return true;
        }
    return false;
}

double BodySweep::depth(const Ray& ray, double s) const {
    // Golden section would do; the distance is convex in t, and the slope's sign says which half to keep.
    double from = 0.0;
    double to = 1.0;
    double least = std::numeric_limits<double>::infinity();
    for (const double t : {0.0, 1.0}) least = std::min(least, probe(ray, s, t).value);
    constexpr int halvings = 12;
    for (int i = 0; i < halvings; ++i) {
        const double t = 0.5 * (from + to);
        const Probe here = probe(ray, s, t);
        least = std::min(least, here.value);
        (here.by_t < 0.0 ? from : to) = t;
    }
    return -least;
}

}  // namespace cusp::simulation
