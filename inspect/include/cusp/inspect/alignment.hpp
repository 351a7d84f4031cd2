// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Best fit of measured points to a nominal shape: orthogonal distance regression and minimax, any freedom locked.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/geometry/closest_point.hpp>
#include <cusp/inspect/measured_points.hpp>

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::inspect {

/// The six freedoms of a pose, in the nominal's axes: translations, then rotations.
enum class Freedom { Tx, Ty, Tz, Rx, Ry, Rz };
inline constexpr std::array<Freedom, 6> all_freedoms{Freedom::Tx, Freedom::Ty, Freedom::Tz,
                                                     Freedom::Rx, Freedom::Ry, Freedom::Rz};
/// "tx" … "rz".
[[nodiscard]] std::string_view freedomName(Freedom freedom);

enum class FitKind { None, LeastSquares, Minimax };
/// "none", "least-squares", "minimax".
[[nodiscard]] std::string_view fitName(FitKind kind);

/// How strongly a residual e counts, with the scale s: e², Huber (linear beyond s), Cauchy s²·ln(1 + e²/s²), Tukey's
/// biweight (constant beyond s).
enum class Loss { Squared, Huber, Cauchy, Tukey };

struct AlignmentOptions {
    FitKind fit = FitKind::LeastSquares;
    std::array<bool, 6> locked{};  ///< by `Freedom`; a locked freedom keeps its value of the start
    Loss loss = Loss::Squared;     ///< of least squares
    double loss_scale_mm =
        0.0;  ///< 0: 4.685 (Tukey), 2.385 (Cauchy), 1.345 (Huber) times the robust spread of residuals
    std::vector<double> weights{};  ///< one per point, ≥ 0, or empty
    double offset_mm = 0.0;         ///< the points lie this far outside the nominal: the probe's radius for centres
    RigidTransform start = RigidTransform::Identity();  ///< nominal_from_measured to begin with
    /// Points farther than this beyond an edge of the nominal do not take part: there the distance is not along the normal.
    double edge_tolerance_mm = 1e-5;
    int max_iterations = 100;
};

enum class Termination {
    NotAsked,       ///< fit none, or nothing free
    Converged,      ///< the step fell below the rounding of the coordinates
    Stalled,        ///< no step makes the cost smaller any more
    MaxIterations,  ///< gave up: not to be trusted
};
[[nodiscard]] std::string_view terminationName(Termination termination);

/// A solve told in full. Rotation vector and translation are those of `nominal_from_measured` (x_nominal = R·x + t).
struct AlignmentSummary {
    FitKind fit = FitKind::None;
    Termination termination = Termination::NotAsked;
    int iterations = 0;           ///< with all points
    int coarse_iterations = 0;    ///< before them, with a sample
    std::size_t points = 0;       ///< that took part
    std::size_t beyond_edge = 0;  ///< that did not: farther beyond an edge than the tolerance
    RigidTransform nominal_from_measured = RigidTransform::Identity();
    Vector3 rotation_vector_rad = Vector3::Zero();
    Vector3 translation_mm = Vector3::Zero();
    std::array<bool, 6> locked{};
    double start_rms_mm = 0.0;  ///< of a sample of 2000 points
    double rms_mm = 0.0;        ///< of the residuals that took part
    double minimax_mm = 0.0;    ///< largest |residual| that took part

    /// Covariance of (tx, ty, tz, rx, ry, rz) in mm and rad for translation and rotation about `pivot_mm` (in the nominal
    /// frame), from σ² = Σwe²/(N − free freedoms); zero for locked ones. Of a minimax fit, that of least squares there.
    Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
    Vector3 pivot_mm = Vector3::Zero();
    /// Of the normal matrix of the free freedoms, rotations scaled by the points' radius of gyration.
    double condition = 1.0;
    std::vector<Freedom> weak;  ///< freedoms the points determine far worse than the best one
};

/// Fits the pose. Errors: `align.too-few-points`, `align.not-determined` (names the freedoms), `align.no-overlap` (all
/// points lie beyond the nominal's edges), `align.not-converged`, `align.weights`.
///
/// Least squares: Gauss–Newton with Levenberg's damping on the distances to footpoints solved anew at every step, started
/// with a sample of the points. The residual is distance − `offset_mm`, so probe centres are fitted to the offset surface.
/// Minimax: from there, a sequence of linear programs on the linearised residuals.
/// Same bits at any number of threads.
[[nodiscard]] base::Result<AlignmentSummary>
align(std::span<const Vector3> points, const geometry::NominalShape& nominal, const AlignmentOptions& options);

}  // namespace cusp::inspect
