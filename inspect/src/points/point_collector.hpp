// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where the readers of all formats put their points and problems, and the checks all formats share.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/inspect/point_reader.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace cusp::inspect {

/// Lengths come in the file's unit; `finish` makes them mm.
class PointCollector {
public:
    PointCollector(std::string name, const PointReaderOptions& options, base::Diagnostics& report);

    void format(std::string_view name) { points_.format = name; }
    /// The file says its unit; the caller's word goes before it.
    void unit(double mm_per_unit);
    /// The file says what its points are; likewise.
    void kind(PointKind kind);
    void probeRadius(double radius_mm) { points_.probe_radius_mm = radius_mm; }

    void add(std::uint64_t line, const Vector3& position);
    /// Of the point just added.
    void direction(const Vector3& direction);
    void section(std::string_view label);
    void weight(double weight);
    /// A point of a cloud without coordinates (NaN): passed over, and counted.
    void missing(std::uint64_t line);

    void error(std::string_view code, std::string message, std::uint64_t line = 0);
    void warning(std::string_view code, std::string message, std::uint64_t line = 0);
    void note(std::string_view code, std::string message, std::uint64_t line = 0);
    [[nodiscard]] bool hasErrors() const { return errors_.hasErrors(); }
    [[nodiscard]] std::size_t size() const { return points_.size(); }

    /// The points, after the checks that every format needs.
    [[nodiscard]] base::Result<MeasuredPoints> finish();

private:
    [[nodiscard]] base::Location where(std::uint64_t line) const;
    void checkDirections();
    void checkDuplicates();
    void reportMissing();

    MeasuredPoints points_;
    base::Diagnostics errors_;
    base::Diagnostics& report_;
    std::unordered_map<std::string, std::int32_t> section_index_;
    std::string last_label_;
    std::int32_t last_section_ = -1;
    std::uint64_t missing_ = 0;
    std::uint64_t first_missing_line_ = 0;
};

}  // namespace cusp::inspect
