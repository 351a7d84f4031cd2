// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of surface files: any bytes end in faces or problems, and faces can be evaluated.
#include <cusp/geometry/surface_file.hpp>

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto faces = cusp::geometry::readSurface({reinterpret_cast<const char*>(data), size}, "fuzz.toml");
    if (!faces) {
        if (faces.error().empty()) std::abort();
        return 0;
    }
    for (const auto& face : *faces) {
        for (const double s : {0.0, 0.3, 1.0}) {
            const double u = face.breaksU().front() + s * (face.breaksU().back() - face.breaksU().front());
            const double v = face.breaksV().back() - s * (face.breaksV().back() - face.breaksV().front());
            if (!face.evaluate(u, v).position.allFinite() || !face.normal(u, v).allFinite()) std::abort();
        }
    }
    return 0;
}
