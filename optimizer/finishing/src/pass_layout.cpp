// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Passes along parameters and along planes, spaced evenly, along the surface, or by the ridge they leave.
#include "pass_trim.hpp"
#include "plane_sections.hpp"
#include "silhouette.hpp"

#include <cusp/optimizer/finishing/pass_layout.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cusp::finishing {

namespace {

using geometry::SurfaceFace;
using Family = PassOptions::Family;
using Placement = PassOptions::Placement;

constexpr std::size_t along_samples = 33;    ///< of a curve that is no line in the parameters
constexpr std::size_t across_samples = 129;  ///< on which spacing is summed up
constexpr std::int64_t most_passes = 20000;

struct Spacing {
    const geometry::Cutter* cutter;
    const PlanOptions* options;

    /// Passes per mm across the feed.
    [[nodiscard]] double density(const PassPoint& point) const {
        const PassOptions& passes = options->passes;
        if (passes.placement != Placement::Scallop) return 1.0 / passes.step_over_mm;
        const double lead = wantedLead(*cutter, point, options->orientation);
        const double curvature = geometry::normalCurvature(point.surface, point.frame.normal, point.frame.left);
        const double width = stripWidth(*cutter, lead, options->orientation.tilt_rad, curvature, passes.scallop_mm);
        return 1.0 / std::min(passes.step_over_mm, std::max(width, 1e-6));
    }
};

/// Where in 0 … total each pass lies.
std::vector<double> placesOf(double total, const PassOptions& passes) {
    if (!passes.places.empty()) return passes.places;
    const double wanted = std::ceil(total - 1e-9) + (passes.on_edges ? 1.0 : 0.0);
    const auto count = std::max<std::int64_t>(
        passes.on_edges ? 2 : 1,
        passes.count ? *passes.count : static_cast<std::int64_t>(std::min(wanted, 1.0 + most_passes)));
    std::vector<double> out;
    for (std::int64_t i = 0; i < count && count <= most_passes; ++i)
        out.push_back(passes.on_edges ? static_cast<double>(i) / static_cast<double>(count - 1)
                                      : (static_cast<double>(i) + 0.5) / static_cast<double>(count));
    return out;
}

base::Result<std::vector<double>> checked(std::vector<double> places) {
    if (places.empty())
        return base::fail(
            "finishing.too-many-passes",
            fmt::format("more than {} passes would be needed; a larger step-over or scallop is", most_passes));
    return places;
}

/// The value at `wanted` of a table that ascends.
double inverse(const std::vector<double>& table, double wanted, double first, double last) {
    const auto above = std::upper_bound(table.begin() + 1, table.end() - 1, wanted);
    const auto i = static_cast<std::size_t>(above - table.begin());
    const double step = table[i] - table[i - 1];
    const double x = step > 0.0 ? (wanted - table[i - 1]) / step : 0.5;
    const double share = (static_cast<double>(i - 1) + std::clamp(x, 0.0, 1.0)) / static_cast<double>(table.size() - 1);
    return std::lerp(first, last, share);
}

/// Passes along one parameter of a face, spaced in the other one.
class ParameterPasses {
public:
    ParameterPasses(const SurfaceFace& face, std::uint32_t index, const Spacing& spacing)
        : face_(face),
          index_(index),
          spacing_(spacing),
          across_u_(spacing.options->passes.family == Family::ConstantU),
          across_(across_u_ ? face.breaksU() : face.breaksV()),
          along_(across_u_ ? face.breaksV() : face.breaksU()) {}

    [[nodiscard]] base::Result<std::vector<PassCurve>> lay() const {
        return spacing_.options->passes.placement == Placement::Even ? even() : spaced();
    }

private:
    [[nodiscard]] FaceParameters uv(double across, double along) const {
        return across_u_ ? FaceParameters{across, along} : FaceParameters{along, across};
    }
    [[nodiscard]] double alongAt(double share) const { return std::lerp(along_.front(), along_.back(), share); }
    [[nodiscard]] double acrossAt(double share) const { return std::lerp(across_.front(), across_.back(), share); }

    [[nodiscard]] PassPoint pointAt(double across, double along) const {
        PassPoint point;
        point.uv = uv(across, along);
        point.surface = face_.evaluate(point.uv[0], point.uv[1]);
        const Vector3& feed = across_u_ ? point.surface.dv : point.surface.du;
        const Vector3 normal = face_.outwardSign() * geometry::crossNormal(point.surface);
        if (normal.squaredNorm() > 0.5) point.frame = feedFrame(normal, feed);
        return point;
    }

    /// Passes that fit between the two sides at one place along: the running sum across the face.
    [[nodiscard]] std::vector<double> sumAt(double along) const {
        std::vector<double> sums(across_samples, 0.0);
        double before = 0.0;
        const double step = (across_.back() - across_.front()) / static_cast<double>(across_samples - 1);
        for (std::size_t i = 0; i < across_samples; ++i) {
            const double share = static_cast<double>(i) / static_cast<double>(across_samples - 1);
            const PassPoint point = pointAt(acrossAt(share), along);
            const Vector3& way = across_u_ ? point.surface.du : point.surface.dv;
            const double here = std::abs(way.dot(point.frame.left)) * spacing_.density(point);
            if (i > 0) sums[i] = sums[i - 1] + step * (before + here) / 2.0;
            before = here;
        }
        return sums;
    }

    [[nodiscard]] base::Result<std::vector<PassCurve>> even() const {
        double widest = 0.0;
        for (std::size_t i = 0; i < along_samples; ++i)
            widest = std::max(widest, sumAt(alongAt(static_cast<double>(i) / (along_samples - 1))).back());
        const PassOptions& passes = spacing_.options->passes;
        const auto fitting = static_cast<std::int64_t>(std::min(std::floor(widest + 1e-9), 1.0 + most_passes));
        PassOptions placed;
        placed.count = passes.count.value_or(std::max<std::int64_t>(1, fitting));
        placed.on_edges = passes.on_edges;
        auto places = checked(placesOf(1.0, placed));
        if (!places) return base::fail(places.error());
        std::vector<PassCurve> out;
        for (const double place : *places)
            out.emplace_back(face_, index_,
                             std::vector{uv(acrossAt(place), along_.front()), uv(acrossAt(place), along_.back())},
                             static_cast<std::uint32_t>(out.size()));
        return out;
    }

    [[nodiscard]] base::Result<std::vector<PassCurve>> spaced() const {
        std::vector<std::vector<double>> sums;
        double total = 0.0;
        for (std::size_t i = 0; i < along_samples; ++i) {
            sums.push_back(sumAt(alongAt(static_cast<double>(i) / (along_samples - 1))));
            total = std::max(total, sums.back().back());
        }
        auto places = checked(placesOf(total, spacing_.options->passes));
        if (!places) return base::fail(places.error());
        std::vector<PassCurve> out;
        for (const double place : *places) {
            std::vector<FaceParameters> samples;
            for (std::size_t i = 0; i < along_samples; ++i)
                samples.push_back(uv(inverse(sums[i], place * sums[i].back(), across_.front(), across_.back()),
                                     alongAt(static_cast<double>(i) / (along_samples - 1))));
            out.emplace_back(face_, index_, std::move(samples), static_cast<std::uint32_t>(out.size()));
        }
        return out;
    }

    const SurfaceFace& face_;
    std::uint32_t index_;
    const Spacing& spacing_;
    bool across_u_;
    const std::vector<double>& across_;
    const std::vector<double>& along_;
};

/// Passes where parallel planes cut a face.
class PlanePasses {
public:
    PlanePasses(const SurfaceFace& face, std::uint32_t index, const Spacing& spacing)
        : face_(face),
          index_(index),
          spacing_(spacing),
          normal_(geometry::toVector(spacing.options->passes.plane_normal).normalized()),
          sections_(face, normal_) {}

    [[nodiscard]] base::Result<std::vector<PassCurve>> lay() const {
        auto heights = spacing_.options->passes.placement == Placement::Even ? even() : spaced();
        if (!heights) return base::fail(heights.error());
        std::vector<PassCurve> out;
        Vector3 direction = Vector3::Zero();
        for (std::uint32_t lane = 0; lane < heights->size(); ++lane) {
            const auto first = out.size();
            for (auto& samples : sections_.at((*heights)[lane], along_samples, least_mm)) {
                PassCurve curve(face_, index_, std::move(samples), lane);
                const Vector3 chord = curve.position(1.0) - curve.position(0.0);
                if (direction.isZero()) direction = chord;
                if (chord.dot(direction) < 0.0) curve.reverse();
                out.push_back(std::move(curve));
            }
            std::sort(out.begin() + static_cast<std::ptrdiff_t>(first), out.end(),
                      [&](const PassCurve& a, const PassCurve& b) {
                          return a.position(0.0).dot(direction) < b.position(0.0).dot(direction);
                      });
        }
        if (!heights->empty() && out.empty())
            return base::fail(
                "finishing.no-passes",
                fmt::format("planes across ({:g}, {:g}, {:g}) miss the surface; another plane_normal, or passes "
                            "along a parameter, would not",
                            normal_.x(), normal_.y(), normal_.z()));
        return out;
    }

private:
    static constexpr double least_mm = 0.01;

    [[nodiscard]] base::Result<std::vector<double>> even() const {
        const PassOptions& passes = spacing_.options->passes;
        const auto [low, high] = sections_.range();
        const double step = passes.count ? (high - low) / static_cast<double>(*passes.count) : passes.step_over_mm;
        const auto fitting =
            static_cast<std::int64_t>(std::min(std::floor((high - low) / step + 1e-9), 1.0 + most_passes));
        const auto count = std::max<std::int64_t>(1, passes.count.value_or(fitting));
        if (count > most_passes) return checked({});
        std::vector<double> out;
        for (std::int64_t i = 0; i < count; ++i)
            out.push_back((low + high) / 2.0 + step * (static_cast<double>(i) - static_cast<double>(count - 1) / 2.0));
        return out;
    }

    /// The densest place of each height decides.
    [[nodiscard]] base::Result<std::vector<double>> spaced() const {
        const auto [low, high] = sections_.range();
        std::vector<double> dense(across_samples, 0.0);
        const auto at = [&](double share, const std::vector<double>& breaks) {
            return std::lerp(breaks.front(), breaks.back(), share);
        };
        for (std::size_t i = 0; i < across_samples; ++i)
            for (std::size_t j = 0; j < across_samples; ++j) {
                PassPoint point;
                point.uv = {at(static_cast<double>(i) / (across_samples - 1), face_.breaksU()),
                            at(static_cast<double>(j) / (across_samples - 1), face_.breaksV())};
                point.surface = face_.evaluate(point.uv[0], point.uv[1]);
                const Vector3 out = face_.outwardSign() * geometry::crossNormal(point.surface);
                const Vector3 climb = normal_ - normal_.dot(out) * out;
                constexpr double flattest = 0.05;  // a plane that lies along the surface there has no pass to space
                if (out.squaredNorm() < 0.5 || climb.norm() < flattest) continue;
                point.frame = feedFrame(out, climb.cross(out));
                const double share = (normal_.dot(point.surface.position) - low) / (high - low);
                const auto bin = static_cast<std::size_t>(
                    std::clamp(share, 0.0, 1.0) * static_cast<double>(across_samples - 1) + 0.5);
                dense[bin] = std::max(dense[bin], spacing_.density(point) / climb.norm());
            }
        std::vector<double> sums(across_samples, 0.0);
        const double step = (high - low) / static_cast<double>(across_samples - 1);
        for (std::size_t i = 1; i < across_samples; ++i) {
            if (dense[i] == 0.0) dense[i] = dense[i - 1];
            sums[i] = sums[i - 1] + step * (dense[i - 1] + dense[i]) / 2.0;
        }
        auto places = checked(placesOf(sums.back(), spacing_.options->passes));
        if (places)
            for (double& place : *places) place = inverse(sums, place * sums.back(), low, high);
        return places;
    }

    const SurfaceFace& face_;
    std::uint32_t index_;
    const Spacing& spacing_;
    Vector3 normal_;
    PlaneSections sections_;
};

}  // namespace

double wantedLead(const geometry::Cutter& cutter, const PassPoint& point, const OrientationOptions& orientation) {
    if (!orientation.adaptive) return orientation.lead_rad;
    const auto& [normal, feed, left] = point.frame;
    // Across the feed the silhouette must be rounder than the surface; along it the heel must clear the surface behind.
    const double hollow = std::max(geometry::normalCurvature(point.surface, normal, left),
                                   geometry::normalCurvature(point.surface, normal, feed));
    const auto matched = matchedLead(cutter, orientation.curvature_safety * hollow);
    return std::clamp(matched.value_or(orientation.lead_max_rad), orientation.lead_rad,
                      std::max(orientation.lead_rad, orientation.lead_max_rad));
}

base::Result<std::vector<PassCurve>> layOutPasses(std::span<const SurfaceFace> faces,
                                                  const geometry::ParametricSurface* shape,
                                                  const geometry::Cutter& cutter, const PlanOptions& options) {
    const Spacing spacing{&cutter, &options};
    std::vector<PassCurve> out;
    for (std::uint32_t i = 0; i < faces.size(); ++i) {
        auto passes = options.passes.family == Family::Planes ? PlanePasses(faces[i], i, spacing).lay()
                                                              : ParameterPasses(faces[i], i, spacing).lay();
        if (!passes) return base::fail(passes.error());
        if (options.passes.from_last) std::reverse(passes->begin(), passes->end());
        for (PassCurve& pass : *passes) {
            if (shape == nullptr || shape->trimmedFaces() == 0)
                out.push_back(std::move(pass));
            else
                trimPass(pass, *shape, out);
        }
    }
    if (out.empty()) return base::fail("finishing.no-passes", "no pass fits on the surface: a smaller step-over would");
    bool backwards = options.passes.reverse;
    for (PassCurve& pass : out) {
        if (backwards) pass.reverse();
        if (options.passes.order == PassOptions::Order::ZigZag) backwards = !backwards;
    }
    return out;
}

}  // namespace cusp::finishing
