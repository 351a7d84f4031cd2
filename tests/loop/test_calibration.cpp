// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Calibration on the artefact: what is found, what is refused, and how often the intervals hold (400 seeds: bench/loop).
#include <cusp/geometry/parametric_surface.hpp>
#include <cusp/geometry/surface_file.hpp>
#include <cusp/loop/artefact.hpp>
#include <cusp/loop/calibration.hpp>
#include <cusp/loop/closed_loop.hpp>

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

namespace cusp::loop {
namespace {

constexpr std::uint64_t seed = 20260923;
constexpr double presetter_mm = 0.002;
constexpr double tram_deg = 0.0005;

/// The artefact cut on a machine of which only the errors differ.
struct Scene {
    Scene()
        : file(post::readMachineFile(std::string(CUSP_SOURCE_DIR) + "/machines/fooke-endura-ca.toml").value()),
          machine(file.machine),
          artefact(planArtefact({}).value()),
          nominal(geometry::readSurface(artefact.surface_toml, "artefact.toml").value()),
          job(cutJob(artefact.path).value()),
          track(idealTrack(job, machine, setup).value()) {}

    [[nodiscard]] CalibrationResult run(const MachineErrors& hidden, base::Random& random,
                                        bool presetter = true) const {
        const auto real = realMachine(file.machine, hidden, setup).value();
        CmmOptions cmm;
        cmm.seed = random.next();
        const auto cut = realPath(track, real, job.cutter(), job.part_from_wcs);
        const auto measured = measurePart(cut, artefact.plan, nominal, cmm).value();
        CalibrationOptions options;
        const auto truth = [&](const char* name) { return hidden.contains(name) ? hidden.at(name) : 0.0; };
        if (presetter)
            options.known = {
                {"tool_length_mm", truth("tool_length_mm") + random.normal(0.0, presetter_mm), presetter_mm},
                {"zero_A_deg", truth("zero_A_deg") + random.normal(0.0, tram_deg), tram_deg}};
        const CalibrationPart part{.name = "artefact",
                                   .job = &job,
                                   .track = &track,
                                   .nominal = &nominal,
                                   .points = &measured.points,
                                   .probe_radius_mm = cmm.probe_radius_mm};
        auto result = calibrate(file.machine, setup, {part}, options);
        EXPECT_TRUE(result) << base::toText(result.error());
        return result.value();
    }

    CuttingSetup setup{.tool_length_mm = 120.0, .wcs_origin_mm = {3000.0, 0.0, -900.0}};
    post::MachineFile file;
    kinematics::Machine machine;
    Artefact artefact;
    geometry::ParametricSurface nominal;
    CutJob job;
    AxisTrack track;
};

const Scene& scene() {
    static const Scene made;
    return made;
}

const FoundParameter& find(const CalibrationResult& result, const std::string& name) {
    return *std::ranges::find(result.parameters, name, [](const FoundParameter& f) { return f.parameter.name; });
}

std::string states(const CalibrationResult& result) {
    std::string out;
    for (const auto& found : result.parameters)
        out += found.parameter.name + " " + std::string(stateName(found.state)) + "\n";
    return out;
}

TEST(Calibration, FindsWhatTheArtefactShows) {
    base::Random random(seed);
    const MachineErrors hidden{{"pivot_length_mm", 0.05}, {"axis_A_y_mm", -0.03}, {"zero_A_deg", 0.006}};
    const auto result = scene().run(hidden, random);
    EXPECT_TRUE(result.converged);
    for (const auto& [name, value] : hidden) {
        const auto& found = find(result, name);
        ASSERT_EQ(found.state, ParameterState::Identified) << name << "\n" << states(result);
        EXPECT_TRUE(found.significant) << name;
        EXPECT_NEAR(found.value, value, 2.0 * found.interval_95) << name;
    }
    EXPECT_LT(result.rms_mm, 0.001);
    const auto data = machineData(scene().file.machine, result);
    const auto pivot = std::ranges::find(data, "MD24550 $MC_TRAFO5_BASE_TOOL_1[2]", &MachineDatum::name);
    ASSERT_NE(pivot, data.end());
    EXPECT_NEAR(pivot->change, 0.05, 0.01);
}

TEST(Calibration, RefusesByNameWhatOnlyActsTogether) {
    base::Random random(seed + 1);
    const auto result = scene().run({{"pivot_length_mm", 0.05}}, random, false);
    const auto& pivot = find(result, "pivot_length_mm");
    const auto& tool = find(result, "tool_length_mm");
    EXPECT_EQ(pivot.state, ParameterState::Inseparable) << states(result);
    EXPECT_EQ(tool.state, ParameterState::Inseparable);
    EXPECT_EQ(pivot.with, std::vector<std::string>{"tool_length_mm"});
    EXPECT_EQ(tool.with, std::vector<std::string>{"pivot_length_mm"});
    EXPECT_NE(tool.remedy.find("presetter"), std::string::npos);
    // R(C)·(tip by zero A)/arm + (tip by place of A) = −(tip by place of C): with a ball these three are two.
    EXPECT_EQ(find(result, "zero_A_deg").with, (std::vector<std::string>{"axis_C_y_mm", "axis_A_y_mm"}));
    EXPECT_FALSE(result.corrections().contains("pivot_length_mm"));
}

TEST(Calibration, CorrectedMachineCutsRight) {
    base::Random random(seed + 2);
    const MachineErrors hidden{{"pivot_length_mm", 0.06}, {"axis_A_y_mm", 0.02}, {"axis_C_x_mm", 0.03}};
    const auto result = scene().run(hidden, random);
    const kinematics::Machine corrected(correctedMachine(scene().file.machine, result.corrections()));
    // The same poses asked of both definitions: the corrected one's axis positions put the tool where it belongs.
    const auto worst = [&](const kinematics::Machine& believed) {
        double out = 0.0;
        const auto real =
            realMachineBehind(scene().file.machine, scene().setup, hidden, believed.definition(), scene().setup, {})
                .value();
        const auto track = idealTrack(scene().job, believed, scene().setup).value();
        for (std::size_t i = 0; i < track.size(); i += 50) {
            const kinematics::AxisValues values{.linear_mm = {track.axes[i][0], track.axes[i][1], track.axes[i][2]},
                                                .rotary_rad = {track.axes[i][3], track.axes[i][4]}};
            const Vector3 wanted =
                believed.forward(values, scene().setup.tool_length_mm).tip_mm - scene().setup.wcs_origin_mm;
            out = std::max(out, (real.place(track.axes[i]).tip_mm - wanted).norm());
        }
        return out;
    };
    EXPECT_GT(worst(scene().machine), 0.03);
    EXPECT_LT(worst(corrected), 0.012);
}

TEST(Calibration, IntervalsHoldAndNothingIsFoundWhereNothingIs) {
    constexpr int machines = 8;
    int looks = 0;
    int outside = 0;
    int found = 0;
    for (int i = 0; i < machines; ++i) {
        base::Random random = base::Random(seed + 3).split(static_cast<std::uint64_t>(i));
        const MachineErrors hidden = i % 2 == 0 ? drawErrors(scene().machine, random) : MachineErrors{};
        const auto result = scene().run(hidden, random);
        for (const FoundParameter& one : result.parameters) {
            if (one.state != ParameterState::Identified || one.known) continue;
            const auto truth = hidden.find(one.parameter.name);
            ++looks;
            if (std::abs(one.value - (truth == hidden.end() ? 0.0 : truth->second)) > one.interval_95) ++outside;
            if (hidden.empty() && one.significant) ++found;
        }
    }
    EXPECT_GT(looks, 40);
    // Binomial with 5 %: far out in the tail (99.99 %) at about twice the mean plus five.
    EXPECT_LE(outside, looks / 10 + 5) << looks;
    EXPECT_LE(found, looks / 10 + 5);
}

TEST(Calibration, RefusesWhatItCannotUse) {
    EXPECT_EQ(calibrate(scene().file.machine, scene().setup, {}, {}).error().front().code, "calibrate.no-parts");
    inspect::MeasuredPoints few;
    few.positions.assign(10, Vector3(0, 0, 31.0));
    const CalibrationPart part{.name = "few",
                               .job = &scene().job,
                               .track = &scene().track,
                               .nominal = &scene().nominal,
                               .points = &few,
                               .probe_radius_mm = 1.0};
    EXPECT_EQ(calibrate(scene().file.machine, scene().setup, {part}, {}).error().front().code, "calibrate.points");
    ArtefactOptions flat;
    flat.largest_tilt_rad = 0.0;
    EXPECT_EQ(planArtefact(flat).error().front().code, "artefact.option");
}

}  // namespace
}  // namespace cusp::loop
