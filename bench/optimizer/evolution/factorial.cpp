// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Table 1 run cell by cell, and drawn.
#include "factorial.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>

namespace bench {

using namespace cusp::optimizer;

namespace {

void fill(Field& field, const Problem& problem, SearchOptions options, std::size_t seeds, std::size_t evaluations,
          const std::function<void(std::size_t, std::size_t, VirusOptions&)>& set) {
    for (std::size_t r = 0; r < field.rows.size(); ++r) {
        field.log_median.emplace_back();
        field.evaluations.emplace_back();
        for (std::size_t c = 0; c < field.columns.size(); ++c) {
            SearchOptions cell = options;
            set(r, c, cell.virus);
            const std::vector<std::size_t> budgets(evaluations > 0 ? seeds : 0, evaluations);
            const Outcomes outcomes = runSeeds(problem, Coding::Binary, cell, seeds, budgets);
            field.log_median.back().push_back(std::log10(spreadOf(outcomes.best).median));
            field.evaluations.back().push_back(outcomes.mean_evaluations);
        }
    }
}

/// From light (poor) to dark (good), readable in print.
std::string colourOf(double share) {
    const auto mix = [&](double a, double b) { return static_cast<int>(std::lround(a + (b - a) * share)); };
    return fmt::format("#{:02x}{:02x}{:02x}", mix(244, 12), mix(241, 74), mix(222, 110));
}

void cell(std::string& out, const Field& field, std::size_t r, std::size_t c, double left, double low, double high) {
    const double value = field.log_median[r][c];
    const double share = high > low ? (high - value) / (high - low) : 0.5;
    const double x = left + 92.0 + 84.0 * static_cast<double>(c);
    const double y = 92.0 + 56.0 * static_cast<double>(r);
    const char* ink = share > 0.55 ? "#ffffff" : "#1c2430";
    out += fmt::format("<rect x='{}' y='{}' width='82' height='54' fill='{}'/>\n", x, y, colourOf(share));
    out += fmt::format("<text x='{}' y='{}' text-anchor='middle' fill='{}' font-size='15'>{:.1f}</text>\n", x + 41,
                       y + 25, ink, value);
    out += fmt::format("<text x='{}' y='{}' text-anchor='middle' fill='{}' font-size='11'>{:.0f} cand.</text>\n",
                       x + 41, y + 43, ink, field.evaluations[r][c]);
}

}  // namespace

std::vector<Field> factorialStudy(const Problem& problem, SearchOptions options, std::size_t seeds,
                                  std::size_t evaluations) {
    Field size{.title = "Virus population and length",
               .row_title = "viruses",
               .column_title = "longest virus, bits",
               .rows = {"2", "5", "7", "10"},
               .columns = {"10", "20", "30", "40"},
               .log_median = {},
               .evaluations = {}};
    const std::size_t populations[] = {2, 5, 7, 10};
    const std::size_t lengths[] = {10, 20, 30, 40};
    fill(size, problem, options, seeds, evaluations, [&](std::size_t r, std::size_t c, VirusOptions& virus) {
        virus.population = populations[r];
        virus.longest = lengths[c];
    });
    Field force{.title = "Infectivity force and infection rate",
                .row_title = "force",
                .column_title = "infection rate",
                .rows = {"0.001", "0.01", "0.1", "1"},
                .columns = {"10 %", "40 %", "70 %", "100 %"},
                .log_median = {},
                .evaluations = {}};
    const double forces[] = {0.001, 0.01, 0.1, 1.0};
    const double rates[] = {0.1, 0.4, 0.7, 1.0};
    fill(force, problem, options, seeds, evaluations, [&](std::size_t r, std::size_t c, VirusOptions& virus) {
        virus.infectivity_force = forces[r];
        virus.infection_rate = virus.min_infection_rate = virus.max_infection_rate = rates[c];
    });
    return {size, force};
}

std::string toSvg(const std::vector<Field>& fields, const std::string& caption) {
    double low = 1e9;
    double high = -1e9;
    for (const Field& field : fields)
        for (const auto& row : field.log_median)
            for (const double value : row) {
                low = std::min(low, value);
                high = std::max(high, value);
            }
    std::string out =
        "<svg xmlns='http://www.w3.org/2000/svg' width='900' height='370' viewBox='0 0 900 370' "
        "font-family='sans-serif'>\n<!-- SPDX-FileCopyrightText: The cusp authors; SPDX-License-Identifier: Apache-2.0 -->\n"
        "<rect width='900' height='370' fill='#ffffff'/>\n";
    for (std::size_t f = 0; f < fields.size(); ++f) {
        const Field& field = fields[f];
        const double left = 10.0 + 450.0 * static_cast<double>(f);
        out += fmt::format("<text x='{}' y='28' font-size='16' fill='#1c2430'>{}</text>\n", left, field.title);
        out +=
            fmt::format("<text x='{}' y='58' font-size='12' fill='#4a5568'>{}</text>\n", left + 92, field.column_title);
        out += fmt::format("<text x='{}' y='82' font-size='12' fill='#4a5568'>{}</text>\n", left, field.row_title);
        for (std::size_t c = 0; c < field.columns.size(); ++c)
            out += fmt::format("<text x='{}' y='82' font-size='13' text-anchor='middle' fill='#1c2430'>{}</text>\n",
                               left + 133 + 84.0 * static_cast<double>(c), field.columns[c]);
        for (std::size_t r = 0; r < field.rows.size(); ++r) {
            out += fmt::format("<text x='{}' y='{}' font-size='13' text-anchor='end' fill='#1c2430'>{}</text>\n",
                               left + 82, 124.0 + 56.0 * static_cast<double>(r), field.rows[r]);
            for (std::size_t c = 0; c < field.columns.size(); ++c) cell(out, field, r, c, left, low, high);
        }
    }
    out += fmt::format("<text x='10' y='350' font-size='12' fill='#4a5568'>{}</text>\n</svg>\n", caption);
    return out;
}

}  // namespace bench
