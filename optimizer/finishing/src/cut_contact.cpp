// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The corner circle of a cutter against the nearest points of a shape.
#include <cusp/optimizer/finishing/cut_contact.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace cusp::finishing {

namespace {

/// A footpoint at the rim of the shape counts while the corner stands on its normal within this.
constexpr double rim_angle_rad = 0.01;

struct Touch {
    geometry::Footpoint foot;
    double gap_mm = std::numeric_limits<double>::infinity();
};

class CornerCircle {
public:
    CornerCircle(const geometry::Cutter& cutter, const toolpath::CutterLocation& at,
                 const geometry::NominalShape& shape)
        : cutter_(cutter), shape_(shape), center_(at.tip_mm + cutter.corner_f_mm * at.axis) {
        const Vector3 any = std::abs(at.axis.z()) < 0.9 ? Vector3::UnitZ() : Vector3::UnitX();
        first_ = at.axis.cross(any).normalized();
        second_ = at.axis.cross(first_);
    }

    [[nodiscard]] Touch nearest() const {
        if (cutter_.corner_e_mm <= 0.0) return at(0.0);
        constexpr int looks = 32;
        constexpr double step = 2.0 * std::numbers::pi / looks;
        std::array<double, looks> gaps{};
        std::size_t deepest = 0;
        for (std::size_t i = 0; i < looks; ++i) {
            gaps[i] = at(static_cast<double>(i) * step).gap_mm;
            if (gaps[i] < gaps[deepest]) deepest = i;
        }
        // A cutter that is flatter than the surface is hollow cuts in on both sides of its contact, which is then a high
        // place of the gap and not a low one: of all turning places the one nearest to the surface is the contact.
        Touch best;
        for (std::size_t i = 0; i < looks; ++i) {
            const double before = gaps[(i + looks - 1) % looks];
            const double after = gaps[(i + 1) % looks];
            const bool low = gaps[i] <= before && gaps[i] <= after;
            const bool high = gaps[i] >= before && gaps[i] >= after && std::isfinite(gaps[i]);
            if (!low && (!high || gaps[i] > far_mm)) continue;
            const double angle = static_cast<double>(i) * step;
            const Touch found = refine(angle - step, angle + step, at(angle), low ? 1.0 : -1.0);
            if (std::abs(found.gap_mm) < std::abs(best.gap_mm)) best = found;
        }
        const bool contact = std::abs(best.gap_mm) <= far_mm;
        return contact ? best : at(static_cast<double>(deepest) * step);
    }

private:
    /// Beyond this from the surface, a turning place of the gap is no contact.
    static constexpr double far_mm = 0.5;

    [[nodiscard]] Touch at(double angle) const {
        const Vector3 corner = center_ + cutter_.corner_e_mm * (std::cos(angle) * first_ + std::sin(angle) * second_);
        Touch touch{shape_.closest(corner), 0.0};
        touch.gap_mm = touch.foot.distance_mm - cutter_.corner_radius_mm;
        if (touch.foot.on_boundary) {
            const Vector3 away = corner - touch.foot.position;
            if (away.norm() > 1e-6 && geometry::angleBetween(away, touch.foot.normal) > rim_angle_rad)
                touch.gap_mm = std::numeric_limits<double>::infinity();
        }
        return touch;
    }

    /// Golden section for the low (`sign` 1) or high (−1) of the gap between two looks.
    [[nodiscard]] Touch refine(double low, double high, Touch best, double sign) const {
        constexpr double golden = 0.6180339887498949;
        constexpr double close_rad = 1e-7;
        double a = high - golden * (high - low);
        double b = low + golden * (high - low);
        Touch at_a = at(a);
        Touch at_b = at(b);
        while (high - low > close_rad) {
            if (sign * at_a.gap_mm < sign * at_b.gap_mm) {
                high = std::exchange(b, a);
                at_b = at_a;
                a = high - golden * (high - low);
                at_a = at(a);
            } else {
                low = std::exchange(a, b);
                at_a = at_b;
                b = low + golden * (high - low);
                at_b = at(b);
            }
        }
        for (const Touch& found : {at_a, at_b})
            if (sign * found.gap_mm < sign * best.gap_mm) best = found;
        return best;
    }

    const geometry::Cutter& cutter_;
    const geometry::NominalShape& shape_;
    Vector3 center_;
    Vector3 first_ = Vector3::Zero();
    Vector3 second_ = Vector3::Zero();
};

/// Frames, angles and curvatures, once the contacts of a pass are known.
void orient(std::vector<CutContact>& contacts, const std::vector<Vector3>& axes,
            const std::vector<geometry::Footpoint>& feet, const geometry::NominalShape& shape) {
    const auto* faces = dynamic_cast<const geometry::ParametricSurface*>(&shape);
    const auto same = [&](std::size_t a, std::size_t b) { return contacts[a].pass == contacts[b].pass; };
    for (std::size_t i = 0; i < contacts.size(); ++i) {
        CutContact& contact = contacts[i];
        const std::size_t before = i > 0 && same(i - 1, i) ? i - 1 : i;
        const std::size_t after = i + 1 < contacts.size() && same(i, i + 1) ? i + 1 : i;
        const Vector3& normal = feet[i].normal;
        const Vector3 way = contacts[after].position - contacts[before].position;
        const Vector3 across = way - way.dot(normal) * normal;
        // A pass of one point has no direction; any will do, and none of its figures along the feed is used.
        contact.frame = feedFrame(normal, across.norm() > 1e-9 ? way : normal.unitOrthogonal());
        contact.angles = leadTiltOf(contact.frame, axes[i]);
        if (faces == nullptr || feet[i].face < 0) continue;
        const auto point = faces->faces()[static_cast<std::size_t>(feet[i].face)].evaluate(feet[i].u, feet[i].v);
        if (geometry::crossNormal(point).squaredNorm() > 0.5)
            contact.cross_curvature_per_mm = geometry::normalCurvature(point, normal, contact.frame.left);
    }
}

}  // namespace

std::vector<CutContact> findContacts(const simulation::CutterPath& path, const geometry::NominalShape& shape,
                                     const ContactOptions& options) {
    std::vector<CutContact> out;
    std::vector<Vector3> axes;
    std::vector<geometry::Footpoint> feet;
    std::uint32_t pass = 0;
    bool cutting = false;  // the contact before is in the pass that goes on
    Vector3 direction = Vector3::Zero();
    for (const simulation::ToolMove& move : path.moves) {
        const Touch touch = CornerCircle(path.cutters[move.cutter], move.to, shape).nearest();
        const bool touches = move.kind == toolpath::MotionKind::Feed && std::abs(touch.gap_mm) <= options.reach_mm;
        if (!touches || move.kind != toolpath::MotionKind::Feed) {
            if (cutting) ++pass;
            cutting = false;
            direction.setZero();
            continue;
        }
        if (cutting) {
            const Vector3 step = touch.foot.position - out.back().position;
            if (!direction.isZero() && !step.isZero() && geometry::angleBetween(direction, step) > options.turn_rad) {
                ++pass;
                direction.setZero();
            } else {
                direction = step;
            }
        }
        cutting = true;
        CutContact contact;
        contact.position = touch.foot.position;
        contact.gap_mm = touch.gap_mm;
        contact.pass = pass;
        contact.cutter = move.cutter;
        contact.line = move.line;
        out.push_back(contact);
        axes.push_back(move.to.axis);
        feet.push_back(touch.foot);
    }
    orient(out, axes, feet, shape);
    return out;
}

std::vector<CutContact> contactsOf(const ContactPath& path) {
    std::vector<CutContact> out;
    out.reserve(path.points.size());
    for (const ContactPoint& point : path.points) {
        CutContact contact;
        contact.position = point.position;
        contact.frame = point.frame;
        contact.angles = {point.lead_rad, path.options.orientation.tilt_rad};
        contact.cross_curvature_per_mm = point.cross_curvature_per_mm;
        contact.gap_mm = path.options.orientation.depth_offset_mm;
        contact.pass = point.pass;
        out.push_back(contact);
    }
    return out;
}

}  // namespace cusp::finishing
