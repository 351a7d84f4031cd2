// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The laws every machine must obey, checked on thousands of seeded poses, and the poses known from outside.
#pragma once

#include <cusp/kinematics/machine.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace cusp::kinematics {

/// One law and the pose that came closest to breaking it.
struct Law {
    std::string name;  ///< "tip after inverse and forward", …
    std::string unit;  ///< of `worst` and `bound`: "mm", "rad", or "" for counts
    double worst = 0.0;
    double bound = 0.0;
    std::uint64_t checked = 0;  ///< how many times the law was put to the test
    AxisValues worst_pose;      ///< the axis positions the worst case was made from

    [[nodiscard]] bool passes() const { return checked > 0 && worst <= bound; }
};

struct LawReport {
    std::uint64_t seed = 0;
    std::uint64_t poses = 0;
    std::vector<Law> laws;

    [[nodiscard]] bool passes() const;
};

/// Checks that inverse and forward kinematics undo each other, that every branch is found (against a grid and Newton
/// search that knows nothing of the closed form), that limits are respected, and that an axis out of reach is missed by
/// the angle stated. The poses include the pole and its neighbourhood, ±180° and the ends of every axis' travel. The
/// same seed gives the same report.
[[nodiscard]] LawReport runLaws(const Machine& machine, std::uint64_t seed, std::uint64_t poses);

/// A pose from outside and how far the model is from it.
struct AnchorReport {
    std::string source;
    double error_rad = 0.0;
    double tolerance_rad = 0.0;

    [[nodiscard]] bool passes() const { return error_rad <= tolerance_rad; }
};

/// The machine's anchors, in file order. A machine without any is unanchored: no law can see a wrong sign in it.
[[nodiscard]] std::vector<AnchorReport> checkAnchors(const Machine& machine);

}  // namespace cusp::kinematics
