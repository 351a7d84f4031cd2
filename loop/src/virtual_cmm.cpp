// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The touch of the probe.
#include <cusp/loop/virtual_cmm.hpp>

#include <cusp/base/random.hpp>
#include <cusp/simulation/surface_envelope.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace cusp::loop {
namespace {

/// How far from the nominal the part is looked for.
constexpr double band_mm = 1.0;
constexpr simulation::EnvelopeOptions within_band{.band_mm = band_mm};
/// Where else than at the target the ball may rest: rings about it. A ball of 1 mm is 11 µm higher at the outermost.
constexpr std::array<double, 3> rings_mm{0.03, 0.075, 0.15};
constexpr int per_ring = 6;
constexpr std::size_t feet_per_target = 1 + rings_mm.size() * per_ring;

base::Result<void> check(const CmmOptions& options) {
    base::Diagnostics report;
    const auto notNegative = [&](double value, const char* what) {
        if (!(value >= 0.0) || !std::isfinite(value))
            report.error("measure.option", fmt::format("{} is {} mm; it must not be negative", what, value));
    };
    notNegative(options.noise_mm, "the noise");
    notNegative(options.form_mm, "the form error");
    notNegative(options.drift_mm, "the drift");
    if (!(options.probe_radius_mm > rings_mm.back()) || !(options.probe_radius_mm < 100.0))
        report.error("measure.option", fmt::format("the probe's radius is {} mm; it must lie between {} and 100 mm",
                                                   options.probe_radius_mm, rings_mm.back()));
    if (options.approach && std::abs(options.approach->norm() - 1.0) > 1e-9)
        report.error("measure.option", "the approach is no unit vector");
    if (report.hasErrors()) return base::fail(std::move(report));
    return {};
}

/// The target and the rings about it, on the nominal: a sphere of the target's curvature is not assumed, every foot is the
/// nearest point of the shape.
std::vector<simulation::GridPoint> feetOf(std::span<const CmmTarget> contacts, const geometry::NominalShape& nominal) {
    std::vector<Vector3> queries;
    for (const CmmTarget& target : contacts) {
        const Vector3 one = target.normal.unitOrthogonal();
        const Vector3 two = target.normal.cross(one);
        queries.push_back(target.position);
        for (std::size_t r = 0; r < rings_mm.size(); ++r)
            for (int i = 0; i < per_ring; ++i) {
                const double angle = 2.0 * std::numbers::pi * (i + 0.5 * static_cast<double>(r % 2)) / per_ring;
                queries.emplace_back(target.position +
                                     rings_mm.at(r) * (std::cos(angle) * one + std::sin(angle) * two));
            }
    }
    std::vector<geometry::Footpoint> feet(queries.size());
    nominal.closest(queries, feet, false);
    std::vector<simulation::GridPoint> out(feet.size());
    for (std::size_t i = 0; i < feet.size(); ++i) {
        out[i].position = feet[i].position;
        out[i].normal = feet[i].normal;
    }
    return out;
}

/// How far along `approach` the ball's centre stops above where it would rest on the nominal.
double restOf(const CmmTarget& target, const Vector3& approach, double radius_mm,
              std::span<const simulation::GridPoint> feet, std::span<const simulation::EnvelopePoint> part) {
    const Vector3 centre = target.position + radius_mm * target.normal;
    double highest = -band_mm;
    for (std::size_t i = 0; i < feet.size(); ++i) {
        if (!part[i].reached()) continue;
        const Vector3 from = centre - (feet[i].position + part[i].deviation_mm * feet[i].normal);
        const double along = approach.dot(from);
        const double under_root = along * along - from.squaredNorm() + radius_mm * radius_mm;
        if (under_root >= 0.0) highest = std::max(highest, std::sqrt(under_root) - along);
    }
    return highest;
}

/// Trigger and ball: three lobes about the stylus, which stands along Z.
double lobes(const Vector3& contact, double phase) {
    const double around = std::atan2(contact.y(), contact.x());
    return 0.5 * std::cos(3.0 * around + phase) * std::hypot(contact.x(), contact.y());
}

/// Where the ball stops at each target, or nothing where the part is not cut.
struct Touch {
    std::optional<double> along_mm;  ///< along the approach, above where the ball would rest on the nominal
    double deviation_mm = 0.0;       ///< of the part at the target
};

/// One round of looking: the part about every contact.
base::Result<std::vector<Touch>> touch(const simulation::CutterPath& real_path, std::span<const CmmTarget> targets,
                                       std::span<const CmmTarget> contacts, const geometry::NominalShape& nominal,
                                       const CmmOptions& options) {
    const auto envelope =
        simulation::surfaceEnvelope(real_path, simulation::gridOfPoints(feetOf(contacts, nominal)), within_band);
    if (!envelope) return base::fail(envelope.error());
    std::vector<Touch> out(targets.size());
    for (std::size_t i = 0; i < targets.size(); ++i) {
        const std::span feet(envelope->grid.points.data() + i * feet_per_target, feet_per_target);
        const std::span part(envelope->points.data() + i * feet_per_target, feet_per_target);
        if (!part.front().reached()) continue;
        out[i].along_mm =
            restOf(targets[i], options.approach.value_or(targets[i].normal), options.probe_radius_mm, feet, part);
        out[i].deviation_mm = part.front().deviation_mm;
    }
    return out;
}

/// A ball that does not come along the normal ends beside the target: there the part is looked at again.
std::vector<CmmTarget> contactsOf(std::span<const CmmTarget> targets, const std::vector<Touch>& touched,
                                  const geometry::NominalShape& nominal, const CmmOptions& options) {
    std::vector<CmmTarget> out(targets.begin(), targets.end());
    for (std::size_t i = 0; i < out.size(); ++i) {
        if (!touched[i].along_mm) continue;
        const auto foot = nominal.closest(targets[i].position + options.probe_radius_mm * targets[i].normal +
                                          *touched[i].along_mm * *options.approach);
        out[i].position = foot.position;
        out[i].normal = foot.normal;
    }
    return out;
}

base::Result<void> checkApproach(std::span<const CmmTarget> targets, const CmmOptions& options) {
    constexpr double least_cosine = 0.1;
    if (!options.approach) return {};
    for (const CmmTarget& target : targets)
        if (options.approach->dot(target.normal) < least_cosine)
            return base::fail("measure.approach",
                              fmt::format("at X{:.3f} Y{:.3f} Z{:.3f} the probe would come along the surface or from "
                                          "behind; approach along the normal there",
                                          target.position.x(), target.position.y(), target.position.z()));
    return {};
}

Vector3 randomDirection(base::Random& random) {
    Vector3 out(random.normal(), random.normal(), random.normal());
    return out.norm() > 1e-12 ? Vector3(out.normalized()) : Vector3(Vector3::UnitX());
}

}  // namespace

base::Result<CmmRun> measurePart(const simulation::CutterPath& real_path, const CmmPlan& plan,
                                 const geometry::NominalShape& nominal, const CmmOptions& options) {
    if (const auto ok = check(options); !ok) return base::fail(ok.error());
    if (const auto ok = checkApproach(plan.targets, options); !ok) return base::fail(ok.error());
    auto touched = touch(real_path, plan.targets, plan.targets, nominal, options);
    if (!touched) return base::fail(touched.error());
    if (options.approach) {
        const auto there =
            touch(real_path, plan.targets, contactsOf(plan.targets, *touched, nominal, options), nominal, options);
        if (!there) return base::fail(there.error());
        for (std::size_t i = 0; i < there->size(); ++i)
            if ((*touched)[i].along_mm && (*there)[i].along_mm) (*touched)[i].along_mm = (*there)[i].along_mm;
    }
    CmmRun out;
    out.points.format = "csv";
    out.points.unit_stated = true;
    out.points.kind = inspect::PointKind::Centre;
    out.points.probe_radius_mm = options.probe_radius_mm;
    out.points.section_labels = plan.section_labels;
    base::Random random(options.seed);
    const double phase = random.uniform(0.0, 2.0 * std::numbers::pi);
    const Vector3 drift = randomDirection(random) * options.drift_mm;
    const std::size_t last = std::max<std::size_t>(plan.targets.size(), 2) - 1;
    for (std::size_t i = 0; i < plan.targets.size(); ++i) {
        const CmmTarget& target = plan.targets[i];
        const double noise_mm = random.normal(0.0, options.noise_mm);  // drawn whether or not the point is there
        if (!(*touched)[i].along_mm) {
            ++out.not_cut;
            continue;
        }
        const Vector3 approach = options.approach.value_or(target.normal);
        const double along = *(*touched)[i].along_mm + noise_mm + options.form_mm * lobes(-target.normal, phase);
        out.points.positions.emplace_back(target.position + options.probe_radius_mm * target.normal + along * approach +
                                          drift * (static_cast<double>(i) / static_cast<double>(last)));
        out.points.directions.push_back(approach);
        out.points.lines.push_back(0);
        if (!plan.section_labels.empty()) out.points.sections.push_back(target.section);
        out.targets.push_back(target);
        out.true_deviation_mm.push_back((*touched)[i].deviation_mm);
    }
    if (out.targets.empty())
        return base::fail("measure.not-cut",
                          "the tool comes nowhere near the points to be measured: another frame, or another part?");
    return out;
}

base::Result<std::vector<std::optional<double>>> trueDeviations(const simulation::CutterPath& real_path,
                                                                std::span<const CmmTarget> targets) {
    std::vector<simulation::GridPoint> points(targets.size());
    for (std::size_t i = 0; i < targets.size(); ++i) {
        points[i].position = targets[i].position;
        points[i].normal = targets[i].normal;
    }
    const auto envelope =
        simulation::surfaceEnvelope(real_path, simulation::gridOfPoints(std::move(points)), within_band);
    if (!envelope) return base::fail(envelope.error());
    std::vector<std::optional<double>> out;
    for (const auto& point : envelope->points)
        out.push_back(point.reached() ? std::optional(point.deviation_mm) : std::nullopt);
    return out;
}

}  // namespace cusp::loop
