// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Meshes: files back to the same triangles, nearest points against brute force and closed forms, edges and signs.
#include <cusp/base/random.hpp>
#include <cusp/geometry/mesh_file.hpp>
#include <cusp/geometry/mesh_shape.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <string>

namespace cusp::geometry::test {
namespace {

constexpr std::uint64_t seed = 4;

/// A cube of half side 10 about `center`, two triangles a side, corners counter-clockwise from outside.
TriangleMesh cube(const Vector3& center) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.vertices.emplace_back(center + 10.0 * Vector3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
    }
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// A spiky ball: radii drawn anew for every vertex of a latitude-longitude grid.
TriangleMesh spikyBall(base::Random& random, std::uint32_t rings, std::uint32_t sectors) {
    TriangleMesh mesh;
    mesh.vertices.emplace_back(0, 0, 10);
    for (std::uint32_t i = 1; i < rings; ++i) {
        for (std::uint32_t j = 0; j < sectors; ++j) {
            const double polar = std::numbers::pi * i / rings;
            const double around = 2.0 * std::numbers::pi * j / sectors;
            mesh.vertices.push_back(random.uniform(5.0, 12.0) * Vector3(std::sin(polar) * std::cos(around),
                                                                        std::sin(polar) * std::sin(around),
                                                                        std::cos(polar)));
        }
    }
    mesh.vertices.emplace_back(0, 0, -10);
    const auto last = static_cast<std::uint32_t>(mesh.vertices.size() - 1);
    const auto at = [&](std::uint32_t i, std::uint32_t j) { return 1 + (i - 1) * sectors + j % sectors; };
    for (std::uint32_t j = 0; j < sectors; ++j) {
        mesh.triangles.push_back({0, at(1, j), at(1, j + 1)});
        for (std::uint32_t i = 1; i + 1 < rings; ++i) {
            mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
            mesh.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
        }
        mesh.triangles.push_back({at(rings - 1, j), last, at(rings - 1, j + 1)});
    }
    return mesh;
}

double segmentDistance(const Vector3& query, const Vector3& a, const Vector3& b) {
    const double t = std::clamp((query - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (query - a - t * (b - a)).norm();
}

/// By another route than the code under test: the foot in the plane if it is inside, else the nearest side.
double triangleDistance(const Vector3& query, const Vector3& a, const Vector3& b, const Vector3& c) {
    const Vector3 normal = (b - a).cross(c - a).normalized();
    const Vector3 foot = query - (query - a).dot(normal) * normal;
    const bool inside = (b - a).cross(foot - a).dot(normal) >= 0 && (c - b).cross(foot - b).dot(normal) >= 0 &&
                        (a - c).cross(foot - c).dot(normal) >= 0;
    if (inside) return (query - foot).norm();
    return std::min({segmentDistance(query, a, b), segmentDistance(query, b, c), segmentDistance(query, c, a)});
}

/// Whether a ray in a fixed odd direction leaves the mesh once more than it enters.
bool isInside(const TriangleMesh& mesh, const Vector3& query) {
    const Vector3 ray = Vector3(0.3717, 0.5411, 0.7543).normalized();
    int crossings = 0;
    for (const auto& t : mesh.triangles) {
        const Vector3 a = mesh.vertices[t[0]] - query;
        const Vector3 b = mesh.vertices[t[1]] - query;
        const Vector3 c = mesh.vertices[t[2]] - query;
        const double u = ray.dot(b.cross(c));
        const double v = ray.dot(c.cross(a));
        const double w = ray.dot(a.cross(b));
        const bool hit = (u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0);
        if (hit && a.dot((b - a).cross(c - a)) / ray.dot((b - a).cross(c - a)) > 0) ++crossings;
    }
    return crossings % 2 == 1;
}

TEST(MeshShape, SignedDistanceIsThatOfBruteForceAndRayCasting) {
    base::Random random(seed);
    for (int round = 0; round < 3; ++round) {
        const TriangleMesh mesh = spikyBall(random, 9, 12);
        ASSERT_TRUE(checkEdges(mesh).isClosed());
        const MeshShape shape(mesh);
        for (int i = 0; i < 3000; ++i) {
            const Vector3 query(random.uniform(-15, 15), random.uniform(-15, 15), random.uniform(-15, 15));
            double least = std::numeric_limits<double>::infinity();
            for (const auto& t : mesh.triangles) {
                least = std::min(
                    least, triangleDistance(query, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]));
            }
            const Footpoint foot = shape.closest(query);
            ASSERT_NEAR(std::abs(foot.distance_mm), least, 1e-12) << query.transpose() << ", seed " << seed;
            ASSERT_EQ(foot.distance_mm < 0.0, isInside(mesh, query)) << query.transpose() << ", seed " << seed;
            ASSERT_FALSE(foot.on_boundary);
            const auto& t = mesh.triangles[static_cast<std::size_t>(foot.face)];
            const Vector3 position = (1.0 - foot.u - foot.v) * mesh.vertices[t[0]] + foot.u * mesh.vertices[t[1]] +
                                     foot.v * mesh.vertices[t[2]];
            ASSERT_LE((position - foot.position).norm(), 1e-12);
        }
    }
}

TEST(MeshShape, CubeInClosedFormFarOffTheOrigin) {
    base::Random random(seed);
    const Vector3 center(1e6, -2e6, 5e5);
    const MeshShape shape(cube(center));
    for (int i = 0; i < 2000; ++i) {
        const Vector3 query =
            center + Vector3(random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-30, 30));
        const Vector3 over = (query - center).cwiseAbs() - Vector3::Constant(10.0);
        const double expected = over.maxCoeff() < 0.0 ? over.maxCoeff() : over.cwiseMax(0.0).norm();
        ASSERT_NEAR(shape.closest(query).distance_mm, expected, 1e-12);
    }
}

TEST(MeshShape, OpenMeshesSayWhereTheyEnd) {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 0}, {10, 0, 0}, {10, 10, 0}, {0, 10, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    const MeshShape shape(mesh);
    EXPECT_FALSE(shape.closest({5, 5, 1}).on_boundary);
    EXPECT_FALSE(shape.closest({0, 5, 1}).on_boundary) << "on the normal at the very edge";
    const Footpoint beyond = shape.closest({-3, 5, 4});
    EXPECT_TRUE(beyond.on_boundary);
    EXPECT_NEAR(beyond.distance_mm, 5.0, 1e-12);
    EXPECT_NEAR(shape.closest({-3, 5, -4}).distance_mm, -5.0, 1e-12);
    EXPECT_TRUE(shape.closest({12, 13, 0.5}).on_boundary);
}

TEST(MeshShape, WarmStartsAndThreadsChangeNoBit) {
    base::Random random(seed);
    const MeshShape shape(spikyBall(random, 20, 30));
    std::vector<Vector3> queries;
    for (int i = 0; i < 4000; ++i) {
        queries.emplace_back(random.uniform(-15, 15), random.uniform(-15, 15), random.uniform(-15, 15));
    }
    std::vector<Footpoint> cold(queries.size());
    shape.closest(queries, cold, false);
    std::vector<Footpoint> warm(cold.rbegin(), cold.rend());
    warm[0].face = -1;
    warm[1].face = 1 << 30;
    shape.closest(queries, warm, true);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const Footpoint one = shape.closest(queries[i]);
        ASSERT_EQ(one.distance_mm, cold[i].distance_mm);
        ASSERT_EQ(one.distance_mm, warm[i].distance_mm);
        ASSERT_EQ(one.face, warm[i].face);
        ASSERT_EQ(one.position, warm[i].position);
    }
}

TEST(MeshShape, AQueryThatIsNoNumberGetsNoNumber) {
    const MeshShape shape(cube(Vector3::Zero()));
    const Footpoint foot = shape.closest({std::numeric_limits<double>::quiet_NaN(), 0, 0});
    EXPECT_TRUE(std::isnan(foot.distance_mm));
    EXPECT_EQ(foot.face, -1);
}

std::string binaryStl(const TriangleMesh& mesh) {
    std::string out = "solid name that lies: this file is binary";
    out.resize(80, ' ');
    const auto put = [&](const auto& value) {
        char bytes[sizeof(value)];
        std::memcpy(bytes, &value, sizeof(value));
        out.append(bytes, sizeof(value));
    };
    put(static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const auto& t : mesh.triangles) {
        out.append(12, '\0');
        for (const std::uint32_t corner : t) {
            for (int k = 0; k < 3; ++k) put(static_cast<float>(mesh.vertices[corner][k]));
        }
        out.append(2, '\0');
    }
    return out;
}

std::string textStl(const TriangleMesh& mesh) {
    std::string out = "solid cube\n";
    for (const auto& t : mesh.triangles) {
        out += "  facet normal nan 0 0\n    outer loop\n";
        for (const std::uint32_t corner : t) {
            out += "      vertex";
            for (int k = 0; k < 3; ++k) out += " " + std::to_string(mesh.vertices[corner][k]);
            out += "\n";
        }
        out += "    endloop\n  endfacet\n";
    }
    return out + "endsolid cube\n";
}

/// Quadrilaterals, a property and an element nobody asked for.
std::string ply(bool binary, bool big_endian) {
    std::string out =
        "ply\nformat " +
        std::string(!binary      ? "ascii"
                    : big_endian ? "binary_big_endian"
                                 : "binary_little_endian") +
        " 1.0\ncomment a cube\nelement vertex 8\nproperty double x\nproperty double y\nproperty double z\n"
        "property uchar red\nelement note 1\nproperty int what\nelement face 6\n"
        "property list uchar int vertex_indices\nend_header\n";
    const auto put = [&](auto value) {
        if (!binary) {
            out += std::to_string(value) + " ";
            return;
        }
        char bytes[sizeof(value)];
        std::memcpy(bytes, &value, sizeof(value));
        if (big_endian) std::reverse(bytes, bytes + sizeof(value));
        out.append(bytes, sizeof(value));
    };
    for (const Vector3& vertex : cube(Vector3::Zero()).vertices) {
        for (int k = 0; k < 3; ++k) put(vertex[k]);
        put(static_cast<std::uint8_t>(7));
    }
    put(std::int32_t{42});
    for (const auto& corners : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                                std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
        put(static_cast<std::uint8_t>(4));
        for (const int corner : corners) put(static_cast<std::int32_t>(corner));
    }
    return out;
}

void expectCube(const base::Result<TriangleMesh>& mesh, const base::Diagnostics& report) {
    ASSERT_TRUE(mesh.has_value()) << base::toText(mesh.error());
    EXPECT_EQ(base::toText(report), "");
    EXPECT_EQ(mesh->vertices.size(), 8U);
    EXPECT_EQ(mesh->triangles.size(), 12U);
    EXPECT_TRUE(checkEdges(*mesh).isClosed());
    const MeshShape shape(*mesh);
    EXPECT_NEAR(shape.closest({1, 2, 3}).distance_mm, -7.0, 1e-12);
    EXPECT_NEAR(shape.closest({0, 0, 12}).distance_mm, 2.0, 1e-12);
}

TEST(MeshFile, StlTextAndBinary) {
    base::Diagnostics report;
    expectCube(readStl(textStl(cube(Vector3::Zero())), "c.stl", report), report);
    expectCube(readStl(binaryStl(cube(Vector3::Zero())), "c.stl", report), report);
}

TEST(MeshFile, PlyTextAndBinaryOfEitherOrder) {
    base::Diagnostics report;
    expectCube(readPly(ply(false, false), "c.ply", report), report);
    expectCube(readPly(ply(true, false), "c.ply", report), report);
    expectCube(readPly(ply(true, true), "c.ply", report), report);
}

TEST(MeshFile, WhatIsWrongWithTheTrianglesIsSaid) {
    TriangleMesh mesh = cube(Vector3::Zero());
    mesh.triangles.pop_back();
    std::swap(mesh.triangles[0][1], mesh.triangles[0][2]);
    mesh.triangles.push_back({3, 3, 7});
    base::Diagnostics report;
    const auto read = readStl(binaryStl(mesh), "c.stl", report);
    ASSERT_TRUE(read.has_value());
    EXPECT_EQ(base::toText(report),
              "c.stl: warning: 1 triangles with two equal corners are left out [mesh.collapsed]\n"
              "c.stl: warning: the mesh is not closed: 3 edges belong to one triangle only [mesh.open]\n"
              "c.stl: warning: at 3 edges one of the two triangles is inside out: signs of distances near them are not "
              "reliable [mesh.reversed]\n");
}

TEST(MeshFile, EveryPrefixIsReadOrRefused) {
    for (const std::string& whole :
         {textStl(cube(Vector3::Zero())), binaryStl(cube(Vector3::Zero())), ply(false, false), ply(true, true)}) {
        for (std::size_t n = 0; n + 1 < whole.size(); ++n) {
            base::Diagnostics report;
            const std::string part = whole.substr(0, n);
            const auto mesh =
                part.starts_with("ply") || n < 3 ? readPly(part, "p", report) : readStl(part, "p", report);
            // Text formats may lose the last word's tail unnoticed, nothing else.
            if (mesh) {
                EXPECT_GE(n + 8, whole.size()) << part.substr(0, 10);
            }
        }
    }
}

}  // namespace
}  // namespace cusp::geometry::test
