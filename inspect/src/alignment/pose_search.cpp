// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Starts from uniform rotations and principal axes; a few are carried on to the end.
#include <cusp/inspect/pose_search.hpp>

#include "alignment/least_squares.hpp"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cusp::inspect {
namespace {

constexpr std::size_t first_sample = 120;
constexpr std::size_t last_sample = 1000;
constexpr std::size_t second_round = 24;
constexpr std::size_t finalists = 8;
constexpr std::size_t winners = 2;

std::vector<Vector3> sampled(std::span<const Vector3> points, std::size_t wanted, bool mirrored) {
    const std::size_t count = std::min(points.size(), wanted);
    std::vector<Vector3> out;
    for (std::size_t i = 0; i < count; ++i) {
        Vector3 p = points[i * points.size() / count];
        if (mirrored) p.x() = -p.x();
        out.push_back(p);
    }
    return out;
}

struct Spread {
    Vector3 center = Vector3::Zero();
    geometry::Matrix3 axes = geometry::Matrix3::Identity();  ///< principal, a right-handed frame
};

Spread spreadOf(const std::vector<Vector3>& points) {
    Spread out;
    for (const Vector3& p : points) out.center += p / static_cast<double>(points.size());
    geometry::Matrix3 moments = geometry::Matrix3::Zero();
    for (const Vector3& p : points) moments += (p - out.center) * (p - out.center).transpose();
    out.axes = Eigen::SelfAdjointEigenSolver<geometry::Matrix3>(moments).eigenvectors();
    if (out.axes.determinant() < 0.0) out.axes.col(0) = -out.axes.col(0);
    return out;
}

RigidTransform poseBetween(const Spread& from, const Spread& to, const geometry::Matrix3& rotation) {
    RigidTransform out = RigidTransform::Identity();
    out.linear() = rotation;
    out.translation() = to.center - rotation * from.center;
    return out;
}

/// Super-Fibonacci spirals (Alexa 2022): n rotations as uniform as they get.
std::vector<geometry::Matrix3> uniformRotations(std::size_t n) {
    std::vector<geometry::Matrix3> out;
    constexpr double phi = std::numbers::sqrt2;
    constexpr double psi = 1.533751168755204288118041;
    for (std::size_t i = 0; i < n; ++i) {
        const double s = static_cast<double>(i) + 0.5;
        const double r = std::sqrt(s / static_cast<double>(n));
        const double R = std::sqrt(1.0 - s / static_cast<double>(n));
        const double a = 2.0 * std::numbers::pi * s / phi;
        const double b = 2.0 * std::numbers::pi * s / psi;
        out.push_back(
            Eigen::Quaterniond(r * std::sin(a), r * std::cos(a), R * std::sin(b), R * std::cos(b)).toRotationMatrix());
    }
    return out;
}

FoundPose refined(const std::vector<Vector3>& points, const RigidTransform& start,
                  const geometry::NominalShape& nominal, double offset_mm, int iterations) {
    std::vector<Vector3> moved;
    moved.reserve(points.size());
    for (const Vector3& p : points) moved.emplace_back(start * p);
    const Spread spread = spreadOf(moved);
    double square_sum = 0.0;
    for (const Vector3& p : moved) square_sum += (p - spread.center).squaredNorm();
    const PoseModel model{spread.center, std::max(std::sqrt(square_sum / static_cast<double>(moved.size())), 1e-9)};
    ResidualField field(std::move(moved), {}, nominal, model, offset_mm);
    const SolveOutcome outcome = solveLeastSquares(field, {}, iterations, 1e-5 * model.length_mm);
    FoundPose out;
    out.nominal_from_measured = model.motion(field.parameters()) * start;
    out.rms_mm = std::sqrt(outcome.equations.square_sum / std::max(outcome.equations.weight_sum, 1.0));
    return out;
}

/// Every pose carried on with these points; the `kept` best ones remain, the best first.
void carryOn(std::vector<FoundPose>& found, const std::vector<Vector3>& points, const geometry::NominalShape& nominal,
             double offset_mm, int iterations, std::size_t kept) {
    for (FoundPose& pose : found) {
        const bool from_candidate = pose.from_candidate;
        pose = refined(points, pose.nominal_from_measured, nominal, offset_mm, iterations);
        pose.from_candidate = from_candidate;
    }
    std::sort(found.begin(), found.end(), [](const FoundPose& a, const FoundPose& b) { return a.rms_mm < b.rms_mm; });
    if (found.size() > kept) found.resize(kept);
}

}  // namespace

std::vector<geometry::Footpoint> sampleNominal(const geometry::NominalShape& nominal, std::size_t wanted) {
    const Eigen::AlignedBox3d box = nominal.bounds();
    const double longest = std::max(box.sizes().maxCoeff(), 1e-9);
    std::vector<geometry::Footpoint> out;
    for (int cells = 8; cells <= 128 && out.size() < wanted; cells *= 2) {
        const double step = longest / cells;
        const Eigen::Array3i counts = (box.sizes().array() / step).floor().cast<int>() + 2;
        std::vector<Vector3> nodes;
        for (int x = 0; x < counts[0]; ++x)
            for (int y = 0; y < counts[1]; ++y)
                for (int z = 0; z < counts[2]; ++z) nodes.emplace_back(box.min() + step * Vector3(x, y, z));
        std::vector<geometry::Footpoint> feet(nodes.size());
        nominal.closest(nodes, feet, false);
        out.clear();
        // Nodes of the cells the surface passes through: each piece of it is seen by a few of them.
        for (const geometry::Footpoint& foot : feet)
            if (!foot.on_boundary && std::abs(foot.distance_mm) <= 0.5 * step) out.push_back(foot);
    }
    return out;
}

FoundPose searchPose(std::span<const Vector3> points, const geometry::NominalShape& nominal,
                     const PoseSearchOptions& options) {
    if (points.empty()) return {RigidTransform::Identity(), std::numeric_limits<double>::infinity(), false};
    const std::vector<Vector3> few = sampled(points, first_sample, options.mirrored);
    const std::vector<Vector3> many = sampled(points, last_sample, options.mirrored);
    std::vector<Vector3> surface;
    for (const geometry::Footpoint& foot : sampleNominal(nominal, 300))
        surface.emplace_back(foot.position + options.offset_mm * foot.normal);
    if (surface.empty()) surface.emplace_back(nominal.bounds().center());
    const Spread from = spreadOf(many);
    const Spread to = spreadOf(surface);
    std::vector<RigidTransform> starts = options.candidates;
    for (const auto& [sx, sy] :
         {std::pair(1.0, 1.0), std::pair(-1.0, 1.0), std::pair(1.0, -1.0), std::pair(-1.0, -1.0)})
        starts.push_back(
            poseBetween(from, to, to.axes * Vector3(sx, sy, sx * sy).asDiagonal() * from.axes.transpose()));
    for (const geometry::Matrix3& rotation : uniformRotations(options.rotations))
        starts.push_back(poseBetween(from, to, rotation));
    std::vector<FoundPose> found;
    found.reserve(starts.size());
    for (std::size_t i = 0; i < starts.size(); ++i) found.push_back({starts[i], 0.0, i < options.candidates.size()});
    // Few points and short rounds first: most starts show soon that they lead nowhere.
    constexpr int first_iterations = 5;
    constexpr int next_iterations = 10;
    constexpr int last_iterations = 60;
    carryOn(found, few, nominal, options.offset_mm, first_iterations, second_round);
    carryOn(found, few, nominal, options.offset_mm, next_iterations, finalists);
    carryOn(found, few, nominal, options.offset_mm, last_iterations, winners);
    carryOn(found, many, nominal, options.offset_mm, last_iterations, 1);
    return found.front();
}

}  // namespace cusp::inspect
