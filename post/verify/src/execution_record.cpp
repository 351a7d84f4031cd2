// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The table of samples, column by name.
#include <cusp/post/verify/execution.hpp>

#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace cusp::post::verify {

namespace {

constexpr std::array<std::string_view, 8> names{"time_s", "tip_x_mm", "tip_y_mm", "tip_z_mm",
                                                "axis_i", "axis_j",   "axis_k",   "line"};
constexpr std::size_t most_errors = 20;
/// The axis is written with nine digits.
constexpr double unit_slack = 1e-3;

using Columns = std::array<std::size_t, names.size()>;
using Fields = std::vector<std::string_view>;

void split(std::string_view row, Fields& fields) {
    fields.clear();
    if (row.ends_with('\r')) row.remove_suffix(1);
    for (std::size_t at = 0;; ++at) {
        const std::size_t end = std::min(row.find(',', at), row.size());
        fields.push_back(row.substr(at, end - at));
        if (end == row.size()) return;
        at = end;
    }
}

std::optional<Columns> columnsOf(const Fields& heading, const std::string& file_name, base::Diagnostics& report) {
    Columns out{};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto found = std::ranges::find(heading, names[i]);
        if (found == heading.end())
            report.error("record.heading", fmt::format("the first line names no column '{}'", names[i]),
                         {file_name, 1, 0, {}});
        out[i] = static_cast<std::size_t>(found - heading.begin());
    }
    if (report.hasErrors()) return std::nullopt;
    return out;
}

/// What is wrong with it, or nothing.
std::string readRow(const Fields& fields, const Columns& columns, std::size_t count, ExecutedSample& sample) {
    if (fields.size() != count) return fmt::format("has {} fields; the heading has {}", fields.size(), count);
    std::array<double, names.size()> values{};
    for (std::size_t i = 0; i < names.size(); ++i) {
        const auto value = base::parseDouble(fields[columns[i]]);
        if (!value) return fmt::format("{} is '{}', no number", names[i], fields[columns[i]]);
        values[i] = *value;
    }
    sample.time_s = values[0];
    sample.tool.tip_mm = {values[1], values[2], values[3]};
    sample.tool.axis = {values[4], values[5], values[6]};
    const double length = std::hypot(values[4], values[5], values[6]);
    if (std::abs(length - 1.0) > unit_slack) return fmt::format("the tool axis is {:.6g} long; it has to be 1", length);
    sample.tool.axis = (1.0 / length) * sample.tool.axis;
    if (values[7] < 0.0 || values[7] > 1e9 || values[7] != std::floor(values[7])) return "line is no line number";
    sample.line = static_cast<std::size_t>(values[7]);
    return {};
}

}  // namespace

base::Result<std::vector<ExecutedSample>> readExecutionRecord(std::istream& in, const std::string& file_name) {
    base::Diagnostics report;
    std::string row;
    Fields fields;
    std::getline(in, row);
    split(row, fields);
    const std::size_t count = fields.size();
    const auto columns = columnsOf(fields, file_name, report);
    if (!columns) return base::fail(std::move(report));
    std::vector<ExecutedSample> samples;
    for (std::size_t line = 2; std::getline(in, row) && report.errorCount() < most_errors; ++line) {
        split(row, fields);
        ExecutedSample sample;
        if (const std::string wrong = readRow(fields, *columns, count, sample); !wrong.empty())
            report.error("record.row", wrong, {file_name, line, 0, {}});
        else if (!samples.empty() && sample.time_s <= samples.back().time_s)
            report.error(
                "record.order",
                fmt::format("time_s is {:.6g} after {:.6g}; it has to grow", sample.time_s, samples.back().time_s),
                {file_name, line, 0, {}});
        else
            samples.push_back(sample);
    }
    if (report.hasErrors()) return base::fail(std::move(report));
    if (samples.empty()) return base::fail("record.empty", "holds no sample", {file_name, 0, 0, {}});
    return samples;
}

}  // namespace cusp::post::verify
