// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Transduction, reverse transcription, infectivity.
#include <cusp/optimizer/evolution/virus.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace cusp::optimizer {
namespace {

constexpr double largest_gain = std::numeric_limits<double>::max();

std::size_t between(std::size_t low, std::size_t high, base::Random& random) {
    return low + static_cast<std::size_t>(random.below(high - low + 1));
}

Bits part(const Bits& host, std::size_t locus, std::size_t length) {
    const auto begin = host.begin() + static_cast<std::ptrdiff_t>(locus);
    return {begin, begin + static_cast<std::ptrdiff_t>(length)};
}

std::size_t longestIn(const Bits& host, const VirusOptions& options) { return std::min(options.longest, host.size()); }

}  // namespace

Virus transduce(const Bits& host, const VirusOptions& options, base::Random& random) {
    const std::size_t longest = longestIn(host, options);
    const std::size_t length = between(std::min(options.shortest, longest), longest, random);
    Virus out;
    out.locus = between(0, host.size() - length, random);
    out.bits = part(host, out.locus, length);
    out.infection_rate = options.infection_rate;
    return out;
}

void transducePartially(Virus& virus, const Bits& host, const VirusOptions& options, base::Random& random) {
    const std::size_t length = virus.bits.size();
    const std::size_t longest = longestIn(host, options);
    if (length >= longest) {
        const std::size_t count = between(1, length, random);
        const std::size_t first = between(0, length - count, random);
        std::copy_n(host.begin() + static_cast<std::ptrdiff_t>(virus.locus + first), count,
                    virus.bits.begin() + static_cast<std::ptrdiff_t>(first));
        return;
    }
    const std::size_t grown = between(length + 1, longest, random);
    // The window of the grown virus covers the old one and stays on the chromosome.
    const std::size_t earliest = virus.locus + length > grown ? virus.locus + length - grown : 0;
    const std::size_t latest = std::min(virus.locus, host.size() - grown);
    const std::size_t locus = between(earliest, latest, random);
    Bits bits = part(host, locus, grown);
    std::copy(virus.bits.begin(), virus.bits.end(), bits.begin() + static_cast<std::ptrdiff_t>(virus.locus - locus));
    virus.locus = locus;
    virus.bits = std::move(bits);
}

Bits reverseTranscribe(const Bits& host, const Virus& virus) {
    Bits out = host;
    std::copy(virus.bits.begin(), virus.bits.end(), out.begin() + static_cast<std::ptrdiff_t>(virus.locus));
    return out;
}

double infectionGain(double objective_before, double objective_after) {
    if (objective_before == objective_after) return 0.0;
    return std::clamp(objective_before - objective_after, -largest_gain, largest_gain);
}

double virusFitness(std::span<const double> gains) {
    double sum = 0.0;
    for (const double gain : gains) sum = std::clamp(sum + gain, -largest_gain, largest_gain);
    return sum;
}

VirusFate updateInfectivity(Virus& virus, double fitness, const VirusOptions& options) {
    const double change = fitness > 0.0 ? 1.0 + options.rate_adaptation : 1.0 - options.rate_adaptation;
    virus.infection_rate =
        std::clamp(virus.infection_rate * change, options.min_infection_rate, options.max_infection_rate);
    const double before = virus.force;
    virus.force = virusFitness(std::vector<double>{options.infectivity_force * before, fitness});
    if (virus.force < before || virus.force <= 0.0) return VirusFate::Renew;
    return virus.force > before ? VirusFate::Grow : VirusFate::Keep;
}

}  // namespace cusp::optimizer
