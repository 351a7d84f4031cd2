// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Seeded random numbers that are the same bytes with every compiler and standard library.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace cusp::base {

/// One step of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators", fig. 16): advances
/// `state` and returns the next output. Also a good mixing function: every input bit reaches every output bit.
[[nodiscard]] std::uint64_t splitMix64(std::uint64_t& state);

/// xoshiro256** 1.0 (Blackman, Vigna 2021, "Scrambled linear pseudorandom number generators", ACM TOMS 47(4)), period
/// 2^256 - 1, seeded through SplitMix64 as its authors advise.
///
/// std:: distributions differ between standard libraries and std::log between maths libraries, so everything here is
/// made of IEEE additions, multiplications, divisions and square roots only.
class Random {
public:
    explicit Random(std::uint64_t seed);
    /// The generator in a given state, not all zero: for tests against the authors' reference output.
    [[nodiscard]] static Random fromState(const std::array<std::uint64_t, 4>& state);

    [[nodiscard]] std::uint64_t next();
    /// In [0, 1), on a grid of 2^-53.
    [[nodiscard]] double uniform();
    /// In [low, high); `low` when the two are equal.
    [[nodiscard]] double uniform(double low, double high);
    /// In 0 … n - 1, every value equally likely; 0 for n = 0.
    [[nodiscard]] std::uint64_t below(std::uint64_t n);
    /// In low … high, both included, every value equally likely; needs low <= high.
    [[nodiscard]] std::int64_t integer(std::int64_t low, std::int64_t high);
    /// True with the given probability; never for 0, always for 1.
    [[nodiscard]] bool chance(double probability) { return uniform() < probability; }
    /// Standard normal deviate (Marsaglia's polar method).
    [[nodiscard]] double normal();
    [[nodiscard]] double normal(double mean, double standard_deviation);

    /// Fisher–Yates; `items` is anything with size() and operator[].
    template <class Items>
    void shuffle(Items& items) {
        for (std::size_t i = items.size(); i > 1; --i) {
            using std::swap;
            swap(items[i - 1], items[static_cast<std::size_t>(below(i))]);
        }
    }

    /// Advances by 2^128 steps: streams that start one jump apart never meet.
    void jump();
    /// A generator of its own for part `index` of the work (a thread, an individual, a start), derived from the present
    /// state, which stays as it is. Give each part its index, not its thread, and the result does not depend on threads.
    [[nodiscard]] Random split(std::uint64_t index) const;

    [[nodiscard]] const std::array<std::uint64_t, 4>& state() const { return state_; }

private:
    Random() = default;
    std::array<std::uint64_t, 4> state_{};
    double spare_normal_ = 0.0;
    bool has_spare_normal_ = false;
};

}  // namespace cusp::base
