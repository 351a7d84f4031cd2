// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// XML as a stream of records: the elements that a list of QIF holds, each with its texts by path.
#pragma once

#include <cusp/base/result.hpp>

#include <cstddef>
#include <istream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cusp::inspect::qif {

/// One element of a list, e.g. a DiameterCharacteristicItem of CharacteristicItems.
struct Record {
    std::string list;  ///< the list's element
    std::string kind;  ///< the element itself
    std::string id;
    std::string count;
    std::size_t line = 0;
    /// Texts of the leaves below it: {"Tolerance/MaxValue", "0.5"}, in the order of the file.
    std::vector<std::pair<std::string, std::string>> texts;
    std::vector<double> points;   ///< the numbers of its Points
    std::vector<double> normals;  ///< and Normals

    /// The first text at `path`; empty when there is none.
    [[nodiscard]] std::string_view text(std::string_view path) const;
};

/// What a document is told to.
class RecordTaker {
public:
    virtual ~RecordTaker() = default;
    virtual void root(const std::string& name, const std::string& version, std::size_t line) = 0;
    /// An element that is no list and in no record begins.
    virtual void begin(const std::string& name) = 0;
    virtual void take(const Record& record) = 0;
    /// A leaf outside of records, by its whole path below the root.
    virtual void leaf(const std::string& path, const std::string& text, std::size_t line) = 0;
    /// Nothing more is wanted after an error.
    [[nodiscard]] virtual bool failed() const = 0;
};

/// Reads the stream to its end. Problems are added to `report`: `qif.xml`, `qif.doctype`, `qif.large`, `qif.number` (in a
/// list of numbers), `io.read`.
void readRecords(std::istream& in, const std::string& name, RecordTaker& taker, base::Diagnostics& report);

}  // namespace cusp::inspect::qif
