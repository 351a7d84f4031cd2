// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A sampled profile as a continuous curve, so that parameters defined by integrals and crossings are computed as such.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace cusp::inspect {

/// Between two samples a cubic through four neighbours, chosen where the profile is smoothest (essentially non-oscillatory
/// interpolation: Harten, Engquist, Osher, Chakravarthy 1987, J. Comput. Phys. 71, 231–303). Smooth profiles are followed to
/// the fourth order of the spacing; straight flanks stay straight up to a corner at a sample.
///
/// x runs from 0 in units of the spacing; heights in any one unit.
class TextureCurve {
public:
    /// A stretch on which the curve rises or falls throughout, within one interval.
    struct Piece {
        std::size_t interval = 0;
        double from = 0.0;  ///< local: 0 at the left sample, 1 at the right one
        double to = 1.0;
        double z_from = 0.0;
        double z_to = 0.0;
    };

    /// Needs at least two samples.
    explicit TextureCurve(std::span<const double> heights);

    [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
    /// In intervals.
    [[nodiscard]] double length() const { return static_cast<double>(coefficients_.size()); }
    [[nodiscard]] double height(std::size_t interval, double local) const;
    /// dz/dx, per spacing.
    [[nodiscard]] double slope(std::size_t interval, double local) const;
    [[nodiscard]] double highest() const { return highest_; }
    [[nodiscard]] double lowest() const { return lowest_; }

    /// Where a piece meets `level`, local; call only when it does.
    [[nodiscard]] double crossing(const Piece& piece, double level) const;

    /// (1/length)·∫ f(z, dz/dx) dx, with f smooth on either side of `level`.
    [[nodiscard]] double mean(const std::function<double(double, double)>& f, double level = 0.0) const;

    /// Share of the length at or above `level`, 0 … 1.
    [[nodiscard]] double materialRatio(double level) const;
    /// The level with that share, 0 < ratio < 1: materialRatio falls through it.
    [[nodiscard]] double levelAtRatio(double ratio) const;

private:
    void addPieces(std::size_t interval, double z_end);
    [[nodiscard]] double meanOverPart(std::size_t interval, double from, double to,
                                      const std::function<double(double, double)>& f) const;

    std::vector<std::array<double, 4>> coefficients_;  ///< of 1, s, s², s³ per interval
    std::vector<Piece> pieces_;
    double highest_ = 0.0;
    double lowest_ = 0.0;
};

}  // namespace cusp::inspect
