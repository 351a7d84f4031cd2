// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The demo's summary, and the document of its page.
#include "calibration_output.hpp"
#include "demo_chain.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cusp::cli {

namespace {

base::Json partJson(const loop::MeasuredPart& part, const char* folder) {
    return {{"max_abs_deviation_mm", part.maxAbsInDatum()},
            {"rms_deviation_mm", part.report.datum.statistics.rms_mm},
            {"best_fit_max_abs_deviation_mm", part.maxAbsBestFit()},
            {"true_max_abs_deviation_mm", part.true_max_abs_mm},
            {"report", std::string(folder) + "/report.html"}};
}

using Values = std::vector<double>;

Values deviationsAt(const inspect::Evaluation& evaluation, const std::vector<std::uint32_t>& points) {
    Values out;
    for (const std::uint32_t i : points)
        if (i < evaluation.deviations.size()) out.push_back(evaluation.deviations[i].deviation_mm);
    return out;
}

double largest(const Values& values) {
    double out = 0.0;
    for (const double value : values) out = std::max(out, std::abs(value));
    return out;
}

/// Every part has the same targets, so that the order along the section of the first part is that of all.
base::Json sectionJson(const Demo& demo, const inspect::SectionResult& section, bool curves) {
    const Values before = deviationsAt(demo.first.part.report.datum, section.points);
    const Values uncorrected = deviationsAt(demo.uncorrected.report.datum, section.points);
    const Values after = deviationsAt(demo.second.part.report.datum, section.points);
    const Values before_fit = deviationsAt(demo.first.part.report.best_fit, section.points);
    const Values after_fit = deviationsAt(demo.second.part.report.best_fit, section.points);
    base::Json out{{"label", section.label},
                   {"points", section.points.size()},
                   {"before_mm", largest(before)},
                   {"uncorrected_mm", largest(uncorrected)},
                   {"after_mm", largest(after)},
                   {"before_best_fit_mm", largest(before_fit)},
                   {"after_best_fit_mm", largest(after_fit)}};
    if (curves)
        out["curves"] = {{"arc_length_mm", section.arc_length_mm},
                         {"datum", {{"before_mm", before}, {"uncorrected_mm", uncorrected}, {"after_mm", after}}},
                         {"best_fit", {{"before_mm", before_fit}, {"after_mm", after_fit}}}};
    return out;
}

base::Json remainsJson(const Demo& demo) {
    const loop::CmmOptions probe;
    base::Json out = base::Json::array();
    out.push_back({{"what", "path: scallops and chords"}, {"mm", demo.path_remains_mm}});
    out.push_back({{"what", "control: smoothing, digits of the program"}, {"mm", demo.control_mm}});
    out.push_back({{"what", "measuring: noise (2\u03c3), form, drift"},
                   {"mm", 2.0 * probe.noise_mm + 0.5 * probe.form_mm + probe.drift_mm}});
    if (const auto& field = demo.first.part.report.datum.field)
        out.push_back({{"what", "field: what it leaves, rms"}, {"mm", field->data().residual_mm}});
    return out;
}

base::Json linkJson(const loop::DeliveryRecord& delivery) {
    return {{"address", delivery.link},
            {"bytes", delivery.bytes},
            {"seconds", delivery.seconds},
            {"chunks", delivery.chunks},
            {"chunks_repeated", delivery.chunks_repeated},
            {"compared", delivery.compared}};
}

}  // namespace

base::Json demoJson(const Demo& demo, double seconds, bool curves) {
    base::Json out = base::jsonReport("demo", 1);
    out["machine"] = demo.machine->file.machine.name;
    out["seed"] = demo.options.seed;
    out["limit_mm"] = demo.options.limit_mm;
    out["plan"] = {{"passes", demo.plan.passes},
                   {"judged", demo.plan.judged},
                   {"budget_mm", demo.options.budget_mm},
                   {"overcut_mm", demo.plan.overcut_mm},
                   {"undercut_mm", demo.plan.undercut_mm}};
    out["before"] = partJson(demo.first.part, "before");
    out["uncorrected"] = partJson(demo.uncorrected, "uncorrected");
    out["after"] = partJson(demo.second.part, "after");
    out["calibrated"] = demo.calibrated ? partJson(*demo.calibrated, "calibrated") : base::Json();
    out["sections"] = base::Json::array();
    for (const inspect::SectionResult& section : demo.first.part.report.sections)
        out["sections"].push_back(sectionJson(demo, section, curves));
    out["hidden"] = base::Json::array();
    for (const auto& [name, value] : demo.first.hidden) out["hidden"].push_back({{"name", name}, {"value", value}});
    const auto& moved = demo.second.corrected.summary;
    const auto& field = demo.first.part.report.datum.field;
    out["compensation"] = {{"moved", moved.moved},
                           {"locations", moved.locations},
                           {"clamped", moved.clamped},
                           {"max_shift_mm", moved.max_shift_mm},
                           {"gouge_mm", demo.second.check.gouge_mm},
                           {"shortest_wave_mm", field ? field->data().shortest_wave_mm : 0.0}};
    out["remains"] = remainsJson(demo);
    out["calibration"] =
        demo.calibration ? calibrationJson("", demo.machine->file.machine, *demo.calibration) : base::Json();
    out["link"] = linkJson(demo.run.delivery);
    out["blocks"] = demo.program.blocks;
    out["run_s"] = demo.run.run_s;
    out["seconds"] = seconds;
    return out;
}

}  // namespace cusp::cli
