// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A mesh file read whole and handed to the reader its name asks for.
#include "mesh_finish.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/geometry/mesh_file.hpp>

#include <algorithm>
#include <cctype>

namespace cusp::geometry {

base::Result<TriangleMesh> readMeshFile(const std::string& path, base::Diagnostics& report) {
    constexpr std::size_t most_bytes = std::size_t{8} << 30U;
    std::string ending = path.size() < 4 ? std::string() : path.substr(path.size() - 4);
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const bool stl = ending == ".stl";
    if (!stl && ending != ".ply") {
        return detail::meshError("mesh.format", "the name of a mesh file ends in .stl or .ply", path);
    }
    const auto bytes = base::readWholeFile(path, most_bytes);
    if (!bytes) return base::fail(bytes.error());
    return stl ? readStl(*bytes, path, report) : readPly(*bytes, path, report);
}

}  // namespace cusp::geometry
