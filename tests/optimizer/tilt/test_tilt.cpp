// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Tilted paths: where ball and axis go, what the search makes of a small case, and the simulation as its witness.
#include <cusp/machine/machine_definition.hpp>
#include <cusp/optimizer/tilt/tilt_search.hpp>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <numbers>
#include <sstream>
#include <tbb/global_control.h>

namespace cusp::tilt {
namespace {

using geometry::Vector3;

kinematics::Machine trunnion() {
    const auto document = base::TomlDocument::readFile(CUSP_SOURCE_DIR "/machines/trunnion-ac.toml");
    base::Diagnostics report;
    auto section = machine::machineSection();
    return kinematics::Machine(section.sharesTable().read(document->root(), report));
}

/// A small deep cavity with a tool too thick for it upright.
TiltJob smallCavity() {
    const auto job = readTiltJob(R"(
schema = 1
name = "SMALL"
machine = "trunnion-ac"
origin_mm = [0.0, 0.0, 60.0]
[part]
min_mm = [-20.0, -20.0, -24.0]
max_mm = [20.0, 20.0, 0.0]
spacing_mm = 1.0
[[part.feature]]
kind = "pocket"
size_mm = [24.0, 24.0]
corner_radius_mm = 12.0
level_mm = -20.0
draft_deg = 4.0
fillet_mm = 2.0
[tool]
diameter_mm = 2.0
cutting_height_mm = 1.0
shank_mm = [[30.0, 2.0, 9.0]]
holder_mm = [[30.0, 24.0, 30.0]]
[path]
step_over_mm = 3.0
[path.area]
radius_mm = 11.0
[search]
cube_mm = 60.0
generations = 12
)",
                                 "small.toml");
    EXPECT_TRUE(job.has_value()) << (job ? "" : base::toText(job.error()));
    return job.value_or(TiltJob{});
}

std::unique_ptr<TiltCase> caseOf(const TiltJob& job, const kinematics::Machine& machine) {
    base::Diagnostics report;
    auto made = TiltCase::make(job, machine, {}, report);
    EXPECT_TRUE(made.has_value()) << (made ? "" : base::toText(made.error()));
    return made ? *std::move(made) : nullptr;
}

TEST(TiltedPath, TheBallStaysAndTheAxisPassesThePoint) {
    const auto machine = trunnion();
    const auto problem = caseOf(smallCavity(), machine);
    const StartPath& path = problem->path();
    for (const Vector3& point : {Vector3(3.0, -2.0, 20.0), Vector3(1.0, 4.0, -60.0)}) {
        const auto poses = tilted(path, {{point}, {}});
        ASSERT_EQ(poses.size(), path.locations.size());
        for (std::size_t i = 0; i < poses.size(); ++i) {
            EXPECT_NEAR(poses[i].axis.norm(), 1.0, 1e-12);
            EXPECT_GT(poses[i].axis.z(), 0.0);
            if (path.locations[i].above) continue;
            const Vector3 center = poses[i].tip_mm + 1.0 * poses[i].axis;
            EXPECT_LE((center - path.center(i)).norm(), 1e-12);
            EXPECT_LE((point - center).cross(poses[i].axis).norm(), 1e-9);
        }
    }
}

TEST(TiltedPath, LinksGoAlongTheAxis) {
    const auto machine = trunnion();
    const auto problem = caseOf(smallCavity(), machine);
    const StartPath& path = problem->path();
    const auto poses = tilted(path, {{Vector3(3.0, -2.0, 20.0)}, {}});
    std::size_t links = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
        if (!path.locations[i].above) continue;
        const std::size_t cut = *path.locations[i].above;
        const Vector3 rise = poses[i].tip_mm - poses[cut].tip_mm;
        EXPECT_LE(rise.cross(poses[cut].axis).norm(), 1e-9);
        EXPECT_NEAR(rise.z(), path.locations[i].location.tip_mm.z() - path.locations[cut].location.tip_mm.z(), 1e-9);
        ++links;
    }
    EXPECT_GE(links, 2U);
}

TEST(TiltedPath, OutsideTheAreaItStaysAsItWas) {
    TiltArea area;
    area.min_mm = {0.0, -100.0, -100.0};
    area.blend_mm = 2.0;
    EXPECT_EQ(area.weight(Vector3(1.0, 0.0, 0.0)), 1.0);
    EXPECT_EQ(area.weight(Vector3(-2.1, 0.0, 0.0)), 0.0);
    EXPECT_NEAR(area.weight(Vector3(-1.0, 0.0, 0.0)), 0.5, 1e-12);
    const auto machine = trunnion();
    const auto problem = caseOf(smallCavity(), machine);
    const auto poses = tilted(problem->path(), {{Vector3(0.0, 0.0, 10.0)}, area});
    for (std::size_t i = 0; i < poses.size(); ++i)
        if (problem->path().locations[i].location.tip_mm.x() < -2.0) {
            EXPECT_EQ(poses[i].axis, Vector3::UnitZ());
        }
}

TEST(TiltedPath, SeveralPointsAreBlendedSmoothly) {
    const TiltPlan plan{{Vector3(0, 0, 10), Vector3(4, 0, 20), Vector3(0, 8, 30)}, {}};
    EXPECT_EQ(plan.pointAt(0.0), Vector3(0, 0, 10));
    EXPECT_EQ(plan.pointAt(0.5), Vector3(4, 0, 20));
    EXPECT_EQ(plan.pointAt(1.0), Vector3(0, 8, 30));
    // Without a corner: the speed is the same on both sides of the middle point.
    const double h = 1e-4;
    EXPECT_LE((plan.pointAt(0.5 + h) - plan.pointAt(0.5)).norm() / h, 0.1);
    EXPECT_LE((plan.pointAt(0.5) - plan.pointAt(0.5 - h)).norm() / h, 0.1);
}

TEST(PartShape, MeshesAreClosedAndAsHighAsTheFormulaSays) {
    const TiltJob job = smallCavity();
    const auto mesh = partMesh(job.part);
    EXPECT_TRUE(geometry::checkEdges(mesh).isClosed());
    EXPECT_NEAR(job.part.height(0.0, 0.0), -20.0, 1e-12);
    EXPECT_NEAR(job.part.height(19.0, 19.0), 0.0, 1e-12);
    // On the wall, beyond the fillet: 1 mm outside the foot.
    EXPECT_NEAR(job.part.height(12.5, 0.0), -20.0 + 0.5 / std::tan(4.0 * std::numbers::pi / 180.0), 1e-9);
    // The fillet touches floor and wall: its radius below its centre.
    double steepest = 0.0;
    for (double x = 9.0; x < 13.0; x += 0.001) {
        const double rise = job.part.height(x + 0.001, 0.0) - job.part.height(x, 0.0);
        EXPECT_GE(rise, steepest - 1e-6);
        steepest = std::max(steepest, rise);
    }
}

TEST(TiltSearch, FindsWhatTheSimulationConfirms) {
    const auto machine = trunnion();
    const auto problem = caseOf(smallCavity(), machine);
    for (const std::uint64_t seed : {1U, 2U}) {
        const auto found = searchTilt(*problem, {seed, {}, false});
        ASSERT_TRUE(found.has_value());
        EXPECT_TRUE(found->fitness.isFree()) << "seed " << seed;
        const auto poses = tilted(problem->path(), found->plan);
        const auto proof = problem->collisions(poses, 0.5, problem->job().tool.stickOutMm());
        ASSERT_TRUE(proof.has_value());
        EXPECT_EQ(proof->volume_mm3, 0.0) << "seed " << seed;
        const auto shortest = problem->shortestStickOut(poses, 1.0);
        ASSERT_TRUE(shortest.has_value());
        EXPECT_EQ(problem->collisions(poses, 0.5, *shortest)->volume_mm3, 0.0);
    }
    // Upright, the tool is too thick: without that the case would prove nothing.
    std::vector<toolpath::CutterLocation> upright;
    for (const auto& at : problem->path().locations) upright.push_back(at.location);
    EXPECT_GT(problem->collisions(upright, 0.5, problem->job().tool.stickOutMm())->volume_mm3, 1.0);
}

TEST(TiltSearch, CollidingPlansCollideInTheSimulationToo) {
    const auto machine = trunnion();
    const auto problem = caseOf(smallCavity(), machine);
    int colliding = 0;
    for (const Vector3& point : {Vector3(0, 0, -5), Vector3(15, 0, 10), Vector3(-10, 10, 25), Vector3(0, -20, 30)}) {
        const TiltPlan plan{{point}, {}};
        const TiltFitness fitness = problem->judge(plan);
        if (fitness.range_excess > 0.0 || fitness.collision_volume_mm3 < 1.0) continue;
        ++colliding;
        const auto seen = problem->collisions(tilted(problem->path(), plan), 1.0, problem->job().tool.stickOutMm());
        EXPECT_GT(seen->volume_mm3, 0.0) << point.transpose();
    }
    EXPECT_GE(colliding, 2);
}

TEST(TiltSearch, OneThreadEqualsMany) {
    TiltJob job = smallCavity();
    job.search.generations = 4;
    const auto machine = trunnion();
    const auto problem = caseOf(job, machine);
    const auto many = searchTilt(*problem, {5, {}, false});
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const auto alone = searchTilt(*problem, {5, {}, false});
    EXPECT_EQ(convergenceCsv({{5, *many}}), convergenceCsv({{5, *alone}}));
}

TEST(AxisMotion, ThreePlusTwoTurnsNothingAndLimitsAreSeen) {
    const auto machine = trunnion();
    const auto problem = caseOf(smallCavity(), machine);
    std::vector<toolpath::CutterLocation> poses;
    for (const auto& at : problem->path().locations) poses.push_back({at.location.tip_mm, Vector3(0.0, -0.6, 0.8)});
    const AxisMotion still = axisMotion(problem->place(), problem->path(), poses);
    EXPECT_EQ(still.range_excess, 0.0);
    EXPECT_EQ(still.rotary_travel_rad[0] + still.rotary_travel_rad[1], 0.0);
    EXPECT_EQ(still.harmony_s, still.time_s);
    // 150° from upright: A ends at 120°.
    const double lean = 150.0 * std::numbers::pi / 180.0;
    for (auto& pose : poses) pose.axis = Vector3(0.0, -std::sin(lean), std::cos(lean));
    EXPECT_NEAR(rotaryExcess(machine, poses), 30.0, 1e-6);
}

TEST(AxisMotion, TheLocalTimeOrdersPathsAsTheLookAheadDoes) {
    const auto machine = trunnion();
    const auto problem = caseOf(smallCavity(), machine);
    std::vector<std::pair<double, double>> times;
    for (const double z : {-4.0, 2.0, 12.0, 40.0}) {
        const auto poses = tilted(problem->path(), {{Vector3(0.5, 0.3, z)}, {}});
        const AxisMotion motion = axisMotion(problem->place(), problem->path(), poses);
        const auto exact = machiningTime(problem->place(), problem->path(), poses, motion);
        ASSERT_TRUE(exact.has_value());
        times.emplace_back(motion.time_s, *exact);
    }
    for (std::size_t i = 1; i < times.size(); ++i) {
        EXPECT_LT(times[i].first, times[i - 1].first);
        EXPECT_LT(times[i].second, times[i - 1].second);
    }
}

TEST(ContactReport, OnALevelFaceTheSpeedGoesWithTheLean) {
    const auto machine = trunnion();
    TiltJob job = smallCavity();
    job.path->area.radius_mm = 8.0;
    const auto problem = caseOf(job, machine);
    const double lean = 0.3;
    std::vector<toolpath::CutterLocation> poses;
    for (std::size_t i = 0; i < problem->path().locations.size(); ++i) {
        const Vector3 axis(std::sin(lean), 0.0, std::cos(lean));
        poses.push_back({problem->path().center(i) - axis, axis});
    }
    const ContactReport report = contactReport(problem->shape(), problem->path(), poses);
    const double speed = 2.0 * std::numbers::pi * problem->path().spindle_rpm * 1.0 * std::sin(lean) / 1000.0;
    EXPECT_GT(report.contacts, 10U);
    EXPECT_NEAR(report.speed_mean_m_per_min, speed, 1e-6 * speed);
    EXPECT_NEAR(report.force_proxy_mean, std::pow(std::sin(lean), -0.25), 1e-6);
}

/// What begins a line of the file with `# expect: `.
std::string expected(const std::string& text) {
    const std::string mark = "# expect: ";
    std::istringstream lines(text);
    std::string out;
    for (std::string line; std::getline(lines, line) && line.starts_with(mark);) out += line.substr(mark.size()) + "\n";
    return out;
}

TEST(TiltJob, EveryRejectGivesItsExactProblems) {
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/tests/optimizer/tilt/reject")) {
        std::ifstream in(entry.path());
        const std::string text((std::istreambuf_iterator<char>(in)), {});
        const auto job = readTiltJob(text, "t.toml");
        ASSERT_FALSE(job.has_value()) << entry.path();
        EXPECT_EQ(base::toText(job.error()), expected(text)) << entry.path();
        ++files;
    }
    EXPECT_GE(files, 3U);
}

TEST(StartPath, RefusesWhatCannotBeTilted) {
    using namespace toolpath;
    const auto refused = [](std::vector<ClRecord> records) {
        const auto path = startPath(records, "p.apt");
        return path ? std::string("accepted") : base::toText(path.error());
    };
    const geometry::Cutter flat{10.0, 0.0, 5.0, 0.0, 0.0, 0.0, 20.0};
    const LinearMotion go{{Vector3(1, 0, 0), Vector3::UnitZ()}, MotionKind::Feed};
    EXPECT_EQ(
        refused({{ToolCall{1, "F", flat}, 1}, {go, 2}, {go, 3}}),
        "p.apt:1: error: only a ball end mill leaves the same surface when it is tilted; this one has diameter 10 mm "
        "and corner radius 0 mm [tilt.not-a-ball]\n");
    EXPECT_EQ(refused({{go, 2}, {CycleStart{}, 3}, {go, 4}}),
              "p.apt:3: error: a drilling cycle cannot be tilted [tilt.motion]\n");
    EXPECT_EQ(refused({{go, 2}}), "p.apt: error: the file holds no path [tilt.no-path]\n");
}

}  // namespace
}  // namespace cusp::tilt
