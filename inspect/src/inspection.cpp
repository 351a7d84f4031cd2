// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The order of an inspection: what the points are, where they lie, how far off they are, and whether that can be trusted.
#include <cusp/inspect/inspection.hpp>

#include "evaluation_field.hpp"
#include "plausibility.hpp"

#include <cusp/inspect/pose_search.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <functional>
#include <limits>
#include <numbers>

namespace cusp::inspect {
namespace {

constexpr double most_outliers = 0.05;

AlignmentOptions alignmentOptions(const InspectionOptions& options, double offset_mm) {
    AlignmentOptions out;
    out.fit = options.fit;
    out.locked = options.locked;
    out.loss = options.loss;
    out.loss_scale_mm = options.loss_scale_mm;
    out.start = options.start;
    out.offset_mm = offset_mm;
    return out;
}

/// The deviations that count, with the measured points they belong to.
struct Counted {
    std::vector<double> values;
    std::vector<Vector3> positions;
    std::vector<std::uint32_t> points;
};

Counted countedOf(const std::vector<PointDeviation>& deviations, double edge_tolerance_mm) {
    Counted out;
    for (std::size_t i = 0; i < deviations.size(); ++i) {
        if (deviations[i].beyond_edge_mm > edge_tolerance_mm) continue;
        out.values.push_back(deviations[i].deviation_mm);
        out.positions.push_back(deviations[i].nominal);
        out.points.push_back(static_cast<std::uint32_t>(i));
    }
    return out;
}

/// Without the outliers, which say nothing of how well a point is measured.
Counted within(const Counted& counted, double median_mm, double limit_mm) {
    Counted out;
    for (std::size_t k = 0; k < counted.values.size(); ++k) {
        if (std::abs(counted.values[k] - median_mm) > limit_mm) continue;
        out.values.push_back(counted.values[k]);
        out.positions.push_back(counted.positions[k]);
    }
    return out;
}

Uncertainty uncertaintyOf(const Counted& counted, const InspectionOptions& options, std::size_t free_freedoms) {
    if (options.uncertainty_mm) return {*options.uncertainty_mm, true, "stated"};
    Uncertainty out = uncertaintyFromNeighbours(counted.positions, counted.values);
    const double point = out.standard_mm;
    // A form error of full width F, equally likely everywhere within it.
    const double form = options.probe_form_error_mm / std::sqrt(12.0);
    const double pose = point * std::sqrt(static_cast<double>(free_freedoms) /
                                          static_cast<double>(std::max<std::size_t>(counted.values.size(), 1)));
    out.standard_mm = std::sqrt(point * point + form * form + pose * pose);
    return out;
}

class Inspector {
public:
    Inspector(const geometry::NominalShape& nominal, const InspectionOptions& options, base::Diagnostics& report)
        : nominal_(nominal), options_(options), report_(report) {}

    base::Result<InspectionReport> run(MeasuredPoints points) {
        if (auto problem = checkWeights(points)) return base::fail(*std::move(problem));
        if (auto problem = checkUnit(points, nominal_)) return base::fail(*std::move(problem));
        if (auto problem = checkCount(points)) return base::fail(*std::move(problem));
        const auto probe = decideProbe(points, nominal_, options_, report_);
        if (!probe) return base::fail(probe.error());
        if (auto problem = checkPlane(points, nominal_, options_)) return base::fail(*std::move(problem));
        AlignmentOptions fit = alignmentOptions(options_, probe->radius_mm);
        if (options_.use_weights) fit.weights = points.weights;
        auto alignment = align(points.positions, nominal_, fit);
        if (!alignment) return base::fail(explained(alignment.error(), points, probe->radius_mm));
        out_.points = std::move(points);
        out_.points_file = out_.points.source;
        out_.kind = probe->kind;
        out_.kind_source = probe->source;
        out_.probe_radius_mm = probe->radius_mm;
        out_.alignment = *std::move(alignment);
        out_.weighted = options_.use_weights;
        out_.planned_step_over_mm = options_.planned_step_over_mm;
        out_.judged_in_datum = options_.judge_in_datum;
        out_.outlier_rule = options_.outlier_rule;
        out_.edge_tolerance_mm = options_.edge_tolerance_mm;
        evaluate(out_.datum, options_.start, 0);
        if (options_.fit == FitKind::None)
            out_.best_fit = out_.datum;
        else
            evaluate(out_.best_fit, out_.alignment.nominal_from_measured,
                     static_cast<std::size_t>(std::count(options_.locked.begin(), options_.locked.end(), false)));
        cut();
        sayWeakFreedoms();
        doubt();
        addDeviationFields(out_, options_);
        return std::move(out_);
    }

private:
    std::optional<base::Diagnostics> checkWeights(const MeasuredPoints& points) {
        base::Location where;
        where.file = points.source;
        if (!options_.use_weights && !points.weights.empty())
            report_.note("inspect.weights-unused", "the points have weights, which do not count without --weights",
                         where);
        if (!options_.use_weights || !points.weights.empty()) return std::nullopt;
        base::Diagnostics out;
        out.error("inspect.weights", "the points have no weights; --weights needs a column \"weight\" in a table",
                  where);
        return out;
    }

    /// Before anything is fitted to find out what the points are.
    std::optional<base::Diagnostics> checkCount(const MeasuredPoints& points) const {
        const auto free = static_cast<std::size_t>(std::count(options_.locked.begin(), options_.locked.end(), false));
        if (options_.fit == FitKind::None || points.size() >= free) return std::nullopt;
        base::Location where;
        where.file = points.source;
        base::Diagnostics out;
        out.error("align.too-few-points",
                  fmt::format("{} point{} cannot determine {} free freedoms", points.size(),
                              points.size() == 1 ? "" : "s", free),
                  where);
        return out;
    }

    /// The problems of a fit with the file they are of; why nothing overlaps is looked into.
    base::Diagnostics explained(const base::Diagnostics& problems, const MeasuredPoints& points,
                                double offset_mm) const {
        base::Diagnostics out;
        for (base::Diagnostic item : problems) {
            item.where.file = points.source;
            if (item.code == "align.no-overlap")
                item.message += "; " + explainPoorFit(points, nominal_, options_, offset_mm).cause;
            out.add(std::move(item));
        }
        return out;
    }

    void evaluate(Evaluation& evaluation, const RigidTransform& pose, std::size_t free_freedoms) {
        evaluation.nominal_from_measured = pose;
        evaluation.deviations = deviationsOf(out_.points.positions, pose, nominal_, out_.probe_radius_mm);
        const Counted counted = countedOf(evaluation.deviations, options_.edge_tolerance_mm);
        evaluation.beyond_edge = evaluation.deviations.size() - counted.values.size();
        evaluation.statistics = statisticsOf(counted.values);
        evaluation.histogram = histogramOf(counted.values);
        if (counted.values.empty()) return;
        const double limit_mm = outlierDistance(evaluation.statistics, options_.outlier_rule);
        for (std::size_t k = 0; k < counted.values.size(); ++k)
            if (std::abs(counted.values[k] - evaluation.statistics.median_mm) > limit_mm)
                evaluation.outliers.push_back(counted.points[k]);
        evaluation.statistics.min_point = counted.points[evaluation.statistics.min_point];
        evaluation.statistics.max_point = counted.points[evaluation.statistics.max_point];
        if (!options_.limits) return;
        evaluation.decision =
            decide(counted.values, *options_.limits,
                   uncertaintyOf(within(counted, evaluation.statistics.median_mm, limit_mm), options_, free_freedoms),
                   options_.rule);
        evaluation.decision.worst_point = counted.points[evaluation.decision.worst_point];
    }

    void cut() {
        const auto& deviations = out_.judged().deviations;
        out_.sections =
            options_.sections
                ? cutSections(*options_.sections, out_.points, deviations, nominal_, options_.edge_tolerance_mm)
                : measuredSections(out_.points, deviations, nominal_, options_.edge_tolerance_mm);
        for (const SectionResult& section : out_.sections)
            if (section.points.empty())
                warn("inspect.empty-section", fmt::format("section {}: no point lies there", section.label));
    }

    void sayWeakFreedoms() {
        if (out_.alignment.weak.empty()) return;
        std::vector<std::string_view> names;
        std::transform(out_.alignment.weak.begin(), out_.alignment.weak.end(), std::back_inserter(names), freedomName);
        base::Location where;
        where.file = out_.points.source;
        report_.note(
            "inspect.weak-freedoms",
            fmt::format("weakly determined by these points: {}; the deviations along the normal are not affected",
                        fmt::join(names, ", ")),
            where);
    }

    /// What makes the result doubtful is said, and the decision withheld.
    void doubt() {
        const Evaluation& judged = out_.judged();
        if (judged.statistics.count == 0)
            return withhold("inspect.beyond-edge", "no point lies on the nominal: all are beyond its edges");
        const auto free = static_cast<std::size_t>(std::count(options_.locked.begin(), options_.locked.end(), false));
        if (options_.fit != FitKind::None && judged.statistics.count < 3 * free)
            withhold("inspect.few-points",
                     fmt::format("{} points for a fit of {} freedoms: the fit follows the points; measure at least {}",
                                 judged.statistics.count, free, 3 * free));
        if (fitsPoorly(judged)) {
            const Doubt why = explainPoorFit(out_.points, nominal_, options_, out_.probe_radius_mm);
            return withhold(why.code,
                            fmt::format("the points do not fit the nominal (rms {:.3g} mm, {} of {} beyond its "
                                        "edges): {}",
                                        judged.statistics.rms_mm, judged.beyond_edge, judged.deviations.size(),
                                        why.cause));
        }
        if (const double elsewhere_mm = betterElsewhere(); elsewhere_mm < out_.alignment.rms_mm)
            return withhold(
                "inspect.poor-fit",
                fmt::format("the points fit better in another pose (rms {:.3g} mm instead of {:.3g} mm): the start "
                            "is too far off; --start scan finds one",
                            elsewhere_mm, out_.alignment.rms_mm));
        if (judged.beyond_edge > 0)
            warn("inspect.beyond-edge",
                 fmt::format("{} of {} points lie more than {} mm beyond an edge of the nominal and do "
                             "not count",
                             judged.beyond_edge, judged.deviations.size(), options_.edge_tolerance_mm));
        doubtOutliers(judged);
    }

    /// The rms of a pose found from no start, where the fit came from so far that it may have ended in a wrong one.
    double betterElsewhere() const {
        constexpr double none = std::numeric_limits<double>::infinity();
        const bool all_free = std::none_of(options_.locked.begin(), options_.locked.end(), std::identity());
        if (options_.fit == FitKind::None || !all_free) return none;
        const double size_mm = nominal_.bounds().diagonal().norm();
        const RigidTransform moved = out_.alignment.nominal_from_measured * options_.start.inverse();
        const Vector3 pivot = out_.alignment.pivot_mm;
        constexpr double far_rad = 0.35;  // from there on, fits from a given start may end elsewhere
        const bool far =
            Eigen::AngleAxisd(moved.linear()).angle() > far_rad || (moved * pivot - pivot).norm() > size_mm;
        if (!far && out_.alignment.termination != Termination::Stalled) return none;
        PoseSearchOptions search;
        search.offset_mm = out_.probe_radius_mm;
        const double found_mm = searchPose(out_.points.positions, nominal_, search).rms_mm;
        constexpr double clearly = 0.5;
        return found_mm < clearly * out_.alignment.rms_mm ? found_mm : none;
    }

    /// By the spread of the middle half where outliers were to be left aside, by all points otherwise.
    bool fitsPoorly(const Evaluation& judged) const {
        constexpr std::size_t one_in = 10;
        const double spread_mm =
            options_.loss == Loss::Squared ? judged.statistics.rms_mm : 1.4826 * judged.statistics.mad_mm;
        return spread_mm > poorFitLimit(nominal_) || one_in * judged.beyond_edge > judged.deviations.size();
    }

    void doubtOutliers(const Evaluation& judged) {
        if (judged.outliers.empty()) return;
        const double limit_mm = outlierDistance(judged.statistics, options_.outlier_rule);
        const double share = static_cast<double>(judged.outliers.size()) / static_cast<double>(judged.statistics.count);
        if (share > most_outliers && options_.loss == Loss::Squared)
            return withhold(
                "inspect.many-outliers",
                fmt::format("{:.0f} % of the points are outliers (farther than {:.3g} mm from the median): they "
                            "pull the fit; look at them, or fit with --loss tukey",
                            100.0 * share, limit_mm));
        warn("inspect.outliers",
             fmt::format("{} of {} points are outliers (farther than {:.3g} mm from the median); they count",
                         judged.outliers.size(), judged.statistics.count, limit_mm));
    }

    void withhold(std::string_view code, const std::string& message) {
        warn(code, message);
        out_.doubts.push_back(message);
        for (Evaluation* evaluation : {&out_.datum, &out_.best_fit}) {
            if (!options_.limits) continue;
            evaluation->decision.verdict = Verdict::Undecided;
            evaluation->decision.reason = "withheld: " + message;
        }
    }

    void warn(std::string_view code, const std::string& message) {
        base::Location where;
        where.file = out_.points.source;
        report_.warning(code, message, where);
    }

    const geometry::NominalShape& nominal_;
    const InspectionOptions& options_;
    base::Diagnostics& report_;
    InspectionReport out_;
};

}  // namespace

base::Result<InspectionReport> inspectPoints(MeasuredPoints points, const geometry::NominalShape& nominal,
                                             const InspectionOptions& options, base::Diagnostics& report) {
    return Inspector(nominal, options, report).run(std::move(points));
}

}  // namespace cusp::inspect
