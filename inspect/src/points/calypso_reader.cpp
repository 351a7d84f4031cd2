// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Calypso's table file (…_chr.txt): tab-separated characteristics, of which x, y and z of a feature make a point.
#include "points/formats.hpp"
#include "points/point_text.hpp"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>

namespace cusp::inspect {
namespace {

struct Columns {
    std::size_t type = 0;
    std::size_t actual = 0;
    std::size_t feature = 0;
};

struct Feature {
    std::string name;
    std::array<std::optional<double>, 3> actual;
    std::uint64_t line = 0;
};

std::optional<std::size_t> columnNamed(const std::vector<std::string_view>& names, std::string_view name) {
    const auto found = std::find_if(names.begin(), names.end(), [name](auto n) { return lowered(n) == name; });
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
}

/// 0, 1, 2 for "xValue", "X-Value", "x_value" …
std::optional<std::size_t> axisOfType(std::string_view type) {
    const std::string word = lowered(type);
    const std::size_t axis = word.empty() ? std::string::npos : std::string_view("xyz").find(word.front());
    if (axis == std::string::npos || word.find("value") == std::string::npos || word.size() > 8) return std::nullopt;
    return axis;
}

class CalypsoReader {
public:
    CalypsoReader(const PointReaderOptions& options, PointCollector& out) : decimal_(options.decimal), out_(out) {}

    bool takeHeader(std::string_view line, std::uint64_t number) {
        std::vector<std::string_view> names;
        splitFields(line, '\t', names);
        const auto type = columnNamed(names, "type");
        const auto actual = columnNamed(names, "actual");
        const auto feature = columnNamed(names, "featureid");
        if (!type || !actual || !feature) {
            out_.error("points.header", "a Calypso table needs the columns type, actual and featureid", number);
            return false;
        }
        columns_ = {*type, *actual, *feature};
        return true;
    }

    void takeRow(std::string_view line, std::uint64_t number) {
        splitFields(line, '\t', fields_);
        if (fields_.empty() || lowered(fields_.front()) == "end") return;
        if (fields_.size() <= std::max({columns_.type, columns_.actual, columns_.feature}))
            return out_.error("points.columns", fmt::format("{} columns are too few", fields_.size()), number);
        const auto axis = axisOfType(fields_[columns_.type]);
        if (!axis) {
            ++others_;
            return;
        }
        if (fields_[columns_.feature] != feature_.name || feature_.actual.at(*axis)) endFeature();
        feature_.name = fields_[columns_.feature];
        feature_.line = number;
        const std::string_view text = fields_[columns_.actual];
        feature_.actual.at(*axis) = decimal_ ? parseNumber(text, *decimal_)
                                             : parseNumber(text, text.find(',') == std::string_view::npos ? '.' : ',');
        if (!feature_.actual.at(*axis))
            out_.error("points.number", fmt::format("actual: {} is no number", inQuotes(text)), number);
    }

    void finish() {
        endFeature();
        if (others_ > 0)
            out_.note("points.other-features", fmt::format("{} characteristics are no coordinate of a point", others_));
    }

private:
    void endFeature() {
        const auto& v = feature_.actual;
        const auto given = std::count_if(v.begin(), v.end(), [](const auto& value) { return value.has_value(); });
        if (given == 3)
            out_.add(feature_.line, {*v[0], *v[1], *v[2]});
        else if (given > 0 && !out_.hasErrors())
            out_.error("points.columns",
                       fmt::format("feature {} has {} of its three coordinates", inQuotes(feature_.name), given),
                       feature_.line);
        feature_ = {};
    }

    std::optional<char> decimal_;
    PointCollector& out_;
    Columns columns_;
    Feature feature_;
    std::vector<std::string_view> fields_;
    std::size_t others_ = 0;
};

}  // namespace

void readCalypso(ByteSource& source, const PointReaderOptions& options, PointCollector& out) {
    out.format("calypso");
    CalypsoReader reader(options, out);
    std::string_view line;
    if (!source.nextLine(line) || !reader.takeHeader(line, source.lineNumber())) return;
    while (source.nextLine(line))
        if (!trimmed(line).empty()) reader.takeRow(line, source.lineNumber());
    reader.finish();
}

}  // namespace cusp::inspect
