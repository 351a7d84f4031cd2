// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A program as words with numbers, so that it can be harmed word by word and run without reading any text.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::post::verify::test {

/// An address with its value, or a word that stands alone (TRAORI, MCALL).
struct NcWord {
    std::string address;
    std::optional<double> value;
    int decimals = 0;
};

struct NcBlock {
    std::vector<NcWord> words;
    std::string cycle;                             ///< CYCLE81 … with `arguments`, behind the words
    std::vector<std::optional<double>> arguments;  ///< the second of CYCLE800 is a text, here 1 for "TC"
    bool link = false;                             ///< a way the CL file does not know: home, approach

    [[nodiscard]] bool has(std::string_view address) const;
    /// Whether it has the word with this value: G1, M3.
    [[nodiscard]] bool has(std::string_view address, double value) const;
    [[nodiscard]] std::optional<double> value(std::string_view address) const;
};

/// "G1 X-3.50000 F800"; a multi-letter address or one with a number takes an equals sign.
[[nodiscard]] std::string toText(const NcBlock& block);
/// With block numbers.
[[nodiscard]] std::string toText(const std::vector<NcBlock>& blocks);

}  // namespace cusp::post::verify::test
