// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// STEP and IGES files that OCCT wrote, read through the child process, measured against OCCT's own extrema; damaged files.
#include "occt_parts.hpp"

#include <cusp/base/random.hpp>
#include <cusp/geometry/cad/cad_file.hpp>
#include <cusp/geometry/cad/nominal_file.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>

namespace cusp::geometry::test {
namespace {

constexpr std::uint64_t seed = 77;

class Cad : public testing::Test {
protected:
    Cad() : folder_(std::filesystem::temp_directory_path() / ("cusp_cad_" + std::to_string(::getpid()))) {
        std::filesystem::create_directories(folder_);
        options_.reader = CUSP_CAD_READER_PATH;
    }
    ~Cad() override { std::filesystem::remove_all(folder_); }

    [[nodiscard]] std::string pathOf(const std::string& name) const { return (folder_ / name).string(); }

    [[nodiscard]] base::Result<ParametricSurface> read(const std::string& path) {
        return readCadFile(path, report_, options_);
    }

    std::filesystem::path folder_;
    CadOptions options_;
    base::Diagnostics report_;
};

std::string fileText(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

void writeText(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

void expectSameAsOcct(const OcctPart& part, const ParametricSurface& shape, base::Random& random, int queries) {
    const Eigen::AlignedBox3d box = part.bounds();
    for (int i = 0; i < queries; ++i) {
        Vector3 query = box.center();
        for (int k = 0; k < 3; ++k) query[k] += random.uniform(-0.75, 0.75) * box.sizes()[k];
        const double theirs = part.distance(query);
        const Footpoint foot = shape.closest(query);
        // OCCT's extrema are exact to about 1e-7; a lesser distance of ours would still have to be a point of the part.
        ASSERT_NEAR(std::abs(foot.distance_mm), theirs, 2e-7) << part.name() << ", query " << query.transpose();
        ASSERT_NEAR(part.distance(foot.position), 0.0, 2e-7) << part.name() << ", query " << query.transpose();
        if (part.isSolid() && theirs > 1e-6) {
            ASSERT_EQ(foot.distance_mm < 0.0, part.isInside(query)) << part.name() << ", query " << query.transpose();
        }
    }
}

TEST_F(Cad, StepPartsMeasureAsOcctMeasuresThem) {
    base::Random random(seed);
    for (const OcctPart& part : OcctPart::all()) {
        const std::string path = pathOf("part.step");
        ASSERT_TRUE(part.writeStep(path, "MM"));
        const auto shape = read(path);
        ASSERT_TRUE(shape.has_value()) << part.name() << ": " << base::toText(shape.error());
        EXPECT_TRUE(report_.empty()) << base::toText(report_);
        expectSameAsOcct(part, *shape, random, 60);
    }
}

TEST_F(Cad, IgesPartsMeasureAsOcctMeasuresThem) {
    base::Random random(seed);
    for (const OcctPart& part : OcctPart::all()) {
        const std::string path = pathOf("part.igs");
        ASSERT_TRUE(part.writeIges(path));
        const auto shape = read(path);
        ASSERT_TRUE(shape.has_value()) << part.name() << ": " << base::toText(shape.error());
        expectSameAsOcct(part, *shape, random, 30);
    }
}

TEST_F(Cad, TheHoleIsAHole) {
    const OcctPart part = OcctPart::plateWithHole();
    ASSERT_TRUE(part.writeStep(pathOf("plate.stp"), "MM"));
    const auto shape = read(pathOf("plate.stp"));
    ASSERT_TRUE(shape.has_value()) << base::toText(shape.error());
    EXPECT_EQ(shape->trimmedFaces(), 1U);
    const Vector3 center(5, -3, 2);
    const Vector3 normal = Vector3(0.3, 0.2, 1.0).normalized();
    const Footpoint middle = shape->closest(center);
    EXPECT_NEAR(std::abs(middle.distance_mm), 6.0, 1e-9);
    EXPECT_TRUE(middle.on_boundary);
    const Footpoint above = shape->closest(center + 8.0 * normal);
    EXPECT_NEAR(above.distance_mm, 10.0, 1e-9);
    EXPECT_TRUE(above.on_boundary);
    const Vector3 aside = normal.cross(Vector3::UnitX()).normalized();
    const Footpoint inside = shape->closest(center + 8.0 * aside - 0.5 * normal);
    EXPECT_NEAR(inside.distance_mm, -0.5, 1e-9);
    EXPECT_FALSE(inside.on_boundary);
}

TEST_F(Cad, UnitsOfTheFileAreHonoured) {
    for (const char* unit : {"INCH", "M", "MM"}) {
        ASSERT_TRUE(OcctPart::cylinder().writeStep(pathOf("unit.step"), unit));
        const auto shape = read(pathOf("unit.step"));
        ASSERT_TRUE(shape.has_value()) << base::toText(shape.error());
        const Vector3 axis = Vector3(0.3, 0.2, 1.0).normalized();
        EXPECT_NEAR(shape->closest(Vector3(5, -3, 2) + 12.5 * axis).distance_mm, -7.0, 1e-6) << unit;
    }
}

TEST_F(Cad, WarmStartsChangeNothingOnTrimmedFaces) {
    base::Random random(seed);
    ASSERT_TRUE(OcctPart::drilledBlock().writeStep(pathOf("block.step"), "MM"));
    const auto shape = read(pathOf("block.step"));
    ASSERT_TRUE(shape.has_value()) << base::toText(shape.error());
    std::vector<Vector3> queries;
    for (int i = 0; i < 500; ++i) {
        queries.emplace_back(random.uniform(-10, 50), random.uniform(-10, 40), random.uniform(-10, 30));
    }
    std::vector<Footpoint> cold(queries.size());
    shape->closest(queries, cold, false);
    std::vector<Footpoint> warm(cold.rbegin(), cold.rend());
    shape->closest(queries, warm, true);
    for (std::size_t i = 0; i < queries.size(); ++i) ASSERT_NEAR(warm[i].distance_mm, cold[i].distance_mm, 1e-9);
}

TEST_F(Cad, LoadNominalReadsThemByTheirEnding) {
    ASSERT_TRUE(OcctPart::sphere().writeStep(pathOf("Ball.STP"), "MM"));
    ASSERT_EQ(::setenv("CUSP_CAD_READER", CUSP_CAD_READER_PATH, 1), 0);
    const auto nominal = loadNominal(pathOf("Ball.STP"));
    ASSERT_TRUE(nominal.has_value()) << base::toText(nominal.error());
    EXPECT_NEAR((*nominal)->closest({5, -3, 2}).distance_mm, -12.0, 1e-9);
}

TEST_F(Cad, WhatIsNoCadFileIsSaid) {
    const auto expect = [&](const std::string& name, const std::string& problem) {
        const auto shape = read(pathOf(name));
        ASSERT_FALSE(shape.has_value());
        EXPECT_EQ(base::toText(shape.error()), pathOf(name) + ": error: " + problem + "\n");
    };
    writeText(pathOf("empty.step"), "");
    expect("empty.step", "this is no STEP file that OCCT can read [cad.syntax]");
    writeText(pathOf("text.step"), "Dear reader, this is a letter.\n");
    expect("text.step", "this is no STEP file that OCCT can read [cad.syntax]");
    writeText(pathOf("hollow.step"),
              "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\nFILE_NAME('','',(''),(''),'','','');\n"
              "FILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\nENDSEC;\nEND-ISO-10303-21;\n");
    expect("hollow.step", "there is no shape in the file that OCCT can translate [cad.no-shape]");
    expect("absent.step", "cannot be read: No such file or directory [io.open]");
    options_.reader = pathOf("nobody");
    writeText(pathOf("any.step"), "x");
    expect("any.step", "the CAD reader '" + pathOf("nobody") + "' cannot be run [cad.reader]");
}

TEST_F(Cad, LimitsEndTheReader) {
    ASSERT_TRUE(OcctPart::drilledBlock().writeStep(pathOf("block.step"), "MM"));
    options_.time_limit_s = 0.001;
    const auto shape = read(pathOf("block.step"));
    ASSERT_FALSE(shape.has_value());
    EXPECT_EQ(shape.error().front().code, "cad.limit");
}

TEST_F(Cad, DamagedFilesEndInAShapeOrADiagnostic) {
    base::Random random(seed);
    ASSERT_TRUE(OcctPart::plateWithHole().writeStep(pathOf("whole.step"), "MM"));
    ASSERT_TRUE(OcctPart::plateWithHole().writeIges(pathOf("whole.igs")));
    for (const std::string ending : {"step", "igs"}) {
        const std::string whole = fileText(pathOf("whole." + ending));
        const std::size_t data = whole.find(ending == "step" ? "DATA;" : "D      1");
        for (int i = 0; i < 12; ++i) {
            std::string damaged = whole;
            for (int k = 0; k < 1 + i % 4; ++k) {
                const std::size_t at = data + random.below(whole.size() - data);
                damaged[at] = static_cast<char>('!' + random.below(90));
            }
            if (i % 4 == 3) damaged.resize(data + random.below(whole.size() - data));
            writeText(pathOf("damaged." + ending), damaged);
            const auto shape = read(pathOf("damaged." + ending));
            if (shape) {
                EXPECT_TRUE(std::isfinite(shape->closest({1, 2, 3}).distance_mm)) << i << ", seed " << seed;
            } else {
                EXPECT_FALSE(shape.error().empty());
                EXPECT_EQ(shape.error().front().where.file, pathOf("damaged." + ending));
            }
        }
    }
}

}  // namespace
}  // namespace cusp::geometry::test
