// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Seeded axis positions for the law suite, the awkward ones as often as the plain ones.
#pragma once

#include <cusp/base/random.hpp>
#include <cusp/kinematics/machine.hpp>

#include <cstdint>

namespace cusp::kinematics {

class PoseSampler {
public:
    PoseSampler(const Machine& machine, std::uint64_t seed) : machine_(machine), random_(seed) {}

    /// Positions within all limits. In turn: anywhere; at an end of travel; at a multiple of 90° and close to it; at the
    /// pole and from 1e-15 to 1e-1 rad beside it.
    [[nodiscard]] AxisValues next();
    [[nodiscard]] double toolLength();
    /// Uniform on the sphere.
    [[nodiscard]] Vector3 direction();
    [[nodiscard]] double uniform(double low, double high) { return random_.uniform(low, high); }

private:
    [[nodiscard]] double rotaryPosition(std::size_t i, std::uint64_t kind);
    void moveToPole(AxisValues& values);

    const Machine& machine_;
    base::Random random_;
    std::uint64_t count_ = 0;
};

}  // namespace cusp::kinematics
