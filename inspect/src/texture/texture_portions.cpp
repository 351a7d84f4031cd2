// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One walk over the monotone pieces of the curve.
#include "texture/texture_portions.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::inspect {

namespace {

double place(const TextureCurve::Piece& piece, double local) { return static_cast<double>(piece.interval) + local; }

}  // namespace

std::vector<Portion> portionsAt(const TextureCurve& curve, double level) {
    std::vector<Portion> out;
    Portion open;
    for (const TextureCurve::Piece& piece : curve.pieces()) {
        const double from = piece.z_from - level;
        const double to = piece.z_to - level;
        if (std::abs(from) > std::abs(open.extreme)) open.extreme = from;
        if ((from < 0.0) != (to < 0.0)) {
            open.to = place(piece, curve.crossing(piece, level));
            open.ends = true;
            // A profile that begins on the level itself has no portion before its first crossing.
            if (open.extreme != 0.0) out.push_back(open);
            open = {open.to, open.to, to, true, false};
        } else if (std::abs(to) > std::abs(open.extreme)) {
            open.extreme = to;
        }
    }
    open.to = curve.length();
    if (open.extreme != 0.0) out.push_back(open);
    return out;
}

std::vector<Portion> significant(const std::vector<Portion>& portions, double least_height, double least_length) {
    std::vector<Portion> out;
    for (const Portion& portion : portions) {
        // How long a portion at an end of the profile would be is not known.
        const bool is_long = !portion.whole() || portion.to - portion.from > least_length;
        const bool counts = is_long && std::abs(portion.extreme) > least_height;
        if (!out.empty() && (!counts || out.back().isPeak() == portion.isPeak())) {
            out.back().to = portion.to;
            out.back().ends = portion.ends;
            if (counts && std::abs(portion.extreme) > std::abs(out.back().extreme))
                out.back().extreme = portion.extreme;
        } else if (counts) {
            out.push_back(portion);
        }
    }
    return out;
}

std::vector<double> localPeaks(const TextureCurve& curve) {
    std::vector<double> out;
    const auto& pieces = curve.pieces();
    for (std::size_t i = 1; i < pieces.size(); ++i)
        if (pieces[i - 1].z_from < pieces[i - 1].z_to && pieces[i].z_from > pieces[i].z_to)
            out.push_back(place(pieces[i], pieces[i].from));
    return out;
}

std::size_t passagesThrough(const TextureCurve& curve, double band) {
    std::size_t passages = 0;
    bool was_above = false;
    for (const TextureCurve::Piece& piece : curve.pieces()) {
        if (piece.z_from > band || piece.z_to > band) was_above = true;
        if (was_above && piece.z_to < -band) {
            was_above = false;
            ++passages;
        }
    }
    return passages;
}

}  // namespace cusp::inspect
