// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Finds separator and decimal mark from the first lines, and columns from a header, from --columns or from the numbers.
#include "points/table_layout.hpp"

#include "points/point_text.hpp"
#include "points/table_header.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace cusp::inspect {
namespace {

using Lines = std::vector<std::string_view>;

bool hasLetter(std::string_view text) {
    return std::any_of(text.begin(), text.end(), [](unsigned char c) { return std::isalpha(c) != 0; });
}

/// A number, or what was meant as one ("1.234,5"): the row that holds it is no header and the column no name.
bool isNumber(std::string_view field) {
    const bool of_digits = field.find_first_of("0123456789") != std::string_view::npos &&
                           field.find_first_not_of("+-.,0123456789eE") == std::string_view::npos;
    return of_digits || isNotANumber(field);
}

/// Whether every blank-separated field of the rows is a number, and some have a comma inside: "1,5 2,5 3,5".
bool blanksSeparateCommas(const Lines& rows) {
    bool has_comma = false;
    std::vector<std::string_view> fields;
    for (const std::string_view row : rows) {
        splitFields(row, ' ', fields);
        const bool numbers = std::all_of(fields.begin(), fields.end(),
                                         [](std::string_view field) { return isNumber(field) && field.back() != ','; });
        if (fields.size() < 3 || !numbers) return false;
        has_comma = has_comma || row.find(',') != std::string_view::npos;
    }
    return has_comma;
}

char findSeparator(const Lines& lines, const Lines& rows) {
    const auto any = [&lines](char c) {
        return std::any_of(lines.begin(), lines.end(), [c](std::string_view l) { return l.find(c) != l.npos; });
    };
    if (any(';')) return ';';
    if (any('\t')) return '\t';
    if (any('|')) return '|';
    if (any(',') && !blanksSeparateCommas(rows)) return ',';
    return ' ';
}

/// Of a separator that is no comma: the mark the numbers have.
char findDecimal(const Lines& rows, char separator) {
    std::vector<std::string_view> fields;
    for (const std::string_view row : rows) {
        splitFields(row, separator, fields);
        for (const std::string_view field : fields)
            if (!parseNumber(field, '.') && parseNumber(field, ',')) return ',';
    }
    return '.';
}

/// "10,5,20,25,3,125": three numbers with decimal commas, or six whole ones? Nobody can tell.
bool commasAreAmbiguous(const Lines& rows, const PointReaderOptions& options) {
    if (options.decimal || !options.columns.empty()) return false;
    std::vector<std::string_view> fields;
    for (const std::string_view row : rows) {
        splitFields(row, ',', fields);
        if (fields.size() != 6) return false;
        for (const std::string_view field : fields)
            if (field.empty() || field.find_first_not_of("+-0123456789") != std::string_view::npos) return false;
    }
    return !rows.empty();
}

std::optional<double> numberAt(std::string_view row, std::size_t column, const TableLayout& layout) {
    std::vector<std::string_view> fields;
    splitFields(row, layout.separator, fields);
    return column < fields.size() ? parseNumber(fields[column], layout.decimal) : std::nullopt;
}

/// Whether the three columns hold unit vectors in every row.
bool holdsDirections(const Lines& rows, std::size_t first, const TableLayout& layout) {
    return std::all_of(rows.begin(), rows.end(), [&](std::string_view row) {
        double square = 0.0;
        for (std::size_t i = first; i < first + 3; ++i) {
            const double value = numberAt(row, i, layout).value_or(9.0);
            square += value * value;
        }
        return std::abs(std::sqrt(square) - 1.0) <= 0.01;
    });
}

/// Whether a column numbers the rows (n, n + 1, …) or names them.
bool holdsNames(const Lines& rows, const TableLayout& layout) {
    std::optional<double> last;
    for (const std::string_view row : rows) {
        const auto value = numberAt(row, 0, layout);
        if (value && (*value != std::floor(*value) || (last && *value != *last + 1.0))) return false;
        if (!value && last) return false;
        last = value;
    }
    return rows.size() > 1 || !last;
}

/// Without a header: x y z, x y z i j k, either with a number or a name before it; what follows is not used.
bool columnsFromNumbers(const Lines& rows, std::uint64_t line, TableLayout& layout, PointCollector& out) {
    std::vector<std::string_view> fields;
    splitFields(rows.front(), layout.separator, fields);
    layout.columns = fields.size();
    const std::size_t begin =
        (fields.size() == 4 || fields.size() >= 7 || !isNumber(fields.front())) && holdsNames(rows, layout) ? 1 : 0;
    if (fields.size() < begin + 3) {
        const bool one = fields.size() == 1;
        out.error("points.columns",
                  one ? "one column is too few for x, y, z; commas, semicolons, tabs, bars or blanks separate columns"
                      : fmt::format("{} columns are too few for x, y, z", fields.size()),
                  line);
        return false;
    }
    layout.position = {begin, begin + 1, begin + 2};
    std::size_t used = begin + 3;
    if (fields.size() >= used + 3 && holdsDirections(rows, used, layout)) {
        layout.direction = {used, used + 1, used + 2};
        used += 3;
    }
    if (fields.size() > used)
        out.warning(
            "points.unused-columns",
            fmt::format("the table has no header: columns {} to {} are taken as x, y, z; {} further columns are "
                        "not used; --columns says otherwise",
                        begin + 1, begin + 3, fields.size() - used),
            line);
    return true;
}

bool columnsFromOption(const std::string& text, std::uint64_t line, TableLayout& layout, PointCollector& out) {
    std::vector<std::string_view> names;
    splitFields(text, ',', names);
    for (const std::string_view name : names) {
        static const std::vector<std::string_view> known{"x", "y", "z", "i", "j", "k", "section", "weight", "id", "-"};
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        out.error("points.columns",
                  fmt::format("--columns: {} is none of x, y, z, i, j, k, section, weight, id, -", inQuotes(name)));
        return false;
    }
    std::replace(names.begin(), names.end(), std::string_view("id"), std::string_view());
    std::replace(names.begin(), names.end(), std::string_view("-"), std::string_view());
    layout.columns = names.size();
    return columnsFromNames(names, line, layout, out);
}

}  // namespace

bool isRemark(std::string_view line) {
    line = trimmed(line);
    return line.starts_with('#') || line.starts_with("//") || line.starts_with('%') || line.starts_with('!');
}

std::optional<TableLayout> findLayout(const std::vector<std::string_view>& lines,
                                      const std::vector<std::uint64_t>& line_numbers, const PointReaderOptions& options,
                                      PointCollector& out) {
    TableLayout layout;
    // A header is a first line in which nothing is a number.
    std::vector<std::string_view> names;
    layout.separator = findSeparator(lines, Lines(lines.begin() + (hasLetter(lines.front()) ? 1 : 0), lines.end()));
    splitFields(lines.front(), layout.separator, names);
    layout.has_header = std::none_of(names.begin(), names.end(), isNumber) && hasLetter(lines.front());
    const Lines rows(lines.begin() + (layout.has_header ? 1 : 0), lines.end());
    if (rows.empty()) {
        out.error("points.empty", "the table has a header and no rows", line_numbers.front());
        return std::nullopt;
    }
    if (layout.separator == ',' && !layout.has_header && commasAreAmbiguous(rows, options)) {
        out.error("points.ambiguous-comma",
                  "the commas can separate six whole numbers or be the decimal marks of three; say --decimal point, or "
                  "separate the columns by semicolons",
                  line_numbers.front());
        return std::nullopt;
    }
    layout.decimal =
        options.decimal ? *options.decimal : (layout.separator == ',' ? '.' : findDecimal(rows, layout.separator));
    if (layout.separator == ',' && layout.decimal == ',') {
        out.error("points.ambiguous-comma", "the comma cannot both separate columns and be the decimal mark",
                  line_numbers.front());
        return std::nullopt;
    }
    layout.columns = names.size();
    const bool found = !options.columns.empty() ? columnsFromOption(options.columns, line_numbers.front(), layout, out)
                       : layout.has_header      ? columnsFromNames(names, line_numbers.front(), layout, out)
                                                : columnsFromNumbers(rows, line_numbers.front(), layout, out);
    if (!found) return std::nullopt;
    return layout;
}

}  // namespace cusp::inspect
