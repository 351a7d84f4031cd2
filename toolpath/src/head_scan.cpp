// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The look-ahead: a light scan by lines that reports nothing; the reader proper judges every statement later.
#include "head_scan.hpp"

#include "fields.hpp"
#include "statement.hpp"

#include <cusp/base/units.hpp>

namespace cusp::toolpath::detail {

std::optional<LengthUnit> lengthUnitFromWord(std::string_view word) {
    if (equalsWord(word, "MM")) {
        return LengthUnit::Millimetre;
    }
    if (equalsWord(word, "INCH") || equalsWord(word, "INCHES") || equalsWord(word, "IN")) {
        return LengthUnit::Inch;
    }
    return std::nullopt;
}

std::optional<LengthUnit> lengthUnitFromFeedWord(std::string_view word) {
    if (equalsWord(word, "MMPM") || equalsWord(word, "MMPR")) {
        return LengthUnit::Millimetre;
    }
    if (equalsWord(word, "IPM") || equalsWord(word, "IPR")) {
        return LengthUnit::Inch;
    }
    return std::nullopt;
}

double mmPerUnitOf(LengthUnit unit) { return unit == LengthUnit::Inch ? base::mm_per_inch : 1.0; }

namespace {

std::optional<Dialect> dialectOfComment(std::string_view comment) {
    for (const DialectTraits& traits : allDialects()) {
        for (const std::string_view signature : traits.signature_comments) {
            if (startsWithWord(trimmed(comment), signature)) {
                return traits.dialect;
            }
        }
    }
    return std::nullopt;
}

std::optional<Dialect> dialectOfWord(std::string_view word) {
    for (const DialectTraits& traits : allDialects()) {
        for (const std::string_view signature : traits.signature_words) {
            if (word == signature) {
                return traits.dialect;
            }
        }
    }
    return std::nullopt;
}

class HeadScan {
public:
    void line(std::string_view text) {
        if (text.substr(0, 2) == "$$") {
            if (!findings_.dialect) {
                findings_.dialect = dialectOfComment(text.substr(2));
            }
            return;
        }
        const StatementHead head(text);
        if (!findings_.dialect) {
            findings_.dialect = dialectOfWord(head.word());
        }
        if (head.word() == "GOTO") {
            motion_seen_ = true;
        } else if (head.word() == "UNITS" || head.word() == "UNIT") {
            takeUnit(head.body());
        } else if ((head.word() == "FEDRAT" || head.word() == "CYCLE") && !findings_.implied) {
            takeFeed(head.body());
        }
    }
    [[nodiscard]] const HeadFindings& findings() const { return findings_; }
    [[nodiscard]] bool done() const {
        return findings_.dialect && (findings_.stated || (findings_.implied && motion_seen_));
    }

private:
    void takeUnit(std::string_view body) {
        const Fields fields(body);
        const std::optional<LengthUnit> unit = fields.empty() ? std::nullopt : lengthUnitFromWord(fields[0].text);
        if (!motion_seen_ && !findings_.stated) {
            findings_.stated = unit;
        } else if (!findings_.implied) {
            findings_.implied = unit;
        }
    }
    void takeFeed(std::string_view body) {
        for (const Field& field : Fields(body)) {
            if (const std::optional<LengthUnit> unit = lengthUnitFromFeedWord(field.text)) {
                findings_.implied = unit;
                return;
            }
        }
    }

    HeadFindings findings_;
    bool motion_seen_ = false;
};

}  // namespace

HeadFindings scanHead(std::string_view head) {
    HeadScan scan;
    while (!head.empty() && !scan.done()) {
        const std::size_t newline = head.find('\n');
        scan.line(trimmed(head.substr(0, newline)));
        head.remove_prefix(newline == std::string_view::npos ? head.size() : newline + 1);
    }
    return scan.findings();
}

}  // namespace cusp::toolpath::detail
