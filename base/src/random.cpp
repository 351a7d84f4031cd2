// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// xoshiro256** and what is drawn from it.
#include <cusp/base/random.hpp>

#include <bit>
#include <cmath>
#include <numbers>

namespace cusp::base {
namespace {

__extension__ using Wide = unsigned __int128;

/// Natural logarithm of x in (0, 1] from basic arithmetic alone: ln m = 2 artanh((m - 1) / (m + 1)) for m within a factor
/// √2 of 1, where 12 terms of the series leave less than 1e-20.
double portableLog(double x) {
    int exponent = 0;
    double mantissa = std::frexp(x, &exponent);  // exact
    if (mantissa < std::numbers::sqrt2 / 2.0) {
        mantissa *= 2.0;
        --exponent;
    }
    const double t = (mantissa - 1.0) / (mantissa + 1.0);
    const double t2 = t * t;
    double sum = 0.0;
    for (int k = 23; k >= 1; k -= 2) sum = sum * t2 + 1.0 / k;
    return 2.0 * t * sum + exponent * std::numbers::ln2;
}

}  // namespace

std::uint64_t splitMix64(std::uint64_t& state) {
    state += 0x9e3779b97f4a7c15U;
    std::uint64_t z = state;
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}

Random::Random(std::uint64_t seed) {
    for (std::uint64_t& word : state_) word = splitMix64(seed);
}

Random Random::fromState(const std::array<std::uint64_t, 4>& state) {
    Random out;
    out.state_ = state;
    return out;
}

std::uint64_t Random::next() {
    const std::uint64_t result = std::rotl(state_[1] * 5U, 7) * 9U;
    const std::uint64_t shifted = state_[1] << 17U;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= shifted;
    state_[3] = std::rotl(state_[3], 45);
    return result;
}

double Random::uniform() { return static_cast<double>(next() >> 11U) * 0x1.0p-53; }

double Random::uniform(double low, double high) {
    const double value = low + (high - low) * uniform();
    // Rounding may reach the open end; the closed one is always allowed.
    return value < high ? value : low;
}

std::uint64_t Random::below(std::uint64_t n) {
    if (n == 0) return 0;
    // Lemire 2019, "Fast random integer generation in an interval", ACM TOMACS 29(1), algorithm 5.
    Wide product = Wide{next()} * n;
    auto low = static_cast<std::uint64_t>(product);
    if (low < n) {
        const std::uint64_t threshold = (0U - n) % n;
        while (low < threshold) {
            product = Wide{next()} * n;
            low = static_cast<std::uint64_t>(product);
        }
    }
    return static_cast<std::uint64_t>(product >> 64U);
}

std::int64_t Random::integer(std::int64_t low, std::int64_t high) {
    const std::uint64_t span = static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low);
    const std::uint64_t offset = span == UINT64_MAX ? next() : below(span + 1);
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(low) + offset);
}

double Random::normal() {
    if (has_spare_normal_) {
        has_spare_normal_ = false;
        return spare_normal_;
    }
    double u = 0.0;
    double v = 0.0;
    double square = 0.0;
    do {
        u = 2.0 * uniform() - 1.0;
        v = 2.0 * uniform() - 1.0;
        square = u * u + v * v;
    } while (square >= 1.0 || square == 0.0);
    const double scale = std::sqrt(-2.0 * portableLog(square) / square);
    spare_normal_ = v * scale;
    has_spare_normal_ = true;
    return u * scale;
}

double Random::normal(double mean, double standard_deviation) { return mean + standard_deviation * normal(); }

void Random::jump() {
    // The authors' polynomial for 2^128 steps.
    constexpr std::array<std::uint64_t, 4> polynomial{0x180ec6d33cfd0abaU, 0xd5a61266f0c9392cU, 0xa9582618e03fc9aaU,
                                                      0x39abdc4529b1661cU};
    std::array<std::uint64_t, 4> sum{};
    for (const std::uint64_t word : polynomial)
        for (unsigned bit = 0; bit < 64; ++bit) {
            if (((word >> bit) & 1U) != 0)
                for (std::size_t i = 0; i < sum.size(); ++i) sum[i] ^= state_[i];
            static_cast<void>(next());
        }
    state_ = sum;
    has_spare_normal_ = false;
}

Random Random::split(std::uint64_t index) const {
    std::uint64_t seed = index;
    for (const std::uint64_t word : state_) {
        seed ^= word;
        seed = splitMix64(seed);
    }
    return Random(seed);
}

}  // namespace cusp::base
