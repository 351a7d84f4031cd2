// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where the probe goes: points of sections, and points from a list.
#include <cusp/loop/virtual_cmm.hpp>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace cusp::loop {
namespace {

using geometry::Footpoint;
using geometry::NominalShape;

/// Nothing ends and nothing bends sharply within `margin_mm` of the point.
bool isAwayFromEdges(const NominalShape& nominal, const Footpoint& at, double margin_mm) {
    if (at.on_boundary) return false;
    if (margin_mm <= 0.0) return true;
    constexpr double sharp_cosine = 0.94;  // 20°
    constexpr int directions = 8;
    const Vector3 one = at.normal.unitOrthogonal();
    const Vector3 two = at.normal.cross(one);
    for (int i = 0; i < directions; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / directions;
        const Footpoint near =
            nominal.closest(at.position + margin_mm * (std::cos(angle) * one + std::sin(angle) * two));
        if (near.on_boundary || near.normal.dot(at.normal) < sharp_cosine) return false;
    }
    return true;
}

/// The point of the surface on the line through `start` along axis `height`: by Newton's method on tangent planes.
std::optional<Footpoint> pointOnLine(const NominalShape& nominal, Vector3 start, int height) {
    constexpr int most_steps = 40;
    constexpr double close_mm = 1e-10;
    constexpr double least_slope = 1e-3;
    for (int i = 0; i < most_steps; ++i) {
        const Footpoint foot = nominal.closest(start);
        if (!foot.position.allFinite() || std::abs(foot.normal[height]) < least_slope) return std::nullopt;
        if (std::abs(foot.distance_mm) < close_mm) return foot;
        if (foot.on_boundary && i > most_steps / 2) return std::nullopt;
        start[height] += foot.normal.dot(foot.position - start) / foot.normal[height];
    }
    return std::nullopt;
}

/// The axis along which the surface is high: the one its normals point along most, the section's aside.
int heightAxis(const NominalShape& nominal, int section_axis) {
    const auto box = nominal.bounds();
    Vector3 sum = Vector3::Zero();
    constexpr int looks = 5;
    for (int i = 0; i < looks; ++i)
        for (int j = 0; j < looks; ++j)
            for (int k = 0; k < looks; ++k) {
                const Vector3 share((i + 0.5) / looks, (j + 0.5) / looks, (k + 0.5) / looks);
                sum += nominal.closest(box.min() + share.cwiseProduct(box.sizes())).normal.cwiseAbs();
            }
    sum[section_axis] = -1.0;
    Eigen::Index highest = 2;
    sum.maxCoeff(&highest);
    return static_cast<int>(highest);
}

}  // namespace

base::Result<CmmPlan> sectionTargets(const NominalShape& nominal, const inspect::SectionPlan& sections,
                                     const SectionSteps& steps) {
    if (!(steps.step_mm > 1e-3) || !(steps.edge_margin_mm >= 0.0))
        return base::fail("measure.step",
                          fmt::format("the step is {} mm and the margin {} mm; the step must be above 0.001 "
                                      "mm and the margin not negative",
                                      steps.step_mm, steps.edge_margin_mm));
    const auto box = nominal.bounds();
    const int height = heightAxis(nominal, sections.axis);
    const int along = 3 - sections.axis - height;
    CmmPlan out;
    base::Diagnostics report;
    for (const double position : sections.positions_mm) {
        const auto label = static_cast<std::int32_t>(out.section_labels.size());
        out.section_labels.push_back(inspect::sectionLabel(sections.axis, position));
        const std::size_t before = out.targets.size();
        Vector3 start = box.center();
        start[sections.axis] = position;
        // Whole multiples of the step, so that the same section of two parts has the same targets.
        for (double at = std::ceil(box.min()[along] / steps.step_mm) * steps.step_mm; at <= box.max()[along];
             at += steps.step_mm) {
            start[along] = at;
            const auto foot = pointOnLine(nominal, start, height);
            if (!foot) continue;
            start[height] = foot->position[height];
            if (!isAwayFromEdges(nominal, *foot, steps.edge_margin_mm)) continue;
            out.targets.push_back({.position = foot->position, .normal = foot->normal, .section = label});
        }
        if (out.targets.size() == before)
            report.error("measure.section",
                         fmt::format("section {} has no point to measure: the nominal reaches from {:.3f} to {:.3f} mm "
                                     "there, less {} mm at its edges",
                                     out.section_labels.back(), box.min()[sections.axis], box.max()[sections.axis],
                                     steps.edge_margin_mm));
    }
    if (report.hasErrors()) return base::fail(std::move(report));
    return out;
}

base::Result<CmmPlan> listedTargets(const NominalShape& nominal, const inspect::MeasuredPoints& listed) {
    constexpr double on_surface_mm = 0.01;
    CmmPlan out{.targets = {}, .section_labels = listed.section_labels};
    base::Diagnostics report;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const Footpoint foot = nominal.closest(listed.positions[i]);
        const std::size_t line = i < listed.lines.size() ? listed.lines[i] : 0;
        if (std::abs(foot.distance_mm) > on_surface_mm || foot.on_boundary)
            report.error("measure.targets",
                         foot.on_boundary
                             ? fmt::format("the point lies at an edge of the nominal or beyond it")
                             : fmt::format("the point lies {:.4f} mm from the nominal; targets are points of it",
                                           std::abs(foot.distance_mm)),
                         {listed.source, line, 0, {}});
        out.targets.push_back({.position = foot.position,
                               .normal = foot.normal,
                               .section = listed.sections.empty() ? -1 : listed.sections[i]});
    }
    if (report.hasErrors()) return base::fail(std::move(report));
    return out;
}

}  // namespace cusp::loop
