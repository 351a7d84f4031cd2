// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Finds where each location cuts and shifts it along the normal there.
#include <cusp/toolpath/compensation.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace cusp::toolpath {
namespace {

using geometry::Vector3;

/// 1 up to half of `reach`, 0 from all of it.
double fadeOut(double distance_mm, double reach_mm) { return std::clamp(2.0 - 2.0 * distance_mm / reach_mm, 0.0, 1.0); }

/// The point of the cutter's corner whose outward normal is −`normal`.
Vector3 cornerPoint(const CutterLocation& location, const geometry::Cutter& cutter, const Vector3& normal) {
    constexpr double parallel = 1e-9;
    const Vector3 sideways = -(normal - normal.dot(location.axis) * location.axis);
    const double size = sideways.norm();
    Vector3 centre = location.tip_mm + cutter.corner_f_mm * location.axis;
    if (size > parallel) centre += cutter.corner_e_mm / size * sideways;
    return centre - cutter.corner_radius_mm * normal;
}

base::Result<void> check(const CompensationOptions& options) {
    base::Diagnostics report;
    if (!(options.gain > 0.0 && options.gain <= 1.5))
        report.error("compensate.option",
                     fmt::format("the gain is {}; it must be above 0 and at most 1.5", options.gain));
    if (!(options.clamp_mm > 0.0 && options.clamp_mm <= 1.0))
        report.error("compensate.option",
                     fmt::format("the clamp is {} mm; it must be above 0 and at most 1 mm", options.clamp_mm));
    if (!(options.reach_mm > 0.0))
        report.error("compensate.option", fmt::format("the reach is {} mm; it must be above 0", options.reach_mm));
    if (report.hasErrors()) return base::fail(std::move(report));
    return {};
}

class Compensator {
public:
    Compensator(const ToolPath& path, const geometry::NominalShape& nominal, const geometry::DeviationField& field,
                const CompensationOptions& options)
        : nominal_(nominal), field_(field), options_(options), out_{.path = path, .summary = {}} {}

    base::Result<CompensatedPath> run() {
        for (ClRecord& record : out_.path.records) take(record);
        if (report_.hasErrors()) return base::fail(std::move(report_));
        if (out_.summary.moved == 0)
            return base::fail("compensate.nothing",
                              fmt::format("of {} locations none comes within {} mm of the nominal: another part, or "
                                          "another frame?",
                                          out_.summary.locations, options_.reach_mm),
                              {out_.path.file_name, 0, 0, {}});
        out_.summary.rms_shift_mm = std::sqrt(squares_ / static_cast<double>(out_.summary.moved));
        return std::move(out_);
    }

private:
    void take(ClRecord& record) {
        if (auto* frame = std::get_if<ProgrammingFrame>(&record.statement))
            part_from_path_ = frame->part_from_programming;
        if (auto* tool = std::get_if<ToolCall>(&record.statement)) cutter_ = tool->cutter;
        if (auto* motion = std::get_if<LinearMotion>(&record.statement)) shift(motion->location, record.line);
        if (auto* arc = std::get_if<ArcMotion>(&record.statement)) refuse(arc->end, "arc", record.line);
        if (std::holds_alternative<SplineMotion>(record.statement))
            error("compensate.spline", "NURBS motion cannot be compensated; write the path as points", record.line);
    }

    void shift(CutterLocation& location, std::uint32_t line) {
        ++out_.summary.locations;
        const auto contact = contactOf(location, line);
        if (!contact || !contact->foot.position.allFinite()) return;
        const double fade = fadeOut(contact->gap_mm, options_.reach_mm) *
                            fadeOut(contact->aside_mm, options_.reach_mm + cutter_->diameter_mm);
        if (fade <= 0.0) return;
        const double by_mm = fade * compensationAt(contact->foot.position, contact->foot.normal, field_, options_);
        const double whole_mm = options_.gain * deviationAt(*contact);
        if (std::abs(whole_mm) > options_.clamp_mm) ++out_.summary.clamped;
        if (!field_.covers(contact->foot.position, 1.0)) ++out_.summary.extrapolated;
        const Vector3 shift_mm = by_mm * contact->foot.normal + rolled(location, contact->foot, fade);
        location.tip_mm += part_from_path_.linear().transpose() * shift_mm;
        ++out_.summary.moved;
        out_.summary.max_shift_mm = std::max(out_.summary.max_shift_mm, std::abs(by_mm));
        squares_ += by_mm * by_mm;
    }

    /// What keeps the contact where it is when the surface to cut leans against the nominal by the slope of the shift: the
    /// cutter then touches with another point of its corner. Left out, a cutter that nearly fits the surface would touch far
    /// beside and gouge by slope² / (2 · difference of the curvatures).
    [[nodiscard]] Vector3 rolled(const CutterLocation& location, const geometry::Footpoint& foot, double fade) const {
        constexpr double step_mm = 0.5;
        Vector3 slope = Vector3::Zero();
        Eigen::Index across = 0;
        foot.normal.cwiseAbs().minCoeff(&across);
        const Vector3 first = foot.normal.cross(Vector3::Unit(across)).normalized();
        for (const Vector3& along : {first, Vector3(foot.normal.cross(first))}) {
            const auto ahead = nominal_.closest(foot.position + step_mm * along);
            const auto behind = nominal_.closest(foot.position - step_mm * along);
            const double run_mm = along.dot(ahead.position - behind.position);
            if (!(run_mm > 0.5 * step_mm)) continue;
            slope += along * (fade *
                              (compensationAt(ahead.position, ahead.normal, field_, options_) -
                               compensationAt(behind.position, behind.normal, field_, options_)) /
                              run_mm);
        }
        const CutterLocation in_part{.tip_mm = part_from_path_ * location.tip_mm,
                                     .axis = part_from_path_.linear() * location.axis};
        const Vector3 whole_mm = cornerPoint(in_part, *cutter_, foot.normal) -
                                 cornerPoint(in_part, *cutter_, (foot.normal - slope).normalized());
        // A bottom that lies on the surface has no contact to keep: it would leap from side to side.
        constexpr double flat = 0.005;
        constexpr double most_mm = 0.2;
        const double lean = foot.normal.cross(in_part.axis).norm();
        return std::clamp(lean / flat - 1.0, 0.0, 1.0) * std::min(1.0, most_mm / std::max(whole_mm.norm(), most_mm)) *
               whole_mm;
    }

    [[nodiscard]] double deviationAt(const CutterContact& contact) const {
        return options_.part == CompensatedPart::Form ? field_.form(contact.foot.position)
                                                      : field_.deviation(contact.foot.position, contact.foot.normal);
    }

    std::optional<CutterContact> contactOf(const CutterLocation& location, std::uint32_t line) {
        if (!cutter_) {
            if (!told_) error("compensate.no-cutter", "the tool moves before the path says its shape", line);
            told_ = true;
            return std::nullopt;
        }
        return cutterContact(
            {.tip_mm = part_from_path_ * location.tip_mm, .axis = part_from_path_.linear() * location.axis}, *cutter_,
            nominal_);
    }

    void refuse(const CutterLocation& end, const char* what, std::uint32_t line) {
        const auto contact = contactOf(end, line);
        if (contact && contact->gap_mm < options_.reach_mm)
            error("compensate.arc",
                  fmt::format("an {} ends at the surface; only paths of points can be compensated there", what), line);
    }

    void error(std::string_view code, std::string text, std::uint32_t line) {
        report_.error(code, std::move(text), {out_.path.file_name, line, 0, {}});
    }

    const geometry::NominalShape& nominal_;
    const geometry::DeviationField& field_;
    CompensationOptions options_;
    CompensatedPath out_;
    base::Diagnostics report_;
    geometry::RigidTransform part_from_path_ = geometry::RigidTransform::Identity();
    std::optional<geometry::Cutter> cutter_;
    bool told_ = false;
    double squares_ = 0.0;
};

}  // namespace

CutterContact cutterContact(const CutterLocation& location, const geometry::Cutter& cutter,
                            const geometry::NominalShape& nominal) {
    constexpr int most_steps = 30;
    constexpr double settled = 1e-10;
    const Vector3 begin = location.tip_mm + cutter.corner_f_mm * location.axis;
    CutterContact out{.foot = nominal.closest(begin)};
    Vector3 touch = begin;
    for (int i = 0; i < most_steps && out.foot.position.allFinite(); ++i) {
        const Vector3 normal = out.foot.normal;
        touch = cornerPoint(location, cutter, normal);
        out.foot = nominal.closest(touch);
        if ((out.foot.normal - normal).squaredNorm() < settled * settled) break;
    }
    const Vector3 away = touch - out.foot.position;
    out.gap_mm = away.dot(out.foot.normal);
    out.aside_mm = (away - out.gap_mm * out.foot.normal).norm();
    return out;
}

double compensationAt(const Vector3& position, const Vector3& normal, const geometry::DeviationField& field,
                      const CompensationOptions& options) {
    const double deviation_mm =
        options.part == CompensatedPart::Form ? field.form(position) : field.deviation(position, normal);
    return std::clamp(-options.gain * deviation_mm, -options.clamp_mm, options.clamp_mm);
}

base::Result<CompensatedPath> compensate(const ToolPath& path, const geometry::NominalShape& nominal,
                                         const geometry::DeviationField& field, const CompensationOptions& options) {
    if (const auto ok = check(options); !ok) return base::fail(ok.error());
    return Compensator(path, nominal, field, options).run();
}

}  // namespace cusp::toolpath
