// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Residuals of points against a nominal under a pose of six parameters, and the normal equations they make.
#pragma once

#include <cusp/inspect/alignment.hpp>

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace cusp::inspect {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// A motion about a pivot: x → R(ρ)(x − pivot) + pivot + τ. The parameters are (τ, length·ρ), all in mm, so that a step
/// of 1 moves the points by about as much whichever parameter makes it.
struct PoseModel {
    Vector3 pivot = Vector3::Zero();
    double length_mm = 1.0;

    [[nodiscard]] RigidTransform motion(const Vector6& parameters) const;
};

enum class EdgeRule {
    Distance,  ///< beyond an edge the residual is the distance to its offset: pulls a part from afar into place
    Normal,    ///< along the normal at the edge; points beyond the tolerance do not take part
};

struct NormalEquations {
    Matrix6 H = Matrix6::Zero();  ///< Σ w·JᵀJ, with a loss Σ w·ρ''/2·JᵀJ
    Vector6 g = Vector6::Zero();  ///< Σ w·e·Jᵀ, with a loss Σ w·ρ'/2·Jᵀ
    double cost = 0.0;            ///< Σ w·ρ(e), ρ(e) = e² without a loss
    double square_sum = 0.0;      ///< Σ w·e², loss left aside
    double weight_sum = 0.0;
    double largest = 0.0;    ///< |e|
    std::size_t points = 0;  ///< that take part
};

/// Points as they lie after the start pose, in the nominal frame. Everything is in parallel, and adds up in one order.
class ResidualField {
public:
    ResidualField(std::vector<Vector3> points, std::vector<double> weights, const geometry::NominalShape& nominal,
                  const PoseModel& model, double offset_mm);

    /// Footpoints at these parameters, solved anew.
    void moveTo(const Vector6& parameters);
    [[nodiscard]] const Vector6& parameters() const { return parameters_; }

    void useEdgeRule(EdgeRule rule) { rule_ = rule; }
    void useLoss(Loss loss, double scale_mm) { loss_ = loss, loss_scale_mm_ = scale_mm; }
    /// Which points take part from now on: those at most so far beyond an edge. True when that is another choice than before.
    /// With `only_remove`, points that were left out stay out.
    bool chooseParticipants(double edge_tolerance_mm, bool only_remove = false);

    /// At the footpoints of the last `moveTo`.
    [[nodiscard]] NormalEquations normalEquations() const;
    /// Residual of one point, and its derivative by the parameters.
    [[nodiscard]] double residual(std::size_t i) const;
    [[nodiscard]] Vector6 gradient(std::size_t i) const;
    [[nodiscard]] bool takesPart(std::size_t i) const { return participants_.empty() || participants_[i] != 0; }
    [[nodiscard]] std::size_t size() const { return points_.size(); }
    /// Largest coordinate, for what rounding can do.
    [[nodiscard]] double magnitude() const { return magnitude_; }
    /// 1.4826 times the median of |e|: σ, were the residuals normally distributed about 0.
    [[nodiscard]] double robustSpread() const;

private:
    [[nodiscard]] Vector3 direction(std::size_t i) const;
    /// From the point of the offset surface to the point.
    [[nodiscard]] Vector3 toOffset(std::size_t i) const;
    void addPoint(std::size_t i, NormalEquations& sum) const;

    std::vector<Vector3> points_;
    std::vector<double> weights_;
    const geometry::NominalShape& nominal_;
    PoseModel model_;
    double offset_mm_;
    double magnitude_ = 0.0;
    EdgeRule rule_ = EdgeRule::Distance;
    Loss loss_ = Loss::Squared;
    double loss_scale_mm_ = 1.0;
    std::vector<std::uint8_t> participants_;

    Vector6 parameters_ = Vector6::Zero();
    RigidTransform motion_ = RigidTransform::Identity();
    Eigen::Matrix3d jacobian_ = Eigen::Matrix3d::Identity();  ///< left Jacobian over the length
    std::vector<Vector3> moved_;
    std::vector<geometry::Footpoint> footpoints_;
    bool warm_ = false;
};

}  // namespace cusp::inspect
