// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Grid and pattern search on the codes of an encoding.
#include "true_optimum.hpp"

#include <cusp/base/progress.hpp>

#include <algorithm>
#include <map>

namespace bench {

using cusp::optimizer::Encoding;
using cusp::optimizer::EvaluateBatch;
using Codes = std::vector<std::uint64_t>;

namespace {

std::vector<double> judge(const Encoding& encoding, const EvaluateBatch& evaluate, const std::vector<Codes>& all) {
    std::vector<cusp::optimizer::Values> values;
    values.reserve(all.size());
    for (const Codes& codes : all) values.push_back(encoding.values(codes));
    std::vector<double> out;
    const auto judged = evaluate(values, cusp::base::noProgress()).value();
    for (const auto& one : judged) out.push_back(one.objectives.front());
    return out;
}

/// All candidates one step away in one gene, or in two together; the first gene is a choice and stays.
std::vector<Codes> around(const Encoding& encoding, const Codes& at, const Codes& step) {
    std::vector<Codes> out;
    const auto moved = [&](const Codes& from, std::size_t gene, int way, Codes& to) {
        to = from;
        if (way < 0 && from[gene] < step[gene]) return false;
        to[gene] = way < 0 ? from[gene] - step[gene] : from[gene] + step[gene];
        return to[gene] <= encoding.largestCode(gene);
    };
    Codes one;
    Codes two;
    for (std::size_t g = 1; g < at.size(); ++g)
        for (const int way : {-1, 1}) {
            if (!moved(at, g, way, one)) continue;
            out.push_back(one);
            for (std::size_t h = g + 1; h < at.size(); ++h)
                for (const int other : {-1, 1})
                    if (moved(one, h, other, two)) out.push_back(two);
        }
    return out;
}

}  // namespace

Optimum refined(const Encoding& encoding, const EvaluateBatch& evaluate, const Optimum& start,
                const Codes& first_step) {
    Optimum out = start;
    Codes step = first_step;
    for (;;) {
        const auto near = around(encoding, out.codes, step);
        const auto values = judge(encoding, evaluate, near);
        out.evaluations += near.size();
        const auto best = std::min_element(values.begin(), values.end());
        if (best != values.end() && *best < out.objective) {
            out.objective = *best;
            out.codes = near[static_cast<std::size_t>(best - values.begin())];
            for (std::size_t g = 1; g < step.size(); ++g) step[g] = std::min(2 * step[g], first_step[g]);
            continue;
        }
        if (std::all_of(step.begin() + 1, step.end(), [](std::uint64_t s) { return s == 1; })) return out;
        for (std::uint64_t& s : step) s = std::max<std::uint64_t>(1, s / 2);
    }
}

Optimum trueOptimum(const Encoding& encoding, const EvaluateBatch& evaluate, const std::vector<std::size_t>& steps,
                    std::size_t starts) {
    const std::uint64_t choices = encoding.largestCode(0) + 1;
    Codes stride{1};
    for (std::size_t g = 1; g < steps.size(); ++g) stride.push_back(encoding.largestCode(g) / (steps[g] - 1));
    Optimum best;
    for (std::uint64_t choice = 0; choice < choices; ++choice) {
        std::vector<Codes> grid{{choice}};
        for (std::size_t g = 1; g < steps.size(); ++g) {
            std::vector<Codes> longer;
            for (const Codes& codes : grid)
                for (std::size_t k = 0; k < steps[g]; ++k) {
                    longer.push_back(codes);
                    longer.back().push_back(k + 1 == steps[g] ? encoding.largestCode(g) : k * stride[g]);
                }
            grid = std::move(longer);
        }
        const auto values = judge(encoding, evaluate, grid);
        best.evaluations += grid.size();
        std::multimap<double, std::size_t> order;
        for (std::size_t i = 0; i < values.size(); ++i) order.emplace(values[i], i);
        Codes half = stride;
        for (std::uint64_t& s : half) s = std::max<std::uint64_t>(1, s / 2);
        std::size_t taken = 0;
        for (const auto& [value, index] : order) {
            if (taken++ == starts) break;
            const Optimum end = refined(encoding, evaluate, {grid[index], value, 0}, half);
            best.evaluations += end.evaluations;
            if (best.codes.empty() || end.objective < best.objective) {
                best.objective = end.objective;
                best.codes = end.codes;
            }
        }
    }
    return best;
}

}  // namespace bench
