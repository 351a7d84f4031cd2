// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What goes to cusp-scan and what comes back, as bytes; both ends are the same build on the same machine.
#pragma once

#include <cusp/geometry/frames.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::inspect {

/// Coordinates about the middle of each cloud: PCL computes in single precision.
struct ScanRequest {
    std::vector<geometry::Vector3> scan;
    std::vector<geometry::Vector3> surface;
    std::vector<geometry::Vector3> normals;  ///< of the surface, outward
    double size_mm = 0.0;                    ///< diagonal of the nominal
};

struct ScanAnswer {
    std::vector<geometry::RigidTransform> surface_from_scan;
    std::uint64_t outliers = 0;
};

[[nodiscard]] std::string encode(const ScanRequest& request);
[[nodiscard]] std::string encode(const ScanAnswer& answer);
/// Nothing when the bytes are not what `encode` makes.
[[nodiscard]] std::optional<ScanRequest> decodeRequest(std::string_view bytes);
[[nodiscard]] std::optional<ScanAnswer> decodeAnswer(std::string_view bytes);

}  // namespace cusp::inspect
