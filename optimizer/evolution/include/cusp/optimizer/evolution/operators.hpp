// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The genetic operators on bit strings, each on its own.
#pragma once

#include <cusp/base/random.hpp>
#include <cusp/optimizer/evolution/encoding.hpp>

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace cusp::optimizer {

/// `length` fair coin tosses.
[[nodiscard]] Bits randomBits(std::size_t length, base::Random& random);

/// An index with probability proportional to its fitness (≥ 0, finite); every index alike where all are zero.
[[nodiscard]] std::size_t selectByRoulette(std::span<const double> fitness, base::Random& random);
/// The best (smallest objective; of equals the first drawn) of `size` indices drawn with replacement.
[[nodiscard]] std::size_t selectByTournament(std::span<const double> objectives, std::size_t size,
                                             base::Random& random);
/// Indices of the `count` smallest objectives, best first; of equals the lower index.
[[nodiscard]] std::vector<std::size_t> eliteOf(std::span<const double> objectives, std::size_t count);

/// The tails behind bit `cut` (0 < cut < length) change sides.
void crossAt(Bits& a, Bits& b, std::size_t cut);
/// `crossAt` at a random cut; nothing for strings of one bit. Fountas 2017.
void crossSinglePoint(Bits& a, Bits& b, base::Random& random);
/// The part between two random cuts changes sides.
void crossTwoPoint(Bits& a, Bits& b, base::Random& random);
/// Every bit changes sides with probability ½.
void crossUniform(Bits& a, Bits& b, base::Random& random);

/// One random bit is turned. Fountas 2017.
void mutateSinglePoint(Bits& bits, base::Random& random);
/// Every bit is turned with probability `probability`.
void mutatePerBit(Bits& bits, double probability, base::Random& random);

}  // namespace cusp::optimizer
