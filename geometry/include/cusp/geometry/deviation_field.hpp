// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A smooth deviation along the outward normal over a part: made from measured points, applied by a compensation.
#pragma once

#include <cusp/base/json_report.hpp>
#include <cusp/base/result.hpp>
#include <cusp/geometry/frames.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::geometry {

/// One measured deviation, in the nominal frame.
struct DeviationSample {
    Vector3 position = Vector3::Zero();  ///< footpoint on the nominal, mm
    Vector3 normal = Vector3::UnitZ();   ///< there, unit, out of the material
    double deviation_mm = 0.0;           ///< along the normal, > 0 outside the material
};

struct DeviationFieldOptions {
    /// Waves shorter than this are left out, so that scallops are not chased: knots lie half of it apart. 0: a quarter of
    /// the longest side of the samples' box. Taken longer (and told) where more than 400 coefficients would be needed.
    double shortest_wave_mm = 0.0;
    /// First take off what a shift and a small turn of the part explain.
    bool separate_pose = true;
    /// Of more samples than this, that many at equal steps are used.
    std::size_t most_samples = 100'000;
};

/// A uniform B-spline along one axis of the field; degree 3, or 0 (one cell) along which the field does not change.
struct FieldAxis {
    int degree = 0;
    int cells = 1;
    double low_mm = 0.0;  ///< of the samples along the axis
    double high_mm = 0.0;

    [[nodiscard]] std::size_t coefficients() const {
        return static_cast<std::size_t>(cells) + static_cast<std::size_t>(degree);
    }
};

/// d(p, n) = n·(t + ω × (p − pivot)) + f(p): the pose of the part, linearised, and its form. f is a tensor product of
/// uniform B-splines over the space the nominal lies in, not over the parameters of its faces, so that it needs no faces and
/// runs on across them. Where all normals lean less than 78° from their mean, f does not change along that mean; otherwise
/// it lives in three dimensions, and the two sides of a wall thinner than `shortest_wave_mm` share one value.
///
///     const auto field = DeviationField::fit(samples, {});         // or readReportedDeviationField(report.json)
///     field->deviation(footpoint.position, footpoint.normal);      // mm along the normal: pose and form
///     field->form(footpoint.position);                             // form only
///
/// f minimises Σ(d − f)² + λ·∫(f_xx² + f_yy² + f_zz²); the integral by second differences of coefficients (Eilers & Marx
/// 1996), which also bridges gaps between sections. λ by generalised cross-validation (Craven & Wahba 1979), a freedom
/// counting 1.4 times (Kim & Gu 2004), over means of blocks a quarter of the shortest wave long: neighbours along a section
/// share their scallop and their chord, and must not foretell each other. Outside the samples' box f keeps its value at the box.
class DeviationField {
public:
    /// All that is known of a field; what JSON holds.
    struct Data {
        double shortest_wave_mm = 0.0;
        Matrix3 field_from_nominal = Matrix3::Identity();  ///< rotation into the axes of the spline
        std::array<FieldAxis, 3> axes{};
        std::vector<double> coefficients_mm;  ///< the third axis runs fastest
        Vector3 pose_translation_mm = Vector3::Zero();
        Vector3 pose_rotation_rad = Vector3::Zero();  ///< about the pivot
        Vector3 pivot_mm = Vector3::Zero();
        std::size_t samples = 0;          ///< that were used
        double effective_freedoms = 0.0;  ///< of pose and form: between 1 and 6 + the number of coefficients
        double smoothing = 0.0;           ///< λ, per sample, in mm⁴
        double rms_mm = 0.0;              ///< of the samples
        double residual_mm = 0.0;         ///< standard deviation of what the field leaves: noise, scallops, short waves
    };

    /// Errors: `deviation-field.too-few` (12 samples at least), `deviation-field.not-finite`, `deviation-field.wave`.
    [[nodiscard]] static base::Result<DeviationField> fit(std::span<const DeviationSample> samples,
                                                          const DeviationFieldOptions& options);
    /// What `toJson` wrote. `where.key` is the path of `json` in its file. Errors, with the key's path: `deviation-field.key`
    /// (missing, or of another type), `deviation-field.value` (a number that cannot be), `deviation-field.schema`.
    [[nodiscard]] static base::Result<DeviationField> fromJson(const base::Json& json, const base::Location& where);
    [[nodiscard]] base::Json toJson() const;

    /// Along the outward `normal` (unit) at `position` on the nominal; pose and form. In mm.
    [[nodiscard]] double deviation(const Vector3& position, const Vector3& normal) const;
    /// What the pose explains of it.
    [[nodiscard]] double pose(const Vector3& position, const Vector3& normal) const;
    /// What is left: the form, low-passed.
    [[nodiscard]] double form(const Vector3& position) const;
    /// Whether `position` lies in the box of the samples, or at most `margin_mm` outside.
    [[nodiscard]] bool covers(const Vector3& position, double margin_mm = 0.0) const;

    [[nodiscard]] const Data& data() const { return data_; }

private:
    explicit DeviationField(Data data) : data_(std::move(data)) {}
    Data data_;
};

/// The field a report of `cusp inspect` holds (report.json or `--json`), `frame` being "datum" or "best_fit".
/// Errors: those of `fromJson`; `json.syntax`; `deviation-field.none` (the report says why there is none).
[[nodiscard]] base::Result<DeviationField>
readReportedDeviationField(std::string_view json_text, const std::string& file_name, std::string_view frame);

}  // namespace cusp::geometry
