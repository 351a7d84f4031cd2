// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Evaluation of a deviation field.
#include "field_basis.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::geometry {
namespace detail {

AxisTerms axisTerms(const FieldAxis& axis, double coordinate_mm) {
    AxisTerms out;
    if (axis.degree == 0) return out;
    const double length_mm = axis.high_mm - axis.low_mm;
    const double t = std::clamp((coordinate_mm - axis.low_mm) / length_mm, 0.0, 1.0) * axis.cells;
    const double cell = std::min(std::floor(t), static_cast<double>(axis.cells - 1));
    const double u = t - cell;
    const double v = 1.0 - u;
    out.first = static_cast<std::size_t>(cell);
    out.count = 4;
    out.value = {v * v * v / 6.0, (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0,
                 (3.0 * v * v * v - 6.0 * v * v + 4.0) / 6.0, u * u * u / 6.0};
    return out;
}

}  // namespace detail

double DeviationField::form(const Vector3& position) const {
    double sum = 0.0;
    detail::forEachTerm(data_, position,
                        [&](std::size_t index, double value) { sum += data_.coefficients_mm[index] * value; });
    return sum;
}

double DeviationField::pose(const Vector3& position, const Vector3& normal) const {
    return normal.dot(data_.pose_translation_mm + data_.pose_rotation_rad.cross(position - data_.pivot_mm));
}

double DeviationField::deviation(const Vector3& position, const Vector3& normal) const {
    return pose(position, normal) + form(position);
}

bool DeviationField::covers(const Vector3& position, double margin_mm) const {
    const Vector3 at = data_.field_from_nominal * position;
    for (std::size_t k = 0; k < 3; ++k) {
        const FieldAxis& axis = data_.axes[k];
        const double coordinate_mm = at[static_cast<Eigen::Index>(k)];
        if (!(coordinate_mm >= axis.low_mm - margin_mm && coordinate_mm <= axis.high_mm + margin_mm)) return false;
    }
    return true;
}

}  // namespace cusp::geometry
