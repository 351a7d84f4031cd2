// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Viruses: parts of chromosomes that are copied into others, and what becomes of them (Fountas 2017 eq. 11–12, fig. 3).
#pragma once

#include <cusp/base/random.hpp>
#include <cusp/optimizer/evolution/encoding.hpp>

#include <cstddef>
#include <span>

namespace cusp::optimizer {

/// A part of a chromosome with the place it was cut from, where it is written again.
struct Virus {
    std::size_t locus = 0;  ///< of its first bit
    Bits bits;
    double infection_rate = 0.0;  ///< share of the population it attacks
    double force = 0.0;           ///< infectivity force of the generation before; 0 for a new virus
};

struct VirusOptions {
    std::size_t population = 2;
    std::size_t shortest = 1;
    std::size_t longest = 40;  ///< bits; never more than the chromosome has
    /// r in InfForce(g) = r · InfForce(g − 1) + FitVrs: what a virus inherits of the force it had.
    double infectivity_force = 0.001;
    double infection_rate = 0.1;  ///< at birth
    /// The interval the rate is kept in: 0 … 0.5 for global search, 0.5 … 1 for local search, in the paper's words.
    double min_infection_rate = 0.0;
    double max_infection_rate = 1.0;
    /// α: the rate of a virus that improved something becomes (1 + α) times itself, of one that did not (1 − α) times. 0: fixed.
    double rate_adaptation = 0.0;
    /// Share of the viruses cut from the elite; the others from any individual.
    double elite_share = 1.0;
    /// Infections happen after every so many generations.
    std::size_t interval = 1;
};

/// Transduction: a part of `host` between two random loci, `shortest` to `longest` bits long (fig. 3a).
[[nodiscard]] Virus transduce(const Bits& host, const VirusOptions& options, base::Random& random);

/// Partial transduction (fig. 3c): the virus takes over bits of `host` next to its own, growing by 1 … longest − length bits at
/// either end; at its longest, it takes over a random part of its own loci instead.
void transducePartially(Virus& virus, const Bits& host, const VirusOptions& options, base::Random& random);

/// Reverse transcription (fig. 3b): `host` with the virus written over it.
[[nodiscard]] Bits reverseTranscribe(const Bits& host, const Virus& virus);

/// Eq. 11 for an objective that is minimised: before − after, so that above zero is an improvement, as the paper's text has
/// it ("the improvement of fitness values"; printed is after − before, right for a fitness that is maximised). From ∞ to
/// finite counts as the largest finite improvement; from ∞ to ∞ as none.
[[nodiscard]] double infectionGain(double objective_before, double objective_after);

/// Eq. 12: Σ of the gains over the infected individuals.
[[nodiscard]] double virusFitness(std::span<const double> gains);

/// What the infectivity force asks for.
enum class VirusFate {
    Renew,  ///< the force fell or nothing was gained: a new virus by transduction
    Grow,   ///< it rose: partial transduction from an infected individual
    Keep,   ///< it is as before
};

/// Updates force and rate of a virus after its attacks of one generation.
[[nodiscard]] VirusFate updateInfectivity(Virus& virus, double fitness, const VirusOptions& options);

}  // namespace cusp::optimizer
