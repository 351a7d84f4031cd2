// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Distances to footpoints and their derivatives by the pose.
#include "alignment/residual_field.hpp"

#include "alignment/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <oneapi/tbb/parallel_for.h>
#include <utility>

namespace cusp::inspect {
namespace {

/// Sums are made block by block and added up in their order: the same bits at any number of threads.
constexpr std::size_t block_points = 2048;

template <class Body>
void forBlocks(std::size_t points, const Body& body) {
    const std::size_t blocks = (points + block_points - 1) / block_points;
    oneapi::tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t block) {
        const std::size_t begin = block * block_points;
        body(block, begin, std::min(begin + block_points, points));
    });
}

struct Weighting {
    double cost = 0.0;       ///< ρ(e)
    double weight = 1.0;     ///< ρ'(e)/(2e)
    double curvature = 1.0;  ///< ρ''(e)/2, kept above a tenth of the weight so that the normal matrix stays definite
};

/// With the true curvature instead of the weight the iteration converges as Newton's does, not as reweighting does.
Weighting weighting(Loss loss, double e, double s) {
    const double q = e * e / (s * s);
    Weighting out{e * e, 1.0, 1.0};
    switch (loss) {
        case Loss::Squared: return out;
        case Loss::Huber:
            if (q > 1.0) out = {2.0 * s * std::abs(e) - s * s, s / std::abs(e), 0.0};
            break;
        case Loss::Cauchy: out = {s * s * std::log1p(q), 1.0 / (1.0 + q), (1.0 - q) / ((1.0 + q) * (1.0 + q))}; break;
        case Loss::Tukey: {
            const double rest = q < 1.0 ? 1.0 - q : 0.0;
            out = {s * s / 3.0 * (1.0 - rest * rest * rest), rest * rest, rest * (1.0 - 5.0 * q)};
            break;
        }
    }
    out.curvature = std::max(out.curvature, 0.1 * out.weight);
    return out;
}

}  // namespace

RigidTransform PoseModel::motion(const Vector6& parameters) const {
    RigidTransform out = RigidTransform::Identity();
    out.linear() = rotationFromVector(parameters.tail<3>() / length_mm);
    out.translation() = pivot + parameters.head<3>() - out.linear() * pivot;
    return out;
}

ResidualField::ResidualField(std::vector<Vector3> points, std::vector<double> weights,
                             const geometry::NominalShape& nominal, const PoseModel& model, double offset_mm)
    : points_(std::move(points)),
      weights_(std::move(weights)),
      nominal_(nominal),
      model_(model),
      offset_mm_(offset_mm),
      moved_(points_.size()),
      footpoints_(points_.size()) {
    for (Vector3& point : points_) {
        magnitude_ = std::max(magnitude_, point.cwiseAbs().maxCoeff());
        point -= model_.pivot;
    }
}

void ResidualField::moveTo(const Vector6& parameters) {
    parameters_ = parameters;
    const Vector3 rotation = parameters.tail<3>() / model_.length_mm;
    const geometry::Matrix3 R = rotationFromVector(rotation);
    const Vector3 shift = model_.pivot + parameters.head<3>();
    jacobian_ = leftJacobian(rotation) / model_.length_mm;
    motion_.linear() = R;
    motion_.translation() = shift;
    forBlocks(points_.size(), [&](std::size_t, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) moved_[i] = R * points_[i] + shift;
    });
    nominal_.closest(moved_, footpoints_, warm_);
    warm_ = true;
}

bool ResidualField::chooseParticipants(double edge_tolerance_mm, bool only_remove) {
    std::vector<std::uint8_t> chosen(points_.size(), 1);
    for (std::size_t i = 0; i < points_.size(); ++i) {
        const geometry::Footpoint& foot = footpoints_[i];
        if (only_remove && !takesPart(i)) chosen[i] = 0;
        if (!foot.on_boundary) continue;
        const Vector3 away = moved_[i] - foot.position;
        if ((away - away.dot(foot.normal) * foot.normal).norm() > edge_tolerance_mm) chosen[i] = 0;
    }
    if (chosen == participants_) return false;
    participants_ = std::move(chosen);
    return true;
}

Vector3 ResidualField::toOffset(std::size_t i) const {
    const geometry::Footpoint& foot = footpoints_[i];
    return moved_[i] - foot.position - offset_mm_ * foot.normal;
}

Vector3 ResidualField::direction(std::size_t i) const {
    const geometry::Footpoint& foot = footpoints_[i];
    if (rule_ == EdgeRule::Normal || !foot.on_boundary) return foot.normal;
    const Vector3 away = toOffset(i);
    const double distance = away.norm();
    return distance > 1e-9 ? Vector3(away / distance) : foot.normal;
}

double ResidualField::residual(std::size_t i) const {
    const geometry::Footpoint& foot = footpoints_[i];
    if (!foot.on_boundary) return foot.distance_mm - offset_mm_;
    return rule_ == EdgeRule::Normal ? toOffset(i).dot(foot.normal) : toOffset(i).norm();
}

Vector6 ResidualField::gradient(std::size_t i) const {
    // A small rotation ω about the pivot moves the point by ω × (moved − pivot − τ).
    const Vector3 n = direction(i);
    const Vector3 arm = moved_[i] - motion_.translation();
    Vector6 out;
    out.head<3>() = n;
    out.tail<3>() = jacobian_.transpose() * arm.cross(n);
    return out;
}

void ResidualField::addPoint(std::size_t i, NormalEquations& sum) const {
    const double e = residual(i);
    const double given = weights_.empty() ? 1.0 : weights_[i];
    const Weighting robust = weighting(loss_, e, loss_scale_mm_);
    const Vector6 J = gradient(i);
    for (Eigen::Index c = 0; c < 6; ++c) {
        const double wj = given * robust.curvature * J[c];
        for (Eigen::Index r = c; r < 6; ++r) sum.H(r, c) += wj * J[r];
        sum.g[c] += given * robust.weight * e * J[c];
    }
    sum.cost += given * robust.cost;
    sum.square_sum += given * e * e;
    sum.weight_sum += given;
    sum.largest = std::max(sum.largest, std::abs(e));
    ++sum.points;
}

NormalEquations ResidualField::normalEquations() const {
    std::vector<NormalEquations> parts((points_.size() + block_points - 1) / block_points);
    forBlocks(points_.size(), [&](std::size_t block, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (takesPart(i)) addPoint(i, parts[block]);
    });
    NormalEquations sum;
    for (const NormalEquations& part : parts) {
        sum.H += part.H;
        sum.g += part.g;
        sum.cost += part.cost;
        sum.square_sum += part.square_sum;
        sum.weight_sum += part.weight_sum;
        sum.largest = std::max(sum.largest, part.largest);
        sum.points += part.points;
    }
    sum.H.triangularView<Eigen::StrictlyUpper>() = sum.H.transpose();
    return sum;
}

double ResidualField::robustSpread() const {
    std::vector<double> sizes;
    sizes.reserve(points_.size());
    for (std::size_t i = 0; i < points_.size(); ++i)
        if (takesPart(i)) sizes.push_back(std::abs(residual(i)));
    if (sizes.empty()) return 0.0;
    const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
    std::nth_element(sizes.begin(), middle, sizes.end());
    return 1.4826 * *middle;
}

}  // namespace cusp::inspect
