// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// NURBS, KNOT and CNTRL: kept as the numbers they are.
#include "number_scan.hpp"
#include "statement_table.hpp"

#include <fmt/format.h>
#include <utility>

namespace cusp::toolpath::detail {
namespace {

/// Comma-separated numbers, as many as there are; reports the first that is none.
std::optional<std::vector<double>> numbersOf(ReaderContext& context, std::string_view word, std::string_view body) {
    std::vector<double> numbers;
    for (bool more = true; more;) {
        const std::size_t comma = body.find(',');
        more = comma != std::string_view::npos;
        const std::string_view text = trimmed(body.substr(0, comma));
        const char* const last = text.data() + text.size();
        double number = 0.0;
        if (text.empty() || scanNumber(text.data(), last, number) != last) {
            context.error("cl.number", fmt::format("{}: '{}' is not a number", word, inQuotes(text)));
            return std::nullopt;
        }
        numbers.push_back(number);
        body.remove_prefix(more ? comma + 1 : body.size());
    }
    return numbers;
}

}  // namespace

void handleNurbs(ReaderContext& context, std::string_view word, std::string_view body) {
    abandonArc(context);
    context.requireUnit();
    context.settleTool();
    context.rapid = false;
    context.motion_seen = true;
    context.standing = Standing::Unknown;
    if (auto parameters = numbersOf(context, word, body)) {
        context.spline = ClRecord{SplineMotion{*std::move(parameters), {}, {}}, context.line};
    }
}

void handleSplineData(ReaderContext& context, std::string_view word, std::string_view body) {
    auto numbers = numbersOf(context, word, body);
    if (!numbers) {
        return;
    }
    if (!context.spline) {
        context.error("cl.nurbs", fmt::format("{} without a NURBS before it", word));
        return;
    }
    auto& spline = std::get<SplineMotion>(context.spline->statement);
    if (word == "KNOT") {
        spline.knots.insert(spline.knots.end(), numbers->begin(), numbers->end());
    } else {
        spline.controls.push_back(*std::move(numbers));
    }
}

void finishSpline(ReaderContext& context, std::string_view next_word) {
    if (!context.spline || next_word == "KNOT" || next_word == "CNTRL") {
        return;
    }
    const auto& spline = std::get<SplineMotion>(context.spline->statement);
    if (spline.controls.empty()) {
        context.report.error("cl.nurbs", "NURBS is not followed by its CNTRL statements",
                             {context.file_name, context.spline->line, 0, {}});
    } else {
        context.records.push_back(*std::move(context.spline));
    }
    context.spline.reset();
}

}  // namespace cusp::toolpath::detail
