// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Binary chromosomes: genes of so many bits each, and what they decode to.
#pragma once

#include <cusp/base/result.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace cusp::optimizer {

/// A chromosome: one element a bit, 0 or 1, gene after gene, each gene's most significant bit first.
using Bits = std::vector<std::uint8_t>;

/// A decoded candidate: one number per gene, in the unit of the gene.
using Values = std::vector<double>;

/// A parameter that is searched for. `choices` = 0 is a continuous one on the grid of eq. 8, `bits` fine. Otherwise it takes
/// `choices` equally spaced values from `lower` to `upper` (0 … 8 with 9 choices: an index), and bit strings beyond the
/// choices share them evenly: several chromosomes are one candidate then.
struct Gene {
    std::string name;
    int bits = 16;  ///< 1 … 52
    double lower = 0.0;
    double upper = 1.0;
    std::int64_t choices = 0;
};

/// How a gene's bits are a number. Neighbouring numbers differ by one bit in the reflected Gray code; in plain binary,
/// which Fountas 2017 uses, by up to all of them (the "cliff" between 0111… and 1000…).
enum class Coding { Binary, Gray };

/// The genes of a problem, checked. Fountas 2017 eq. 5–8; eq. 8 is x = lower + code · (upper − lower) / (2^bits − 1).
class Encoding {
public:
    /// Errors, each with the gene's name as key: `evolution.no-genes`, `evolution.bits`, `evolution.empty-range`,
    /// `evolution.choices` (more than 2^bits of them, or a negative number), `evolution.duplicate-gene`.
    [[nodiscard]] static base::Result<Encoding> create(std::vector<Gene> genes, Coding coding = Coding::Binary);

    [[nodiscard]] const std::vector<Gene>& genes() const { return genes_; }
    [[nodiscard]] Coding coding() const { return coding_; }
    /// Bits of a whole chromosome.
    [[nodiscard]] std::size_t length() const { return length_; }
    /// Number of distinct decoded candidates; infinity where a double cannot hold it.
    [[nodiscard]] double candidateCount() const;

    /// One whole number per gene, which is what tells candidates apart: two chromosomes with the same codes decode alike.
    [[nodiscard]] std::vector<std::uint64_t> codes(const Bits& bits) const;
    [[nodiscard]] Values values(std::span<const std::uint64_t> codes) const;
    [[nodiscard]] Values decode(const Bits& bits) const { return values(codes(bits)); }
    /// A chromosome that decodes to the grid value nearest to each of `values`.
    [[nodiscard]] Bits encode(const Values& values) const;
    /// The largest code of gene `gene`.
    [[nodiscard]] std::uint64_t largestCode(std::size_t gene) const;

private:
    Encoding(std::vector<Gene> genes, Coding coding);

    std::vector<Gene> genes_;
    Coding coding_;
    std::size_t length_ = 0;
};

}  // namespace cusp::optimizer
