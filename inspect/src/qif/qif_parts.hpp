// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Elements that every QIF 3.0 document of ours has.
#pragma once

#include <string>
#include <string_view>

namespace cusp::inspect {

/// Text as XML 1.0 can say it.
[[nodiscard]] std::string qifEscaped(std::string_view text);
/// To a picometre: xs:decimal knows no exponent.
[[nodiscard]] std::string qifDecimal(double value);

/// The root's beginning and the Header. `digest` is the SHA-256 of the content in hexadecimals: the identity is made from it
/// (RFC 9562, version 8). `comments` are lines of XML before the root, or empty.
[[nodiscard]] std::string qifHead(std::string digest, int last_id, std::string_view comments);
/// FileUnits: mm and radians.
[[nodiscard]] std::string qifUnits();

/// A surface as a feature of no named form: definition, nominal and item.
struct QifFeatureIds {
    int definition = 0;
    int nominal = 0;
    int item = 0;
};
[[nodiscard]] std::string qifFeature(const QifFeatureIds& ids, std::string_view name);

}  // namespace cusp::inspect
