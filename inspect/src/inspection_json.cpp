// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The JSON form of an inspection: report.json and `cusp inspect --json`.
#include <cusp/inspect/inspection_report.hpp>

#include <array>
#include <cmath>

namespace cusp::inspect {
namespace {

using base::Json;

Json toJson(const Vector3& v) { return Json::array({v.x(), v.y(), v.z()}); }

Json toJson(const std::array<bool, 6>& freedoms) {
    Json out = Json::array();
    for (const Freedom freedom : all_freedoms)
        if (freedoms[static_cast<std::size_t>(freedom)]) out.push_back(freedomName(freedom));
    return out;
}

Json toJson(const RigidTransform& pose) {
    const Eigen::AngleAxisd turn(pose.linear());
    Json out;
    out["rotation_vector_rad"] = toJson(Vector3(turn.angle() * turn.axis()));
    out["translation_mm"] = toJson(Vector3(pose.translation()));
    return out;
}

Json toJson(const AlignmentSummary& alignment) {
    Json out;
    out["fit"] = fitName(alignment.fit);
    out["rotation_vector_rad"] = toJson(alignment.rotation_vector_rad);
    out["translation_mm"] = toJson(alignment.translation_mm);
    out["measured_from_nominal"] = toJson(alignment.nominal_from_measured.inverse());
    out["termination"] = terminationName(alignment.termination);
    out["iterations"] = alignment.iterations;
    out["coarse_iterations"] = alignment.coarse_iterations;
    out["points"] = alignment.points;
    out["beyond_edge"] = alignment.beyond_edge;
    out["start_rms_mm"] = alignment.start_rms_mm;
    out["rms_mm"] = alignment.rms_mm;
    out["minimax_mm"] = alignment.minimax_mm;
    out["locked"] = toJson(alignment.locked);
    out["condition"] = alignment.condition;
    Json weak = Json::array();
    for (const Freedom freedom : alignment.weak) weak.push_back(freedomName(freedom));
    out["weakly_determined"] = weak;
    out["pivot_mm"] = toJson(alignment.pivot_mm);
    Json deviations = Json::object();
    Json covariance = Json::array();
    for (Eigen::Index i = 0; i < 6; ++i) {
        const bool turn = i >= 3;
        const std::string name(freedomName(all_freedoms[static_cast<std::size_t>(i)]));
        deviations[name + (turn ? "_rad" : "_mm")] = std::sqrt(alignment.covariance(i, i));
        Json row = Json::array();
        for (Eigen::Index j = 0; j < 6; ++j) row.push_back(alignment.covariance(i, j));
        covariance.push_back(row);
    }
    out["standard_deviation"] = deviations;
    out["covariance"] = covariance;
    return out;
}

Json toJson(const DeviationStatistics& s) {
    Json out;
    out["count"] = s.count;
    out["min_mm"] = s.min_mm;
    out["max_mm"] = s.max_mm;
    out["mean_mm"] = s.mean_mm;
    out["rms_mm"] = s.rms_mm;
    out["standard_deviation_mm"] = s.standard_deviation_mm;
    out["median_mm"] = s.median_mm;
    out["mad_mm"] = s.mad_mm;
    out["profile_mm"] = s.profile_mm;
    out["min_point"] = s.min_point;
    out["max_point"] = s.max_point;
    return out;
}

Json toJson(const Decision& decision) {
    Json out;
    out["verdict"] = verdictName(decision.verdict);
    out["reason"] = decision.reason;
    if (decision.verdict == Verdict::NotAsked) return out;
    out["rule"] = ruleName(decision.rule);
    out["lower_limit_mm"] = decision.limits.lower_mm;
    out["upper_limit_mm"] = decision.limits.upper_mm;
    Json uncertainty;
    uncertainty["standard_mm"] = decision.uncertainty.standard_mm;
    uncertainty["stated"] = decision.uncertainty.stated;
    uncertainty["source"] = decision.uncertainty.source;
    out["uncertainty"] = uncertainty;
    out["least_conforming_probability"] = decision.least_conforming_probability;
    out["worst_point"] = decision.worst_point;
    out["points_outside"] = decision.points_outside;
    return out;
}

Json toJson(const Evaluation& evaluation) {
    Json out = toJson(evaluation.statistics);
    out["beyond_edge"] = evaluation.beyond_edge;
    out["outliers"] = evaluation.outliers.size();
    Json histogram;
    histogram["low_mm"] = evaluation.histogram.low_mm;
    histogram["bin_width_mm"] = evaluation.histogram.bin_width_mm;
    histogram["counts"] = evaluation.histogram.counts;
    out["histogram"] = histogram;
    out["decision"] = toJson(evaluation.decision);
    return out;
}

Json toJson(const SectionResult& section) {
    Json out;
    out["label"] = section.label;
    out["axis"] = section.axis ? Json(std::string(1, "XYZ"[*section.axis])) : Json(nullptr);
    out["position_mm"] = section.axis ? Json(section.position_mm) : Json(nullptr);
    out["width_mm"] = section.width_mm;
    out["points"] = section.points.size();
    out["beyond_edge"] = section.beyond_edge;
    out["pieces"] = section.piece_starts.size();
    out["length_mm"] = section.length_mm;
    out["deviation"] = toJson(section.statistics);
    return out;
}

Json fieldsOf(const InspectionReport& report) {
    const auto one = [](const Evaluation& evaluation) {
        return evaluation.field ? evaluation.field->toJson() : Json(nullptr);
    };
    Json out;
    out["datum"] = one(report.datum);
    out["best_fit"] = one(report.best_fit);
    out["reason"] = report.no_field;
    return out;
}

}  // namespace

base::Json toJson(const InspectionReport& report) {
    Json out = base::jsonReport("inspect", 1);
    out["points_file"] = report.points_file;
    out["nominal_file"] = report.nominal_file;
    out["nominal_flipped"] = report.nominal_flipped;
    out["points"] = report.points.size();
    Json measured;
    measured["format"] = report.points.format;
    measured["mm_per_unit"] = report.points.mm_per_unit;
    measured["unit_stated"] = report.points.unit_stated;
    measured["kind"] = report.kind == PointKind::Centre ? "centre" : "surface";
    measured["kind_source"] = report.kind_source;
    measured["probe_radius_mm"] = report.probe_radius_mm;
    out["measured"] = measured;
    out["alignment"] = toJson(report.alignment);
    out["alignment"]["weighted"] = report.weighted;
    out["judged"] = report.judged_in_datum ? "datum" : "best-fit";
    out["deviation"] = toJson(report.judged());
    out["datum_deviation"] = toJson(report.datum);
    out["best_fit_deviation"] = toJson(report.best_fit);
    Json rule;
    rule["factor"] = report.outlier_rule.factor;
    rule["floor_mm"] = report.outlier_rule.floor_mm;
    out["outlier_rule"] = rule;
    Json sections = Json::array();
    for (const SectionResult& section : report.sections) sections.push_back(toJson(section));
    out["sections"] = sections;
    out["planned_step_over_mm"] = report.planned_step_over_mm > 0.0 ? Json(report.planned_step_over_mm) : Json(nullptr);
    out["decision"] = toJson(report.judged().decision);
    out["doubts"] = report.doubts;
    out["deviation_field"] = fieldsOf(report);
    return out;
}

}  // namespace cusp::inspect
