// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The B-splines of a deviation field that do not vanish at a point.
#pragma once

#include <cusp/geometry/deviation_field.hpp>

#include <array>
#include <cstddef>

namespace cusp::geometry::detail {

inline constexpr std::size_t most_axis_terms = 4;

/// Values of the degree + 1 splines from index `first` on.
struct AxisTerms {
    std::size_t first = 0;
    std::size_t count = 1;
    std::array<double, most_axis_terms> value{1.0, 0.0, 0.0, 0.0};
};

/// At a coordinate along the axis; outside it counts as the nearest end.
[[nodiscard]] AxisTerms axisTerms(const FieldAxis& axis, double coordinate_mm);

/// Calls `use(index, value)` for every coefficient that counts at `position` (nominal frame).
template <class Use>
void forEachTerm(const DeviationField::Data& data, const Vector3& position, const Use& use) {
    const Vector3 at = data.field_from_nominal * position;
    const AxisTerms x = axisTerms(data.axes[0], at.x());
    const AxisTerms y = axisTerms(data.axes[1], at.y());
    const AxisTerms z = axisTerms(data.axes[2], at.z());
    const std::size_t row = data.axes[2].coefficients();
    const std::size_t sheet = data.axes[1].coefficients() * row;
    for (std::size_t i = 0; i < x.count; ++i)
        for (std::size_t j = 0; j < y.count; ++j)
            for (std::size_t k = 0; k < z.count; ++k)
                use((x.first + i) * sheet + (y.first + j) * row + z.first + k, x.value[i] * y.value[j] * z.value[k]);
}

}  // namespace cusp::geometry::detail
