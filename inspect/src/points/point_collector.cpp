// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Gathers points; checks directions, duplicates and emptiness once all are there.
#include "points/point_collector.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <numeric>
#include <utility>

namespace cusp::inspect {
namespace {

/// Equal positions have equal keys.
std::uint64_t keyOf(const Vector3& p) {
    std::uint64_t key = 0;
    for (Eigen::Index i = 0; i < 3; ++i) {
        key ^= std::bit_cast<std::uint64_t>(p[i] + 0.0) + 0x9e3779b97f4a7c15U + (key << 6U) + (key >> 2U);
        key *= 0xbf58476d1ce4e5b9U;
    }
    return key;
}

constexpr double largest_mm = 1e9;

}  // namespace

PointCollector::PointCollector(std::string name, const PointReaderOptions& options, base::Diagnostics& report)
    : report_(report) {
    points_.source = std::move(name);
    if (options.mm_per_unit) {
        points_.mm_per_unit = *options.mm_per_unit;
        points_.unit_stated = true;
    }
    points_.kind = options.kind;
}

base::Location PointCollector::where(std::uint64_t line) const {
    base::Location out;
    out.file = points_.source;
    out.line = line;
    return out;
}

void PointCollector::error(std::string_view code, std::string message, std::uint64_t line) {
    errors_.error(code, std::move(message), where(line));
}

void PointCollector::warning(std::string_view code, std::string message, std::uint64_t line) {
    report_.warning(code, std::move(message), where(line));
}

void PointCollector::note(std::string_view code, std::string message, std::uint64_t line) {
    report_.note(code, std::move(message), where(line));
}

void PointCollector::unit(double mm_per_unit) {
    if (points_.unit_stated) {
        if (points_.mm_per_unit != mm_per_unit)
            warning("points.unit-overruled",
                    fmt::format("the file says its unit is {} mm; it is read as {} mm, as asked", mm_per_unit,
                                points_.mm_per_unit));
        return;
    }
    points_.mm_per_unit = mm_per_unit;
    points_.unit_stated = true;
}

void PointCollector::kind(PointKind kind) {
    if (!points_.kind) points_.kind = kind;
}

void PointCollector::add(std::uint64_t line, const Vector3& position) {
    if (!position.allFinite() || position.cwiseAbs().maxCoeff() > largest_mm)
        return error("points.number", "a coordinate is not finite or beyond 1e9", line);
    points_.positions.push_back(position);
    points_.lines.push_back(line);
}

void PointCollector::direction(const Vector3& direction) {
    // A point that was refused has no direction either; the error ends the reading anyway.
    if (points_.directions.size() < points_.positions.size()) points_.directions.push_back(direction);
}

void PointCollector::section(std::string_view label) {
    if (points_.sections.size() >= points_.positions.size()) return;
    if (last_section_ < 0 || label != last_label_) {
        last_label_ = label;
        const auto next = static_cast<std::int32_t>(points_.section_labels.size());
        const auto [entry, is_new] = section_index_.emplace(last_label_, next);
        if (is_new) points_.section_labels.push_back(last_label_);
        last_section_ = entry->second;
    }
    points_.sections.push_back(last_section_);
}

void PointCollector::weight(double weight) {
    if (points_.weights.size() < points_.positions.size()) points_.weights.push_back(weight);
}

void PointCollector::missing(std::uint64_t line) {
    if (missing_++ == 0) first_missing_line_ = line;
}

void PointCollector::checkDirections() {
    if (points_.directions.empty()) return;
    std::size_t bad = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < points_.directions.size(); ++i) {
        const double length = points_.directions[i].norm();
        constexpr double tolerance = 0.01;  // i, j, k printed with three places
        if (std::abs(length - 1.0) <= tolerance)
            points_.directions[i] /= length;
        else if (bad++ == 0)
            first = i;
    }
    if (bad == 0 && points_.directions.size() == points_.size()) return;
    if (bad > 0)
        warning("points.directions",
                fmt::format("{} of {} directions i, j, k are no unit vectors (the first: length {:.4g}); none is used",
                            bad, points_.directions.size(), points_.directions[first].norm()),
                points_.lines[first]);
    else
        warning("points.directions", "only some points have a direction i, j, k; none is used");
    points_.directions.clear();
}

void PointCollector::checkDuplicates() {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(points_.size());
    for (std::size_t i = 0; i < keys.size(); ++i)
        keys[i] = {keyOf(points_.positions[i]), static_cast<std::uint32_t>(i)};
    std::sort(keys.begin(), keys.end());
    std::size_t duplicates = 0;
    std::uint32_t first = 0;
    std::uint32_t earlier = 0;
    for (std::size_t i = 1; i < keys.size(); ++i) {
        if (keys[i].first != keys[i - 1].first) continue;
        if (points_.positions[keys[i].second] != points_.positions[keys[i - 1].second]) continue;
        if (duplicates++ == 0 || keys[i].second < first) {
            first = keys[i].second;
            earlier = keys[i - 1].second;
        }
    }
    if (duplicates == 0) return;
    warning(
        "points.duplicates",
        fmt::format("{} of {} points have the coordinates of an earlier one (the first: that of line {}); all are kept",
                    duplicates, points_.size(), points_.lines[earlier]),
        points_.lines[first]);
}

void PointCollector::reportMissing() {
    if (missing_ == 0) return;
    warning("points.missing",
            fmt::format("{} points of the cloud have no coordinates (NaN) and are passed over", missing_),
            first_missing_line_);
}

base::Result<MeasuredPoints> PointCollector::finish() {
    reportMissing();
    if (points_.positions.empty() && !errors_.hasErrors()) error("points.empty", "the file holds no point");
    if (errors_.hasErrors()) return base::fail(errors_);
    if (!points_.sections.empty() && points_.sections.size() != points_.size())
        points_.sections.resize(points_.size(), -1);
    checkDirections();
    checkDuplicates();
    for (Vector3& position : points_.positions) position *= points_.mm_per_unit;
    return std::move(points_);
}

}  // namespace cusp::inspect
