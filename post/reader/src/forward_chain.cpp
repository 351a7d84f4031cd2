// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Rotations and the product along the chain.
#include <cusp/post/reader/forward_chain.hpp>

namespace cusp::post::reader {

namespace {

Vector3 unit(const std::array<double, 3>& v) {
    const Vector3 vector{v[0], v[1], v[2]};
    const double length = norm(vector);
    return length > 0.0 ? (1.0 / length) * vector : Vector3{0.0, 0.0, 1.0};
}

}  // namespace

Vector3 rotated(const Vector3& v, const Vector3& axis, double angle_rad) {
    const double c = std::cos(angle_rad);
    const double s = std::sin(angle_rad);
    return c * v + s * cross(axis, v) + ((1.0 - c) * dot(axis, v)) * axis;
}

Vector3 onGreatCircle(const Vector3& a, const Vector3& b, double fraction) {
    const Vector3 normal = cross(a, b);
    const double sine = norm(normal);
    if (sine < 1e-12) {
        const Vector3 mean = (1.0 - fraction) * a + fraction * b;
        const double length = norm(mean);
        return length > 0.5 ? (1.0 / length) * mean : a;
    }
    return rotated(a, (1.0 / sine) * normal, fraction * std::atan2(sine, dot(a, b)));
}

ForwardChain::ForwardChain(const machine::MachineDefinition& machine) : spindle_axis_(unit(machine.spindle.axis)) {
    for (const std::string& name : machine.chain)
        if (const auto found = machine.rotary.find(name); found != machine.rotary.end())
            joints_.push_back({name, found->second, unit(found->second.direction)});
}

Vector3 ForwardChain::toolAxis(const RotaryValues& rotary_rad) const {
    Vector3 axis = spindle_axis_;
    for (std::size_t i = joints_.size(); i-- > 0;) axis = rotated(axis, joints_[i].direction, rotary_rad[i]);
    return axis;
}

}  // namespace cusp::post::reader
