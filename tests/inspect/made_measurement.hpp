// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Measurements made so that the best fit is known in advance: deviations for which the true pose is exactly stationary.
#pragma once

#include "analytic_shapes.hpp"

#include <cusp/inspect/alignment.hpp>

#include <Eigen/LU>
#include <Eigen/QR>

#include <algorithm>

namespace cusp::inspect::test {

struct MadeMeasurement {
    std::vector<Vector3> points;     ///< in the machine's frame; centres of the probe
    std::vector<Vector3> nominal;    ///< footpoints
    std::vector<double> deviations;  ///< of the best fit
    geometry::RigidTransform nominal_from_measured;
};

inline Vector3 randomVector(base::Random& random, double length) {
    Vector3 v(random.normal(), random.normal(), random.normal());
    return length * v.normalized();
}

inline geometry::RigidTransform randomPose(base::Random& random, double angle_rad, double shift_mm) {
    geometry::RigidTransform out = geometry::RigidTransform::Identity();
    out.linear() = Eigen::AngleAxisd(angle_rad, randomVector(random, 1.0)).toRotationMatrix();
    out.translation() = randomVector(random, shift_mm);
    return out;
}

/// Footpoints at random places inside the patch and, for each, how its deviation changes with the pose.
struct Places {
    std::vector<Vector3> foot;
    std::vector<Vector3> normal;
    Eigen::MatrixXd J;  ///< rows (n, f × n)
};

inline Places randomPlaces(base::Random& random, const Patch& patch, std::size_t count) {
    Places out;
    out.J.resize(static_cast<Eigen::Index>(count), 6);
    for (std::size_t i = 0; i < count; ++i) {
        const double u = random.uniform(0.03, 0.97);
        const double v = random.uniform(0.03, 0.97);
        out.foot.push_back(patch.at(u, v));
        out.normal.push_back(patch.normalAt(u, v));
        out.J.row(static_cast<Eigen::Index>(i)) << out.normal[i].transpose(),
            out.foot[i].cross(out.normal[i]).transpose();
    }
    return out;
}

/// The probe of radius r touches with these deviations; the machine's frame is off by the inverse of the pose.
inline MadeMeasurement measured(const Places& places, const Eigen::VectorXd& d, double radius_mm,
                                const geometry::RigidTransform& nominal_from_measured) {
    MadeMeasurement out;
    out.nominal_from_measured = nominal_from_measured;
    out.nominal = places.foot;
    for (std::size_t i = 0; i < places.foot.size(); ++i) {
        out.deviations.push_back(d[static_cast<Eigen::Index>(i)]);
        out.points.emplace_back(nominal_from_measured.inverse() *
                                Vector3(places.foot[i] + (radius_mm + out.deviations[i]) * places.normal[i]));
    }
    return out;
}

/// Noise without the part that a pose could explain: Jᵀd = 0 makes the pose the least-squares fit.
inline MadeMeasurement leastSquaresMeasurement(base::Random& random, const Patch& patch, std::size_t count,
                                               double radius_mm, double sigma_mm,
                                               const geometry::RigidTransform& pose) {
    const Places places = randomPlaces(random, patch, count);
    Eigen::VectorXd d(places.J.rows());
    for (double& value : d) value = random.normal(0.0, sigma_mm);
    d -= places.J * places.J.colPivHouseholderQr().solve(d);
    return measured(places, d, radius_mm, pose);
}

/// Seven points at ± the largest deviation whose signed rows are positively dependent: no pose makes all smaller
/// (Chebyshev's criterion); the others stay inside.
inline MadeMeasurement minimaxMeasurement(base::Random& random, const Patch& patch, std::size_t count, double radius_mm,
                                          double largest_mm, const geometry::RigidTransform& pose) {
    const Places places = randomPlaces(random, patch, count);
    const Eigen::VectorXd dependence =
        Eigen::FullPivLU<Eigen::MatrixXd>(places.J.topRows(7).transpose()).kernel().col(0);
    Eigen::VectorXd d(places.J.rows());
    for (double& value : d) value = random.uniform(-0.9, 0.9) * largest_mm;
    for (Eigen::Index i = 0; i < 7; ++i) d[i] = std::copysign(largest_mm, dependence[i]);
    return measured(places, d, radius_mm, pose);
}

}  // namespace cusp::inspect::test
