// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// STL (3D Systems 1989): 50 bytes a triangle behind a header of 84, or facets in words.
#include "mesh_finish.hpp"
#include "mesh_words.hpp"

#include <cusp/geometry/mesh_file.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace cusp::geometry {
namespace {

constexpr std::size_t header_bytes = 84;
constexpr std::size_t triangle_bytes = 50;
constexpr std::size_t most_triangles = 100'000'000;

bool startsWithSolid(std::string_view bytes) {
    const std::string_view word = "solid";
    return bytes.size() >= word.size() && std::equal(word.begin(), word.end(), bytes.begin(), [](char a, char b) {
               return a == std::tolower(static_cast<unsigned char>(b));
           });
}

void addTriangle(TriangleMesh& mesh) {
    const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.triangles.push_back({n - 3, n - 2, n - 1});
}

base::Result<TriangleMesh> readBinary(std::string_view bytes, const std::string& file_name) {
    const std::size_t count = detail::fromBytes<std::uint32_t>(bytes.data() + header_bytes - 4);
    const std::size_t present = (bytes.size() - header_bytes) / triangle_bytes;
    if (count > present) {
        return detail::meshError(
            "mesh.truncated",
            fmt::format("the header announces {} triangles, the file ends after {}; an STL file in text starts "
                        "with 'solid'",
                        count, present),
            file_name);
    }
    if (count > most_triangles) {
        return detail::meshError("mesh.too-large", fmt::format("more than {} triangles", most_triangles), file_name);
    }
    TriangleMesh mesh;
    mesh.vertices.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        // Behind the normal, which says nothing that the corners do not.
        const char* const corners = bytes.data() + header_bytes + i * triangle_bytes + 12;
        for (std::size_t k = 0; k < 3; ++k) {
            const char* const at = corners + 12 * k;
            mesh.vertices.emplace_back(static_cast<double>(detail::fromBytes<float>(at)),
                                       static_cast<double>(detail::fromBytes<float>(at + 4)),
                                       static_cast<double>(detail::fromBytes<float>(at + 8)));
        }
        addTriangle(mesh);
    }
    return mesh;
}

/// The words of a facet, in order; '#' stands for a number, of which those of the vertices count.
constexpr std::string_view facet_words[] = {"normal", "#", "#", "#",      "outer",   "loop",    "vertex",
                                            "#",      "#", "#", "vertex", "#",       "#",       "#",
                                            "vertex", "#", "#", "#",      "endloop", "endfacet"};

std::string lower(std::string_view word) {
    std::string out(word);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

base::Result<void> readFacet(detail::MeshWords& words, TriangleMesh& mesh, const std::string& file_name) {
    std::size_t numbers = 0;
    Vector3 point = Vector3::Zero();
    for (const std::string_view expected : facet_words) {
        const std::string_view word = words.next();
        if (word.empty()) {
            return detail::meshError("mesh.truncated", "the file ends inside a facet", file_name, words.line());
        }
        if (expected != "#") {
            if (lower(word) == expected) continue;
            return detail::meshError("mesh.format", fmt::format("expected '{}', found '{}'", expected, word), file_name,
                                     words.line());
        }
        const bool in_normal = numbers < 3;
        const auto value = base::parseDouble(word);
        // Some programs write nan for the normal of a thin triangle.
        if (!value && !in_normal) {
            return detail::meshError("mesh.number", fmt::format("'{}' is not a number", word), file_name, words.line());
        }
        point[static_cast<Eigen::Index>(numbers % 3)] = value.value_or(0.0);
        ++numbers;
        if (!in_normal && numbers % 3 == 0) mesh.vertices.push_back(point);
    }
    addTriangle(mesh);
    return {};
}

base::Result<TriangleMesh> readText(std::string_view bytes, const std::string& file_name) {
    detail::MeshWords words(bytes);
    TriangleMesh mesh;
    words.next();
    words.restOfLine();  // the name of the solid
    bool open = true;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
        const std::string name = lower(word);
        if (open && name == "facet") {
            if (auto ok = readFacet(words, mesh, file_name); !ok) return base::fail(std::move(ok).error());
        } else if (name == (open ? "endsolid" : "solid")) {
            open = !open;
            words.restOfLine();
        } else {
            return detail::meshError(
                "mesh.format", fmt::format("expected '{}', found '{}'", open ? "facet' or 'endsolid" : "solid", word),
                file_name, words.line());
        }
        if (mesh.triangles.size() > most_triangles) {
            return detail::meshError("mesh.too-large", fmt::format("more than {} triangles", most_triangles),
                                     file_name);
        }
    }
    if (open) return detail::meshError("mesh.truncated", "the file ends without endsolid", file_name, words.line());
    return mesh;
}

}  // namespace

base::Result<TriangleMesh> readStl(std::string_view bytes, const std::string& file_name, base::Diagnostics& report) {
    // Binary files often start with "solid" as well: what decides is whether the announced count fits the size.
    const bool has_header = bytes.size() >= header_bytes;
    const bool fits =
        has_header && header_bytes + triangle_bytes * static_cast<std::size_t>(detail::fromBytes<std::uint32_t>(
                                                          bytes.data() + header_bytes - 4)) ==
                          bytes.size();
    base::Result<TriangleMesh> mesh =
        fits                     ? readBinary(bytes, file_name)
        : startsWithSolid(bytes) ? readText(bytes, file_name)
        : has_header             ? readBinary(bytes, file_name)
                     : detail::meshError("mesh.format", "this is no STL file: too short for a header", file_name);
    if (!mesh) return mesh;
    return detail::finishMesh(*mesh, file_name, report);
}

}  // namespace cusp::geometry
