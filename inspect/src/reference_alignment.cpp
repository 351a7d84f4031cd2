// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Gauss–Newton on the distances along the reference directions.
#include <cusp/inspect/reference_alignment.hpp>

#include "alignment/least_squares.hpp"
#include "alignment/rotation.hpp"
#include "points/point_text.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cusp::inspect {
namespace {

using geometry::Vector3;

/// Rotation and translation from the two sets of points alone, directions left aside (Kabsch): a start good enough for
/// any pose. Points named more than once weigh more, which does no harm here.
geometry::RigidTransform startOf(std::span<const ReferencePoint> references) {
    Eigen::Matrix3Xd from(3, static_cast<Eigen::Index>(references.size()));
    Eigen::Matrix3Xd to(from);
    for (Eigen::Index i = 0; i < from.cols(); ++i) {
        from.col(i) = references[static_cast<std::size_t>(i)].measured;
        to.col(i) = references[static_cast<std::size_t>(i)].nominal;
    }
    geometry::RigidTransform out;
    out.matrix() = Eigen::umeyama(from, to, false);
    return out;
}

NormalEquations equationsAt(std::span<const ReferencePoint> references, const geometry::RigidTransform& pose,
                            const Vector3& pivot, double length_mm) {
    NormalEquations out;
    for (const ReferencePoint& r : references) {
        const Vector3 moved = pose * r.measured;
        const double e = (moved - r.nominal).dot(r.direction);
        Vector6 J;
        J.head<3>() = r.direction;
        J.tail<3>() = (moved - pivot).cross(r.direction) / length_mm;
        out.H += J * J.transpose();
        out.g += e * J;
        out.cost += e * e;
    }
    return out;
}

constexpr std::array<std::string_view, 9> columns{"measured_x", "measured_y", "measured_z", "nominal_x", "nominal_y",
                                                  "nominal_z",  "i",          "j",          "k"};

}  // namespace

base::Result<ReferenceAlignment> alignToReferences(std::span<const ReferencePoint> references) {
    if (references.size() < 6)
        return base::fail(
            "reference.too-few",
            fmt::format("{} reference directions cannot fix six freedoms; six are needed", references.size()));
    Vector3 pivot = Vector3::Zero();
    for (const ReferencePoint& r : references) pivot += r.nominal / static_cast<double>(references.size());
    double length_mm = 0.0;
    for (const ReferencePoint& r : references) length_mm = std::max(length_mm, (r.nominal - pivot).norm());
    length_mm = std::max(length_mm, 1e-6);
    ReferenceAlignment out;
    out.nominal_from_measured = startOf(references);
    constexpr int most_iterations = 100;
    constexpr std::array<bool, 6> nothing_locked{};
    double step_mm = std::numeric_limits<double>::infinity();
    while (step_mm > 1e-13 * (length_mm + pivot.norm()) && out.iterations < most_iterations) {
        const auto equations = equationsAt(references, out.nominal_from_measured, pivot, length_mm);
        const auto undetermined = determinationOf(equations.H, nothing_locked).undetermined;
        if (!undetermined.empty()) {
            std::vector<std::string_view> names;
            std::transform(undetermined.begin(), undetermined.end(), std::back_inserter(names), freedomName);
            return base::fail("reference.not-determined",
                              fmt::format("the reference directions leave {} free", fmt::join(names, ", ")));
        }
        const Vector6 step = dampedStep(equations, nothing_locked, 0.0);
        const PoseModel model{pivot, length_mm};
        out.nominal_from_measured = model.motion(step) * out.nominal_from_measured;
        step_mm = step.norm();
        ++out.iterations;
    }
    if (out.iterations == most_iterations)
        return base::fail(
            "reference.not-converged",
            "measured and nominal reference points are not the same figure: no pose brings them together");
    for (const ReferencePoint& r : references)
        out.residuals_mm.push_back((out.nominal_from_measured * r.measured - r.nominal).dot(r.direction));
    return out;
}

base::Result<std::vector<ReferencePoint>> readReferences(std::string_view text, const std::string& name) {
    base::Diagnostics problems;
    std::vector<ReferencePoint> out;
    std::vector<std::string_view> fields;
    std::size_t line_number = 0;
    bool has_header = false;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        const std::string_view line = trimmed(text.substr(0, end));
        text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
        base::Location where;
        where.file = name;
        where.line = ++line_number;
        if (line.empty() || line.starts_with('#')) continue;
        splitFields(line, line.find(';') != std::string_view::npos ? ';' : ',', fields);
        if (!has_header) {
            has_header = true;
            if (std::equal(fields.begin(), fields.end(), columns.begin(), columns.end())) continue;
            return base::fail("reference.header", fmt::format("the header must be {}", fmt::join(columns, ",")), where);
        }
        if (fields.size() != columns.size()) {
            problems.error("reference.columns", fmt::format("{} columns where there must be 9", fields.size()), where);
            continue;
        }
        std::array<double, 9> v{};
        bool sound = true;
        for (std::size_t i = 0; i < v.size(); ++i) {
            const auto value = parseNumber(fields[i], '.');
            sound = sound && value.has_value();
            if (!value)
                problems.error("reference.number",
                               fmt::format("{}: {} is no number", columns.at(i), inQuotes(fields[i])), where);
            constexpr double largest_mm = 1e9;  // squares of more than this lose every digit of the others
            if (value && !(std::abs(*value) <= largest_mm)) {
                sound = false;
                problems.error("reference.number", fmt::format("{}: beyond 1e9", columns.at(i)), where);
            }
            v.at(i) = value.value_or(0.0);
        }
        const Vector3 direction(v[6], v[7], v[8]);
        if (sound && std::abs(direction.norm() - 1.0) > 0.01)
            problems.error("reference.direction",
                           fmt::format("i, j, k have the length {:.4g}, not 1", direction.norm()), where);
        out.push_back({{v[0], v[1], v[2]}, {v[3], v[4], v[5]}, direction.normalized()});
    }
    if (problems.hasErrors()) return base::fail(problems);
    return out;
}

}  // namespace cusp::inspect
