// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// PC-DMIS text: features with THEO/<…> and ACTL/<…> (edit window), and report tables of a location with AX … MEAS.
#include "points/formats.hpp"
#include "points/point_text.hpp"

#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

namespace cusp::inspect {
namespace {

class PcDmisReader {
public:
    explicit PcDmisReader(PointCollector& out) : out_(out) {}

    void take(std::string_view line, std::uint64_t number) {
        line = trimmed(line);
        const std::size_t unit = lowered(line).find("units=");
        if (unit != std::string::npos) takeUnit(line.substr(unit + 6), number);
        const std::size_t feature = lowered(line).find("feat/");
        if (feature != std::string::npos) return takeFeature(lowered(line.substr(feature + 5)));
        if (startsWithWord(line, "DIM ") || startsWithWord(line, "END OF DIMENSION")) return endTable(number);
        if (startsWithWord(line, "ACTL/")) return takeActual(line.substr(5), number);
        if (startsWithWord(line, "AX ")) return takeTableHead(line, number);
        if (measured_column_) takeTableRow(line, number);
    }

    void finish(std::uint64_t number) {
        endTable(number);
        if (features_that_are_no_points_ > 0)
            out_.note("points.other-features",
                      fmt::format("{} features are no points and are not used", features_that_are_no_points_));
    }

private:
    void takeUnit(std::string_view text, std::uint64_t number) {
        const std::string word = lowered(text.substr(0, text.find_first_of(" ,\t$")));
        const auto length = unitLength(word);
        if (!length)
            return out_.error("points.unit", fmt::format("UNITS={}: this unit is not known", inQuotes(word)), number);
        if (file_unit_mm_ && *file_unit_mm_ != *length)
            return out_.error("points.unit", "dimensions of one file have different units", number);
        if (!file_unit_mm_) out_.unit(*length);
        file_unit_mm_ = length;
    }

    void takeFeature(const std::string& type) {
        feature_is_point_ = type.find("point") != std::string::npos;
        if (!feature_is_point_) ++features_that_are_no_points_;
    }

    /// "<x,y,z>,<i,j,k>" or, of older versions, "x,y,z,i,j,k".
    void takeActual(std::string_view text, std::uint64_t number) {
        if (!feature_is_point_) return;
        std::string plain;
        std::copy_if(text.begin(), text.end(), std::back_inserter(plain), [](char c) { return c != '<' && c != '>'; });
        std::vector<std::string_view> fields;
        splitFields(plain, ',', fields);
        if (fields.size() < 3) return out_.error("points.columns", "ACTL needs three coordinates", number);
        std::array<double, 6> values{};
        const std::size_t count = fields.size() >= 6 ? 6 : 3;
        for (std::size_t i = 0; i < count; ++i) {
            const auto value = base::parseDouble(fields[i]);
            if (!value)
                return out_.error("points.number", fmt::format("ACTL: {} is no number", inQuotes(fields[i])), number);
            values.at(i) = *value;
        }
        out_.add(number, {values[0], values[1], values[2]});
        if (count == 6) out_.direction({values[3], values[4], values[5]});
    }

    void takeTableHead(std::string_view line, std::uint64_t number) {
        std::vector<std::string_view> fields;
        splitFields(line, ' ', fields);
        const auto found =
            std::find_if(fields.begin(), fields.end(), [](auto f) { return lowered(f).starts_with("meas"); });
        if (found == fields.end()) return out_.error("points.header", "the table has no column MEAS", number);
        measured_column_ = static_cast<std::size_t>(found - fields.begin());
    }

    void takeTableRow(std::string_view line, std::uint64_t number) {
        std::vector<std::string_view> fields;
        splitFields(line, ' ', fields);
        if (fields.empty() || fields[0].size() != 1) return;
        const std::size_t axis = std::string_view("XYZ").find(fields[0][0]);
        if (axis == std::string_view::npos) return;
        const auto value =
            fields.size() > *measured_column_ ? base::parseDouble(fields[*measured_column_]) : std::nullopt;
        if (!value) return out_.error("points.number", "the measured value of this axis is no number", number);
        table_.at(axis) = value;
        table_line_ = number;
    }

    /// A table gives a point when it has all three axes.
    void endTable(std::uint64_t number) {
        const auto given = std::count_if(table_.begin(), table_.end(), [](const auto& v) { return v.has_value(); });
        if (given == 3)
            out_.add(table_line_, {*table_[0], *table_[1], *table_[2]});
        else if (given > 0)
            out_.error("points.columns",
                       fmt::format("a dimension gives {} of the three coordinates of its point", given), number);
        table_ = {};
        measured_column_.reset();
    }

    PointCollector& out_;
    bool feature_is_point_ = true;
    int features_that_are_no_points_ = 0;
    std::optional<double> file_unit_mm_;
    std::optional<std::size_t> measured_column_;
    std::array<std::optional<double>, 3> table_;
    std::uint64_t table_line_ = 0;
};

}  // namespace

void readPcDmis(ByteSource& source, PointCollector& out) {
    out.format("pc-dmis");
    PcDmisReader reader(out);
    for (std::string_view line; source.nextLine(line);) reader.take(line, source.lineNumber());
    reader.finish(source.lineNumber());
}

}  // namespace cusp::inspect
