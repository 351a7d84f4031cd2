// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Elementary frames.
#include "frame.hpp"

namespace cusp::post::reader {

Frame shifted(const Vector3& by_mm) {
    Frame frame;
    frame.origin_mm = by_mm;
    return frame;
}

Frame turnedAbout(std::size_t axis, double angle_rad) {
    const Frame identity;
    const Vector3 about = axis == 0 ? identity.x : axis == 1 ? identity.y : identity.z;
    return {rotated(identity.x, about, angle_rad),
            rotated(identity.y, about, angle_rad),
            rotated(identity.z, about, angle_rad),
            {}};
}

std::size_t normalOf(std::string_view plane) { return plane == "G18" ? 1 : plane == "G19" ? 0 : 2; }

}  // namespace cusp::post::reader
