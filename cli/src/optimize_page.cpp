// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Lists as the page wants them: one per quantity, rounded to what a screen can show.
#include "optimize_page.hpp"

#include <cusp/pages/render.hpp>

#include <cmath>
#include <utility>

namespace cusp::cli {

namespace {

using base::Json;

constexpr double per_tenth_micrometre = 1e4;
constexpr double per_nanometre = 1e6;

double rounded(double value, double per_step) { return std::round(value * per_step) / per_step; }

Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json convergenceJson(const optimizer::SearchSummary& search) {
    Json out;
    for (const char* key : {"evaluations", "viral_evaluations", "best", "mean", "worst", "diversity"})
        out[key] = Json::array();
    for (const auto& record : search.history) {
        out["evaluations"].push_back(record.evaluations);
        out["viral_evaluations"].push_back(record.viral_evaluations);
        out["best"].push_back(finite(record.best));
        out["mean"].push_back(finite(record.population_mean));
        out["worst"].push_back(finite(record.population_worst));
        out["diversity"].push_back(record.diversity);
    }
    return out;
}

/// Every candidate judged, and the last population.
Json candidatesJson(const Optimized& done) {
    Json out;
    out["names"] = Json::array();
    for (const auto& gene : done.genes) out["names"].push_back(gene.name);
    out["lower"] = Json::array();
    out["upper"] = Json::array();
    for (const auto& gene : done.genes) {
        out["lower"].push_back(gene.lower);
        out["upper"].push_back(gene.upper);
    }
    out["objectives"] = Json::array();
    for (const auto& entry : done.search.evaluated)
        out["objectives"].push_back(finite(entry.evaluation.objectives.front()));
    out["population"] = Json::array();
    for (const auto& individual : done.search.population) {
        const auto& entry = done.search.evaluated[individual.entry];
        out["population"].push_back(
            {{"values", entry.values}, {"objective", finite(entry.evaluation.objectives.front())}});
    }
    return out;
}

Json frontJson(const Optimized& done) {
    Json out = Json::array();
    for (const auto& point : done.levelled)
        out.push_back({{"tool", done.tool_names[point.tool]},
                       {"passes", point.passes},
                       {"machining_time_s", point.machining_time_s},
                       {"deviation_mm", point.deviation_mm},
                       {"on_front", isOnFront(done, point)}});
    return out;
}

Json deviationsOf(const simulation::SurfaceEnvelope& envelope, const std::vector<std::size_t>& shown) {
    Json out = Json::array();
    for (const std::size_t i : shown) out.push_back(rounded(envelope.points[i].deviation_mm, per_nanometre));
    return out;
}

/// Points that both paths reach.
Json mapJson(const Optimized& done) {
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < done.envelope.points.size(); ++i)
        if (done.envelope.points[i].reached() && (!done.before || done.before->envelope.points[i].reached()))
            shown.push_back(i);
    Json out;
    for (int k = 0; k < 3; ++k) {
        const std::string axis(1, "xyz"[k]);
        Json places = Json::array();
        Json normals = Json::array();
        for (const std::size_t i : shown) {
            places.push_back(rounded(done.envelope.grid.points[i].position[k], per_tenth_micrometre));
            normals.push_back(rounded(done.envelope.grid.points[i].normal[k], per_tenth_micrometre));
        }
        out[axis + "_mm"] = std::move(places);
        out["normal_" + axis] = std::move(normals);
    }
    out["deviation_mm"] = deviationsOf(done.envelope, shown);
    if (done.before) out["before_deviation_mm"] = deviationsOf(done.before->envelope, shown);
    return out;
}

/// Contacts of the best, on the surface.
Json pathJson(const Optimized& done) {
    Json out{{"position_mm", Json::array()}, {"pass", Json::array()}};
    for (const auto& contact : done.contacts) {
        for (int k = 0; k < 3; ++k) out["position_mm"].push_back(rounded(contact.position[k], per_tenth_micrometre));
        out["pass"].push_back(contact.pass);
    }
    return out;
}

Json beforeJson(const Before& before) {
    return {{"name", before.name},
            {"tool", before.tool},
            {"passes", before.passes},
            {"cc_points", before.points},
            {"machining_time_s", before.machining_time_s ? Json(*before.machining_time_s) : Json()},
            {"overcut_max_mm", before.left.overcut_max_mm},
            {"undercut_max_mm", before.left.undercut_max_mm},
            {"within_tolerance_percent", before.left.within_tolerance_percent}};
}

}  // namespace

base::Result<std::string> optimizePage(const Json& summary, const Optimized& done) {
    Json out = summary;
    out["passes"] = done.contacts.empty() ? 0 : done.contacts.back().pass + 1;
    out["tools"] = done.tool_names;
    out["before"] = done.before ? beforeJson(*done.before) : Json();
    out["convergence"] = convergenceJson(done.search);
    out["candidates"] = candidatesJson(done);
    out["front"] = frontJson(done);
    out["map"] = mapJson(done);
    out["path"] = pathJson(done);
    const auto text = base::jsonText(out);
    if (!text) return base::fail(text.error());
    return pages::renderPage("optimization", *text);
}

}  // namespace cusp::cli
