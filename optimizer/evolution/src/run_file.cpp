// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Checkpoints as JSON: doubles in the shortest form that reads back exactly.
#include "run_file.hpp"

#include <cusp/base/atomic_file.hpp>

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <stdexcept>

namespace cusp::optimizer {

using base::Json;

namespace {

constexpr int schema = 1;
constexpr std::size_t largest_file_bytes = std::size_t{1} << 30U;

std::string firstDifference(const Json& mine, const Json& other) {
    for (const auto& [key, value] : mine.items())
        if (!other.contains(key) || other[key] != value) return key;
    return {};
}

}  // namespace

Json numberJson(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
double numberOf(const Json& json) {
    return json.is_null() ? std::numeric_limits<double>::infinity() : json.get<double>();
}

Json numbersJson(const std::vector<double>& values) {
    Json out = Json::array();
    for (const double value : values) out.push_back(numberJson(value));
    return out;
}
std::vector<double> numbersOf(const Json& json) {
    std::vector<double> out;
    for (const Json& value : json) out.push_back(numberOf(value));
    return out;
}

Json entriesJson(const std::vector<Ledger::Entry>& entries) {
    Json out = Json::array();
    for (const Ledger::Entry& e : entries)
        out.push_back({e.key, numbersJson(e.evaluation.objectives), numbersJson(e.evaluation.details)});
    return out;
}

std::vector<Ledger::Entry> entriesOf(const Json& json, std::size_t codes, std::size_t objectives,
                                     const std::function<Values(const CandidateKey&)>& values_of) {
    std::vector<Ledger::Entry> out;
    for (const Json& e : json) {
        CandidateKey key = e.at(0);
        Evaluation evaluation{.objectives = numbersOf(e.at(1)), .details = numbersOf(e.at(2))};
        if (key.size() != codes || evaluation.objectives.size() != objectives)
            throw std::out_of_range("entry " + std::to_string(out.size()));
        Values values = values_of(key);
        out.push_back({std::move(key), std::move(values), std::move(evaluation)});
    }
    return out;
}

base::Result<void> writeRun(const std::string& path, const Json& settings, Json run) {
    Json document;
    document["cusp_search_checkpoint"] = schema;
    document["settings"] = settings;
    document["run"] = std::move(run);
    return base::writeWholeFile(path, document.dump() + "\n");
}

base::Result<void> readRun(const std::string& path, const Json& settings,
                           const std::function<void(const Json&)>& take) {
    std::error_code none;
    if (!std::filesystem::exists(path, none)) return {};
    const auto text = base::readWholeFile(path, largest_file_bytes);
    if (!text) return tl::unexpected(text.error());
    const base::Location where{.file = path, .line = 0, .column = 0, .key = {}};
    try {
        const Json document = Json::parse(*text);
        if (document.at("cusp_search_checkpoint") != schema)
            return base::fail("evolution.checkpoint",
                              fmt::format("written by another version of the search (schema {}, this one reads {})",
                                          document.at("cusp_search_checkpoint").dump(), schema),
                              where);
        if (const std::string key = firstDifference(settings, document.at("settings")); !key.empty())
            return base::fail("evolution.checkpoint-differs",
                              fmt::format("this checkpoint is of another search: '{}' is not the same; resume with the "
                                          "settings it was begun with, or remove the file to begin anew",
                                          key),
                              where);
        take(document.at("run"));
    } catch (const std::exception& problem) {
        return base::fail("evolution.checkpoint",
                          fmt::format("no checkpoint of a search, or a damaged one ({}); remove the file to begin anew",
                                      problem.what()),
                          where);
    }
    return {};
}

}  // namespace cusp::optimizer
