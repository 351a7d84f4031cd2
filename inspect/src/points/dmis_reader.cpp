// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// DMIS output (ISO 22093): actual points FA(…)=FEAT/POINT,CART,… and raw PTDATA/CART,….
#include "points/formats.hpp"
#include "points/point_text.hpp"

#include <cusp/base/number_text.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <fmt/format.h>
#include <map>

namespace cusp::inspect {
namespace {

/// A statement may go on over lines that end in a single '$'; "$$" begins a remark.
class StatementReader {
public:
    explicit StatementReader(ByteSource& source) : source_(source) {}

    bool next(std::string& statement, std::uint64_t& line) {
        statement.clear();
        for (std::string_view text; source_.nextLine(text);) {
            const std::size_t remark = text.find("$$");
            if (remark != std::string_view::npos) text = text.substr(0, remark);
            text = trimmed(text);
            if (statement.empty()) line = source_.lineNumber();
            const bool continued = text.ends_with('$');
            if (continued) text = text.substr(0, text.size() - 1);
            statement += text;
            if (!continued && !statement.empty()) return true;
        }
        return !statement.empty();
    }

private:
    ByteSource& source_;
};

class DmisReader {
public:
    explicit DmisReader(PointCollector& out) : out_(out) {}

    void take(std::string_view statement, std::uint64_t line) {
        const std::size_t equals = statement.find('=');
        const std::string_view body =
            equals == std::string_view::npos ? statement : trimmed(statement.substr(equals + 1));
        const std::size_t slash = body.find('/');
        const std::string major = lowered(trimmed(body.substr(0, slash)));
        splitFields(slash == std::string_view::npos ? std::string_view() : body.substr(slash + 1), ',', fields_);
        if (major == "units") return takeUnit(line);
        if (major == "prcomp") return takeCompensation();
        if (major == "ptdata") return takePoint(0, line);
        if (major == "feat" && isPoint()) {
            // F(…) is the nominal, FA(…) the actual.
            if (startsWithWord(statement, "FA(")) return takePoint(1, line);
            ++nominals_;
            return;
        }
        if (major == "feat") return void(++others_["FEAT/" + (fields_.empty() ? "" : std::string(fields_[0]))]);
        ++others_[std::string(trimmed(body.substr(0, slash)))];
    }

    void finish() {
        if (out_.size() == 0 && nominals_ > 0 && !out_.hasErrors())
            return out_.error("points.empty", fmt::format("the file has {} nominal points F(…) and no actual FA(…) or "
                                                          "PTDATA: it is a program, not its output",
                                                          nominals_));
        std::string text;
        for (const auto& [word, count] : others_)
            text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", word, count);
        if (!text.empty()) out_.note("points.other-statements", "statements that say no point: " + text);
    }

private:
    bool isPoint() const { return !fields_.empty() && lowered(fields_[0]) == "point"; }

    void takeUnit(std::uint64_t line) {
        const auto length = fields_.empty() ? std::nullopt : unitLength(fields_[0]);
        if (!length)
            return out_.error("points.unit",
                              fmt::format("UNITS/{}: this unit is not known", fields_.empty() ? "" : fields_[0]), line);
        if (out_.size() > 0) return out_.error("points.unit", "UNITS between points: one file, one unit", line);
        out_.unit(*length);
    }

    void takeCompensation() {
        if (fields_.empty()) return;
        out_.kind(lowered(fields_[0]) == "off" ? PointKind::Centre : PointKind::Surface);
    }

    /// `first`: the field with CART.
    void takePoint(std::size_t first, std::uint64_t line) {
        if (fields_.size() <= first || lowered(fields_[first]) != "cart")
            return out_.error("points.format", "only points in Cartesian coordinates (CART) are read", line);
        std::array<double, 6> values{};
        const std::size_t count = std::min<std::size_t>(fields_.size() - first - 1, 6);
        if (count < 3) return out_.error("points.columns", "a point needs three coordinates", line);
        for (std::size_t i = 0; i < count; ++i) {
            const auto value = base::parseDouble(fields_[first + 1 + i]);
            if (!value)
                return out_.error("points.number", fmt::format("{} is no number", inQuotes(fields_[first + 1 + i])),
                                  line);
            values.at(i) = *value;
        }
        out_.add(line, {values[0], values[1], values[2]});
        if (count == 6) out_.direction({values[3], values[4], values[5]});
    }

    PointCollector& out_;
    std::vector<std::string_view> fields_;
    std::map<std::string, int> others_;
    int nominals_ = 0;
};

}  // namespace

void readDmis(ByteSource& source, PointCollector& out) {
    out.format("dmis");
    DmisReader reader(out);
    StatementReader statements(source);
    std::string statement;
    std::uint64_t line = 0;
    while (statements.next(statement, line)) reader.take(statement, line);
    reader.finish();
}

}  // namespace cusp::inspect
