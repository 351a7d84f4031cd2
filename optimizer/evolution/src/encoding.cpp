// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Genes checked, decoded and encoded.
#include <cusp/optimizer/evolution/encoding.hpp>

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <set>

namespace cusp::optimizer {
namespace {

constexpr int most_bits = 52;

__extension__ using Wide = unsigned __int128;

std::uint64_t patterns(const Gene& gene) { return std::uint64_t{1} << static_cast<unsigned>(gene.bits); }

void checkGene(const Gene& gene, base::Diagnostics& report) {
    const base::Location where{.file = {}, .line = 0, .column = 0, .key = gene.name};
    if (gene.bits < 1 || gene.bits > most_bits) {
        report.error("evolution.bits", fmt::format("{} bits; a gene has 1 to {}", gene.bits, most_bits), where);
        return;
    }
    const bool single = gene.choices == 1 && gene.lower == gene.upper;
    if (!single && !(std::isfinite(gene.lower) && std::isfinite(gene.upper) && gene.lower < gene.upper))
        report.error("evolution.empty-range",
                     fmt::format("the range {} to {} is empty; the lower limit must be below the upper one", gene.lower,
                                 gene.upper),
                     where);
    if (gene.choices < 0 || static_cast<std::uint64_t>(gene.choices) > patterns(gene))
        report.error("evolution.choices",
                     fmt::format("{} choices do not fit in {} bits, which tell {} apart", gene.choices, gene.bits,
                                 patterns(gene)),
                     where);
}

std::uint64_t fromGray(std::uint64_t gray) {
    for (unsigned shift = 32; shift > 0; shift /= 2) gray ^= gray >> shift;
    return gray;
}

std::uint64_t toGray(std::uint64_t code) { return code ^ (code >> 1U); }

/// The choice that pattern `code` stands for: patterns in order, shared evenly.
std::uint64_t choiceOf(const Gene& gene, std::uint64_t code) {
    const Wide scaled = Wide{code} * static_cast<std::uint64_t>(gene.choices);
    return static_cast<std::uint64_t>(scaled >> static_cast<unsigned>(gene.bits));
}

/// The first pattern that stands for choice `choice`.
std::uint64_t patternOf(const Gene& gene, std::uint64_t choice) {
    const auto choices = static_cast<std::uint64_t>(gene.choices);
    return static_cast<std::uint64_t>(((Wide{choice} << static_cast<unsigned>(gene.bits)) + choices - 1) / choices);
}

}  // namespace

base::Result<Encoding> Encoding::create(std::vector<Gene> genes, Coding coding) {
    base::Diagnostics report;
    if (genes.empty()) report.error("evolution.no-genes", "there is nothing to search for: no gene is given");
    std::set<std::string> names;
    for (const Gene& gene : genes) {
        checkGene(gene, report);
        if (!names.insert(gene.name).second)
            report.error("evolution.duplicate-gene", "two genes have this name",
                         {.file = {}, .line = 0, .column = 0, .key = gene.name});
    }
    if (report.hasErrors()) return base::fail(std::move(report));
    return Encoding(std::move(genes), coding);
}

Encoding::Encoding(std::vector<Gene> genes, Coding coding) : genes_(std::move(genes)), coding_(coding) {
    for (const Gene& gene : genes_) length_ += static_cast<std::size_t>(gene.bits);
}

std::uint64_t Encoding::largestCode(std::size_t gene) const {
    const Gene& g = genes_[gene];
    return g.choices > 0 ? static_cast<std::uint64_t>(g.choices) - 1 : patterns(g) - 1;
}

double Encoding::candidateCount() const {
    double count = 1.0;
    for (std::size_t g = 0; g < genes_.size(); ++g) count *= static_cast<double>(largestCode(g)) + 1.0;
    return count;
}

std::vector<std::uint64_t> Encoding::codes(const Bits& bits) const {
    std::vector<std::uint64_t> out;
    out.reserve(genes_.size());
    std::size_t at = 0;
    for (const Gene& gene : genes_) {
        std::uint64_t code = 0;
        for (int b = 0; b < gene.bits; ++b) code = (code << 1U) | bits[at++];
        if (coding_ == Coding::Gray) code = fromGray(code);
        out.push_back(gene.choices > 0 ? choiceOf(gene, code) : code);
    }
    return out;
}

Values Encoding::values(std::span<const std::uint64_t> codes) const {
    Values out;
    out.reserve(genes_.size());
    for (std::size_t g = 0; g < genes_.size(); ++g) {
        const Gene& gene = genes_[g];
        const std::uint64_t largest = largestCode(g);
        const double step = largest == 0 ? 0.0 : (gene.upper - gene.lower) / static_cast<double>(largest);
        out.push_back(codes[g] == largest ? gene.upper : gene.lower + static_cast<double>(codes[g]) * step);
    }
    return out;
}

Bits Encoding::encode(const Values& values) const {
    Bits out;
    out.reserve(length_);
    for (std::size_t g = 0; g < genes_.size(); ++g) {
        const Gene& gene = genes_[g];
        const auto largest = static_cast<double>(largestCode(g));
        const double share =
            gene.upper > gene.lower ? std::clamp((values[g] - gene.lower) / (gene.upper - gene.lower), 0.0, 1.0) : 0.0;
        auto code = static_cast<std::uint64_t>(std::floor(share * largest + 0.5));
        if (gene.choices > 0) code = patternOf(gene, code);
        if (coding_ == Coding::Gray) code = toGray(code);
        for (int b = gene.bits - 1; b >= 0; --b)
            out.push_back(static_cast<std::uint8_t>((code >> static_cast<unsigned>(b)) & 1U));
    }
    return out;
}

}  // namespace cusp::optimizer
