// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The order of a fit: a sample first, then all points, then minimax; and what is said when it is not determined.
#include <cusp/inspect/alignment.hpp>

#include "alignment/minimax.hpp"
#include "alignment/rotation.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <optional>

namespace cusp::inspect {
namespace {

constexpr std::size_t sample_points = 2000;

std::size_t freeCount(const std::array<bool, 6>& locked) {
    return static_cast<std::size_t>(std::count(locked.begin(), locked.end(), false));
}

std::string namesOf(const std::vector<Freedom>& freedoms, std::string_view between) {
    std::vector<std::string_view> names;
    std::transform(freedoms.begin(), freedoms.end(), std::back_inserter(names), freedomName);
    return fmt::format("{}", fmt::join(names, between));
}

std::string numberWord(std::size_t n, std::string_view thing) {
    return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

/// The pivot of rotations. Where translations are locked while rotations are free, turning about another point would be
/// another fit: then it is the origin of the nominal. Otherwise the points' centre, about which the equations are best
/// conditioned.
Vector3 pivotOf(const std::vector<Vector3>& points, const std::array<bool, 6>& locked) {
    const bool translation_locked = locked[0] || locked[1] || locked[2];
    const bool rotation_free = !(locked[3] && locked[4] && locked[5]);
    if (translation_locked && rotation_free) return Vector3::Zero();
    // Differences to the first point, so that far off the origin no digits are lost in the sum.
    Vector3 sum = Vector3::Zero();
    for (const Vector3& point : points) sum += point - points.front();
    return points.front() + sum / static_cast<double>(points.size());
}

double radiusOfGyration(const std::vector<Vector3>& points, const Vector3& pivot) {
    double sum = 0.0;
    for (const Vector3& point : points) sum += (point - pivot).squaredNorm();
    return std::sqrt(sum / static_cast<double>(points.size()));
}

template <class Value>
std::vector<Value> sampled(const std::vector<Value>& values) {
    if (values.size() <= sample_points) return values;
    std::vector<Value> out;
    out.reserve(sample_points);
    for (std::size_t i = 0; i < sample_points; ++i) out.push_back(values[i * values.size() / sample_points]);
    return out;
}

class Aligner {
public:
    Aligner(std::vector<Vector3> points, const geometry::NominalShape& nominal, const AlignmentOptions& options)
        : points_(std::move(points)), nominal_(nominal), options_(options) {
        model_.pivot = pivotOf(points_, options.locked);
        const double radius = radiusOfGyration(points_, model_.pivot);
        model_.length_mm = radius > 0.0 ? radius : 1.0;
    }

    base::Result<AlignmentSummary> run() {
        summary_.fit = options_.fit;
        summary_.locked = options_.locked;
        summary_.pivot_mm = model_.pivot;
        const bool fits = options_.fit != FitKind::None && freeCount(options_.locked) > 0;
        const Vector6 start = fits ? coarse() : Vector6::Zero();
        ResidualField field(points_, options_.weights, nominal_, model_, options_.offset_mm);
        tolerance_mm_ = 8.0 * std::numeric_limits<double>::epsilon() * field.magnitude();
        takeStart();
        field.moveTo(start);
        field.useEdgeRule(EdgeRule::Normal);
        field.chooseParticipants(options_.edge_tolerance_mm);
        if (fits)
            if (auto problem = solve(field)) return base::fail(*std::move(problem));
        finish(field);
        return summary_;
    }

private:
    using Problem = std::optional<base::Diagnostics>;

    static Problem problem(std::string_view code, std::string message) {
        base::Diagnostics out;
        out.error(code, std::move(message));
        return out;
    }

    /// From afar, with a sample of the points and distances to the edges.
    Vector6 coarse() {
        ResidualField field(sampled(points_), sampled(options_.weights), nominal_, model_, options_.offset_mm);
        const double good_enough_mm = 1e-5 * model_.length_mm;
        const SolveOutcome out = solveLeastSquares(field, options_.locked, options_.max_iterations, good_enough_mm);
        summary_.coarse_iterations = out.iterations;
        return field.parameters();
    }

    /// With the sample: far from the nominal every footpoint is a search.
    void takeStart() {
        ResidualField field(sampled(points_), sampled(options_.weights), nominal_, model_, options_.offset_mm);
        field.moveTo(Vector6::Zero());
        field.useEdgeRule(EdgeRule::Normal);
        field.chooseParticipants(options_.edge_tolerance_mm);
        const NormalEquations equations = field.normalEquations();
        summary_.start_rms_mm =
            equations.weight_sum > 0.0 ? std::sqrt(equations.square_sum / equations.weight_sum) : 0.0;
    }

    Problem solve(ResidualField& field) {
        field.chooseParticipants(options_.edge_tolerance_mm);
        SolveOutcome outcome;
        constexpr int most_rounds = 20;
        for (int round = 0; round < most_rounds; ++round) {
            if (auto found = checkParticipants(field.normalEquations())) return found;
            const bool same_loss = updateLoss(field);
            outcome = solveLeastSquares(field, options_.locked, options_.max_iterations, tolerance_mm_);
            summary_.iterations += outcome.iterations;
            summary_.termination = outcome.termination;
            // A point on the very edge may leave and come back for ever; after a few rounds what has left stays out.
            constexpr int free_rounds = 3;
            const bool same_points = !field.chooseParticipants(options_.edge_tolerance_mm, round >= free_rounds);
            const bool hopeless = outcome.termination == Termination::Stalled && round >= free_rounds;
            if ((same_points && same_loss) || hopeless) break;
        }
        if (outcome.termination == Termination::MaxIterations) return notConverged();
        if (auto found = checkDetermination(field.normalEquations())) return found;
        if (options_.fit == FitKind::Minimax) return solveLargest(field);
        return std::nullopt;
    }

    Problem solveLargest(ResidualField& field) {
        const SolveOutcome outcome = solveMinimax(field, options_.locked, options_.max_iterations);
        summary_.iterations += outcome.iterations;
        summary_.termination = outcome.termination;
        if (outcome.termination == Termination::MaxIterations) return notConverged();
        return std::nullopt;
    }

    /// The scale of the loss from the residuals as they are now; true when it is settled.
    bool updateLoss(ResidualField& field) {
        if (options_.loss == Loss::Squared) return true;
        double scale_mm = options_.loss_scale_mm;
        if (scale_mm <= 0.0) {
            constexpr std::array<double, 4> efficient{1.0, 1.345, 2.385, 4.685};  // 95 % for normal residuals
            scale_mm = efficient.at(static_cast<std::size_t>(options_.loss)) * field.robustSpread();
        }
        scale_mm = std::max(scale_mm, 1e3 * tolerance_mm_);
        const bool settled = std::abs(scale_mm - loss_scale_mm_) <= 1e-3 * scale_mm;
        if (!settled) field.useLoss(options_.loss, loss_scale_mm_ = scale_mm);
        return settled;
    }

    Problem checkParticipants(const NormalEquations& equations) const {
        const std::size_t free = freeCount(options_.locked);
        if (equations.points == 0)
            return problem(
                "align.no-overlap",
                fmt::format("all {} points lie beyond the edges of the nominal: wrong nominal, wrong unit, or a "
                            "start too far off",
                            points_.size()));
        if (equations.points >= free) return std::nullopt;
        return problem("align.too-few-points",
                       fmt::format("{} on the nominal cannot determine {}", numberWord(equations.points, "point"),
                                   numberWord(free, "free freedom")));
    }

    Problem checkDetermination(const NormalEquations& equations) const {
        const Determination found = determinationOf(equations.H, options_.locked);
        if (found.undetermined.empty()) return std::nullopt;
        return problem(
            "align.not-determined",
            fmt::format("the fit is not determined: the points leave {} free ({}); measure where the surface "
                        "faces other ways, or lock them: --lock {}",
                        numberWord(found.undetermined.size(), "freedom"), namesOf(found.undetermined, ", "),
                        namesOf(found.undetermined, ",")));
    }

    Problem notConverged() const {
        return problem("align.not-converged",
                       fmt::format("the fit did not converge in {} iterations", options_.max_iterations));
    }

    void finish(const ResidualField& field) {
        const NormalEquations equations = field.normalEquations();
        summary_.points = equations.points;
        summary_.beyond_edge = points_.size() - equations.points;
        summary_.rms_mm = equations.weight_sum > 0.0 ? std::sqrt(equations.square_sum / equations.weight_sum) : 0.0;
        summary_.minimax_mm = equations.largest;
        summary_.nominal_from_measured = model_.motion(field.parameters()) * options_.start;
        summary_.rotation_vector_rad = vectorFromRotation(summary_.nominal_from_measured.linear());
        summary_.translation_mm = summary_.nominal_from_measured.translation();
        if (summary_.termination == Termination::NotAsked) return;
        const Determination found = determinationOf(equations.H, options_.locked);
        summary_.condition = found.condition;
        summary_.weak = found.weak;
        const std::size_t free = freeCount(options_.locked);
        if (equations.points <= free) return;
        const double variance = equations.square_sum / static_cast<double>(equations.points - free);
        Matrix6 unit = Matrix6::Identity();
        unit.diagonal().tail<3>().setConstant(1.0 / model_.length_mm);
        summary_.covariance = variance * unit * found.inverse * unit;
    }

    std::vector<Vector3> points_;
    const geometry::NominalShape& nominal_;
    const AlignmentOptions& options_;
    PoseModel model_;
    double tolerance_mm_ = 0.0;
    double loss_scale_mm_ = -1.0;
    AlignmentSummary summary_;
};

}  // namespace

base::Result<AlignmentSummary> align(std::span<const Vector3> points, const geometry::NominalShape& nominal,
                                     const AlignmentOptions& options) {
    if (!options.weights.empty()) {
        const bool sound = options.weights.size() == points.size() &&
                           std::all_of(options.weights.begin(), options.weights.end(),
                                       [](double w) { return w >= 0.0 && std::isfinite(w); });
        if (!sound) return base::fail("align.weights", "weights are one number per point, none negative");
    }
    if (points.empty()) return base::fail("align.too-few-points", "there are no points");
    std::vector<Vector3> started(points.size());
    std::transform(points.begin(), points.end(), started.begin(), [&](const Vector3& p) { return options.start * p; });
    return Aligner(std::move(started), nominal, options).run();
}

}  // namespace cusp::inspect
