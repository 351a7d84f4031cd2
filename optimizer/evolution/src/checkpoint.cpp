// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Checkpoints of searches on chromosomes; strings of bits as text.
#include "checkpoint.hpp"

#include "run_file.hpp"

#include <stdexcept>

namespace cusp::optimizer {
namespace {

using base::Json;

std::string bitsText(const Bits& bits) {
    std::string out;
    for (const std::uint8_t bit : bits) out += bit != 0 ? '1' : '0';
    return out;
}
Bits bitsOf(const std::string& text) {
    Bits out;
    for (const char c : text) out.push_back(c == '1' ? 1 : 0);
    return out;
}

Json recordJson(const GenerationRecord& r) {
    return {r.generation,
            r.evaluations,
            r.viral_evaluations,
            r.repeats,
            numberJson(r.best),
            numberJson(r.population_best),
            numberJson(r.population_mean),
            numberJson(r.population_worst),
            r.diversity,
            r.infections,
            r.improvements,
            r.restarted};
}
GenerationRecord recordOf(const Json& j) {
    return {.generation = j.at(0),
            .evaluations = j.at(1),
            .viral_evaluations = j.at(2),
            .repeats = j.at(3),
            .best = numberOf(j.at(4)),
            .population_best = numberOf(j.at(5)),
            .population_mean = numberOf(j.at(6)),
            .population_worst = numberOf(j.at(7)),
            .diversity = j.at(8),
            .infections = j.at(9),
            .improvements = j.at(10),
            .restarted = j.at(11)};
}

Json toJson(const Checkpoint& checkpoint) {
    Json out;
    out["charged"] = checkpoint.charged;
    out["repeats"] = checkpoint.repeats;
    out["viral_evaluations"] = checkpoint.state.viral_evaluations;
    Json& population = out["population"] = Json::array();
    for (const Individual& i : checkpoint.state.population) population.push_back({bitsText(i.bits), i.entry});
    Json& viruses = out["viruses"] = Json::array();
    for (const Virus& v : checkpoint.state.viruses)
        viruses.push_back({v.locus, bitsText(v.bits), v.infection_rate, v.force});
    Json& history = out["history"] = Json::array();
    for (const GenerationRecord& record : checkpoint.state.history) history.push_back(recordJson(record));
    out["entries"] = entriesJson(checkpoint.entries);
    return out;
}

/// Throws (nlohmann's exceptions, std::out_of_range) where the document is not one of ours.
Checkpoint fromJson(const Json& json, const Encoding& encoding) {
    Checkpoint out;
    out.charged = json.at("charged");
    out.repeats = json.at("repeats");
    out.state.viral_evaluations = json.at("viral_evaluations");
    out.entries = entriesOf(json.at("entries"), encoding.genes().size(), 1,
                            [&](const CandidateKey& key) { return encoding.values(key); });
    if (out.charged > out.entries.size()) throw std::out_of_range("number of entries charged");
    for (const Json& i : json.at("population")) {
        Individual individual{bitsOf(i.at(0)), i.at(1)};
        if (individual.entry >= out.charged || individual.bits.size() != encoding.length())
            throw std::out_of_range("an individual");
        out.state.population.push_back(std::move(individual));
    }
    for (const Json& v : json.at("viruses")) {
        Virus virus{.locus = v.at(0), .bits = bitsOf(v.at(1)), .infection_rate = v.at(2), .force = v.at(3)};
        if (virus.bits.empty() || virus.bits.size() > encoding.length() ||
            virus.locus > encoding.length() - virus.bits.size())
            throw std::out_of_range("a virus");
        out.state.viruses.push_back(std::move(virus));
    }
    for (const Json& r : json.at("history")) out.state.history.push_back(recordOf(r));
    if (out.state.history.empty() || out.state.population.empty()) throw std::out_of_range("no generation");
    return out;
}

}  // namespace

Json fingerprint(const Encoding& encoding, const SearchOptions& o) {
    Json out;
    out["problem"] = o.problem_id;
    Json& genes = out["genes"] = Json::array();
    for (const Gene& g : encoding.genes()) genes.push_back({g.name, g.bits, g.lower, g.upper, g.choices});
    out["coding"] = static_cast<int>(encoding.coding());
    out["algorithm"] = static_cast<int>(o.algorithm);
    out["seed"] = o.seed;
    out["population"] = o.population;
    out["elite"] = o.elite;
    out["selection"] = {static_cast<int>(o.selection), o.tournament_size, static_cast<int>(o.fitness_scale)};
    out["crossover"] = {static_cast<int>(o.crossover), o.crossover_probability};
    out["mutation"] = {static_cast<int>(o.mutation), o.mutation_probability};
    out["restart_diversity"] = o.restart_diversity;
    Json& starts = out["starts"] = Json::array();
    for (const Values& start : o.starts) starts.push_back(start);
    out["acceptance"] = static_cast<int>(o.acceptance);
    const VirusOptions& v = o.virus;
    out["virus"] = {
        v.population,         v.shortest,           v.longest,         v.infectivity_force, v.infection_rate,
        v.min_infection_rate, v.max_infection_rate, v.rate_adaptation, v.elite_share,       v.interval};
    return out;
}

base::Result<void> writeCheckpoint(const std::string& path, const Json& fingerprint, const Checkpoint& checkpoint) {
    return writeRun(path, fingerprint, toJson(checkpoint));
}

base::Result<std::optional<Checkpoint>> readCheckpoint(const std::string& path, const Json& fingerprint,
                                                       const Encoding& encoding) {
    std::optional<Checkpoint> out;
    const auto read = readRun(path, fingerprint, [&](const Json& run) { out = fromJson(run, encoding); });
    if (!read) return tl::unexpected(read.error());
    return out;
}

}  // namespace cusp::optimizer
