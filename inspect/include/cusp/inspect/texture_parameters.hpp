// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The parameters of a surface profile: those of Fountas 2017, fig. 12, each with its standard or other source.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::inspect {

/// What the parameters that need a choice are taken at; the defaults are those of Fountas 2017, fig. 12.
struct TextureConditions {
    /// Averages over sampling lengths of this length where ISO 4287:1997 wants them (R); 0: the whole profile (P, W).
    double sampling_length_mm = 0.0;
    double depth_mm = 0.001;       ///< under the highest peak: mr, Tp, HSC
    double low_ratio = 0.2;        ///< material ratios of dc and HTp
    double high_ratio = 0.8;       ///< likewise
    double peak_band_mm = 0.0005;  ///< Pc counts passages from above + to below − this
    double void_ratio = 0.2;       ///< material ratio of the lid of Vo
    double height_share = 0.1;     ///< of z: what a profile element must rise and fall at least
    /// How long peak and valley of an element must be at least: 1 % of the sampling length of roughness (0.8 mm), in P and W
    /// too, whose own sampling length, the whole profile, would leave no element of a long one.
    double least_length_mm = 0.008;
};

struct TextureParameter {
    std::string name;  ///< with its letter: "Pa", "RSm", "Wt"
    std::string unit;  ///< "um", "mm", "percent", "deg", "per_mm", "peaks", "mm3_per_mm2", ""
    /// Absent where the profile does not have it, e.g. PSm without two mean-line crossings.
    std::optional<double> value;
    std::string condition;    ///< "1 um under the highest peak"
    std::string_view source;  ///< "ISO 4287:1997, 4.2.1"
};

/// All parameters of one profile, heights in mm over its mean line, named with `letter` ('P', 'R', 'W'). Between samples the
/// profile is a smooth curve (fourth order; corners at samples stay corners), and parameters are integrals, extremes and
/// crossings of it. Needs 2 heights or more.
///
/// | name | is | source |
/// |---|---|---|
/// | a | mean of the absolute height | ISO 4287:1997, 4.2.1 |
/// | q | root mean square height | ISO 4287:1997, 4.2.2 |
/// | p, v | highest peak, deepest valley (positive) | ISO 4287:1997, 4.1.1, 4.1.2 |
/// | z | p + v of the sampling length | ISO 4287:1997, 4.1.3 |
/// | t | highest peak to deepest valley of the whole profile | ISO 4287:1997, 4.1.5 |
/// | sk, ku | third and fourth moment of the heights over q³, q⁴ | ISO 4287:1997, 4.2.3, 4.2.4 |
/// | c | mean height of the profile elements | ISO 4287:1997, 4.1.4 |
/// | Sm | mean width of the profile elements | ISO 4287:1997, 4.3.1 |
/// | Dq, Da | root mean square and mean absolute slope, as angles | ISO 4287:1997, 4.4.1; ISO 4287-1:1984 |
/// | Lq, La | wavelengths 2πq/Dq and 2πa/Da | ISO 4287-1:1984 |
/// | Lo | how much longer the profile is than its trace | ISO 4287-1:1984, profile length ratio less 1 |
/// | mr, Tp | material ratio at a depth under the highest peak | ISO 4287:1997, 4.5.4; ISO 4287-1:1984 |
/// | dc, HTp | height between two material ratios | ISO 4287:1997, 4.5.3; Taylor Hobson |
/// | H | height between material ratios 5 % and 90 % | SMS 671:1975 (Swedish height) |
/// | Pc | peaks per mm that pass a band about the mean line | EN 10049:2005 |
/// | D, S | profile elements per mm; mean distance of local peaks | ISO 4287-1:1984 |
/// | HSC | peaks that stand out at a depth under the highest one | Taylor Hobson, high spot count |
/// | zJIS | mean of five highest peaks and five deepest valleys | JIS B 0601:2001, annex 1 |
/// | 3z | third highest peak to third deepest valley | Daimler-Benz N 31007:1983 |
/// | fd | fractal dimension by the variation of the profile | Dubuc et al. 1989, Phys. Rev. A 39, 1500–1512 |
/// | Vo | void volume per area under a lid at a material ratio | as Vv(mr) of ISO 25178-2:2012 for a profile; see below |
///
/// Profile elements: a peak and a valley between crossings of the mean line, each higher than `height_share` of z and longer
/// than `least_length_mm`; what is smaller belongs to what is before it. Only whole elements count.
/// Vo: fig. 12 gives 0.000395 mm³/mm² for q = 0.369 µm and ku = 2.39 and does not say under which lid; between a uniform and
/// a normal distribution of heights 20 % material ratio gives 0.35–0.41 µm, and no other usual level comes near.
/// fd: from 8 samples to 1/16 of the length; on self-affine profiles of 2^15 samples right to ± 0.05 up to dimension 1.5,
/// and up to 0.1 low at 1.8, since the variation between samples is not seen.
[[nodiscard]] std::vector<TextureParameter> textureParameters(char letter, std::span<const double> heights_mm,
                                                              double spacing_mm, const TextureConditions& conditions);

}  // namespace cusp::inspect
