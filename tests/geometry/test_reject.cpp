// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The reject corpora: every file ends with exactly the problems its comment lines announce.
#include <cusp/geometry/cad/nominal_file.hpp>
#include <cusp/geometry/mesh_file.hpp>
#include <cusp/geometry/surface_file.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

namespace cusp::geometry::test {
namespace {

std::string fileText(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The texts behind `expect: `, one problem a line.
std::string expectedProblems(const std::string& text) {
    const std::string mark = "expect: ";
    std::istringstream lines(text);
    std::string expected;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t at = line.find(mark);
        if (at != std::string::npos) expected += line.substr(at + mark.size()) + "\n";
    }
    return expected;
}

TEST(Reject, EverySurfaceFileGivesItsExactProblems) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/geometry/reject_surfaces")) {
        const std::string text = fileText(entry.path());
        const auto faces = readSurface(text, "s.toml");
        ASSERT_FALSE(faces.has_value()) << entry.path();
        EXPECT_EQ(base::toText(faces.error()), expectedProblems(text)) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 6U);
}

TEST(Reject, EveryMeshFileGivesItsExactProblems) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/geometry/reject_meshes")) {
        const std::string text = fileText(entry.path());
        base::Diagnostics report;
        const bool ply = entry.path().extension() == ".ply";
        const auto mesh = ply ? readPly(text, "m.ply", report) : readStl(text, "m.stl", report);
        ASSERT_FALSE(mesh.has_value()) << entry.path();
        EXPECT_EQ(base::toText(mesh.error()), expectedProblems(text)) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 8U);
}

TEST(Reject, UnknownEndingsAreRefusedByName) {
    const auto nominal = loadNominal("part.prt");
    ASSERT_FALSE(nominal.has_value());
    EXPECT_EQ(nominal.error().front().code, "nominal.unknown-format");
}

}  // namespace
}  // namespace cusp::geometry::test
