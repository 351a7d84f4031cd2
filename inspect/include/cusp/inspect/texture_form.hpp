// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The form under a profile: a smooth curve, its order chosen by a stated criterion.
#pragma once

#include <cusp/base/result.hpp>

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cusp::inspect {

struct FormOptions {
    std::optional<int> order;  ///< of the polynomial, 0 … 20; absent: chosen up to `largest_order`
    int largest_order = 10;
    /// Orders whose half-waves would be shorter than this are not tried, so that the form does not swallow scallops.
    double shortest_half_wave_mm = 0.0;
};

/// One order that was tried.
struct FormCandidate {
    int order = 0;
    double rms_mm = 0.0;
    double aicc = 0.0;
};

struct FormFit {
    int order = 0;
    std::vector<double> coefficients_mm;  ///< of Legendre polynomials over the profile's length
    std::vector<double> form_mm;          ///< at every point
    double rms_mm = 0.0;                  ///< of what is left
    double effective_points = 0.0;
    std::vector<FormCandidate> candidates;
    std::string text;  ///< one sentence: the order and how it was chosen
};

/// Least squares (Ceres) of a Legendre series to heights over positions that grow strictly.
///
/// The order is the one with the smallest AICc (Hurvich, Tsai 1989, Biometrika 76, 297–307): n·ln(rss/points) + 2k +
/// 2k(k + 1)/(n − k − 1), k = order + 2. Neighbours on a machined surface are alike, so n is the effective number of points,
/// points·(1 − ρ)/(1 + ρ) with ρ the correlation of neighbours in what the highest order leaves, and at least the number of
/// its changes of sign.
/// Errors: `form.points` (sizes differ, positions do not grow, or fewer points than order + 3), `form.order`.
[[nodiscard]] base::Result<FormFit> fitForm(std::span<const double> position_mm, std::span<const double> height_mm,
                                            const FormOptions& options);

struct ScallopOptions {
    double planned_step_over_mm = 0.0;  ///< 0: not known
};

struct Scallops {
    std::size_t count = 0;         ///< whole ridges found
    double mean_spacing_mm = 0.0;  ///< between ridges; 0 with fewer than two
    double mean_height_mm = 0.0;   ///< of a ridge over the mean of the valleys beside it
    double max_height_mm = 0.0;
    double planned_count = 0.0;    ///< length over the planned step-over; 0 when that is not known
    std::vector<double> ridge_mm;  ///< positions of the ridges
};

/// Ridges in what a section has over its form. A ridge counts when it and its valleys are higher than a quarter of the span
/// between the 5th and the 95th percentile, and longer than a fifth of the planned step-over.
/// Errors: `form.points`; `scallops.too-coarse` when fewer than 4 points lie within the planned step-over.
[[nodiscard]] base::Result<Scallops> findScallops(std::span<const double> position_mm,
                                                  std::span<const double> over_form_mm, const ScallopOptions& options);

}  // namespace cusp::inspect
