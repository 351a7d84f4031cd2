// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Selection, crossover and mutation of bit strings.
#include <cusp/optimizer/evolution/operators.hpp>

#include <algorithm>
#include <numeric>

namespace cusp::optimizer {

Bits randomBits(std::size_t length, base::Random& random) {
    Bits out(length);
    for (std::uint8_t& bit : out) bit = static_cast<std::uint8_t>(random.next() >> 63U);
    return out;
}

std::size_t selectByRoulette(std::span<const double> fitness, base::Random& random) {
    const double sum = std::accumulate(fitness.begin(), fitness.end(), 0.0);
    if (!(sum > 0.0)) return static_cast<std::size_t>(random.below(fitness.size()));
    double left = random.uniform() * sum;
    std::size_t last = 0;
    for (std::size_t i = 0; i < fitness.size(); ++i) {
        if (!(fitness[i] > 0.0)) continue;
        last = i;
        left -= fitness[i];
        if (left < 0.0) return i;
    }
    return last;  // rounding may leave a crumb
}

std::size_t selectByTournament(std::span<const double> objectives, std::size_t size, base::Random& random) {
    auto best = static_cast<std::size_t>(random.below(objectives.size()));
    for (std::size_t i = 1; i < size; ++i) {
        const auto other = static_cast<std::size_t>(random.below(objectives.size()));
        if (objectives[other] < objectives[best]) best = other;
    }
    return best;
}

std::vector<std::size_t> eliteOf(std::span<const double> objectives, std::size_t count) {
    std::vector<std::size_t> order(objectives.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return objectives[a] < objectives[b] || (objectives[a] == objectives[b] && a < b);
    });
    order.resize(std::min(count, order.size()));
    return order;
}

void crossAt(Bits& a, Bits& b, std::size_t cut) {
    std::swap_ranges(a.begin() + static_cast<std::ptrdiff_t>(cut), a.end(),
                     b.begin() + static_cast<std::ptrdiff_t>(cut));
}

void crossSinglePoint(Bits& a, Bits& b, base::Random& random) {
    if (a.size() < 2) return;
    crossAt(a, b, 1 + static_cast<std::size_t>(random.below(a.size() - 1)));
}

void crossTwoPoint(Bits& a, Bits& b, base::Random& random) {
    const auto first = static_cast<std::size_t>(random.below(a.size() + 1));
    const auto second = static_cast<std::size_t>(random.below(a.size() + 1));
    crossAt(a, b, std::min(first, second));
    crossAt(a, b, std::max(first, second));
}

void crossUniform(Bits& a, Bits& b, base::Random& random) {
    for (std::size_t i = 0; i < a.size(); ++i)
        if ((random.next() >> 63U) != 0) std::swap(a[i], b[i]);
}

void mutateSinglePoint(Bits& bits, base::Random& random) {
    bits[static_cast<std::size_t>(random.below(bits.size()))] ^= 1U;
}

void mutatePerBit(Bits& bits, double probability, base::Random& random) {
    for (std::uint8_t& bit : bits)
        if (random.chance(probability)) bit ^= 1U;
}

}  // namespace cusp::optimizer
