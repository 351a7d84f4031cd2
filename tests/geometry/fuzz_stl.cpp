// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of the STL reader: any bytes end in a mesh or problems, and a mesh names only vertices it has.
#include <cusp/geometry/mesh_file.hpp>

#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    cusp::base::Diagnostics report;
    const auto mesh = cusp::geometry::readStl({reinterpret_cast<const char*>(data), size}, "fuzz.stl", report);
    if (!mesh) {
        if (mesh.error().empty()) std::abort();
        return 0;
    }
    for (const auto& triangle : mesh->triangles) {
        for (const std::uint32_t corner : triangle) {
            if (corner >= mesh->vertices.size() || !mesh->vertices[corner].allFinite()) std::abort();
        }
    }
    return 0;
}
