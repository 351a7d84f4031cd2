// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The two ends of the house, joined by text alone.
#include "posted_path.hpp"

#include <cusp/base/random.hpp>
#include <cusp/base/units.hpp>
#include <cusp/post/writer/sinumerik_writer.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <sstream>
#include <stdexcept>

namespace cusp::post::test {

std::vector<std::string> shippedMachineNames() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(CUSP_SOURCE_DIR "/machines"))
        if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
    std::sort(names.begin(), names.end());
    return names;
}

MachineFile shippedMachine(const std::string& name) {
    auto file = readMachineFile(CUSP_SOURCE_DIR "/machines/" + name + ".toml");
    if (!file) throw std::runtime_error(base::toText(file.error()));
    return *std::move(file);
}

Posted post(const std::string& cl_text, MachineFile machine, const PostOptions& options) {
    Posted out;
    const ProgramForm form = options.form.value_or(machine.control.form);
    machine.control.format = sufficientFormat(machine, form, out.report);
    const kinematics::Machine model(machine.machine);
    SinumerikWriter writer([&](std::string_view text) { out.program += text; }, machine, {"P", "", {}});
    ProgramPlanner planner(machine, model, options, "P.cls", writer, out.report);
    std::istringstream in(cl_text);
    toolpath::ClReader reader(in, "P.cls");
    for (toolpath::ClRecord record; reader.next(record);) planner.take(record);
    out.summary = planner.finish();
    out.blocks = writer.finish();
    out.report.append(reader.report());
    return out;
}

verify::VerifyReport verify(const std::string& program, const std::string& cl_text, const MachineFile& machine,
                            const verify::VerifyOptions& options) {
    std::istringstream cl(cl_text);
    base::Diagnostics warnings;
    const auto path = toolpath::readToolPath(cl, "P.cls", {}, warnings);
    if (!path) throw std::runtime_error(base::toText(path.error()));
    std::istringstream in(program);
    auto report = verify::verifyProgram(in, "P.MPF", machine, &*path, options);
    if (report) return *std::move(report);
    verify::VerifyReport refused;
    refused.findings = report.error();
    return refused;
}

std::string wanderingPath(std::uint64_t seed, int points, double least_tilt_deg, double most_tilt_deg) {
    base::Random random(seed);
    double x = random.uniform(-100.0, 100.0);
    double y = random.uniform(-100.0, 100.0);
    double z = random.uniform(-50.0, 50.0);
    double tilt_deg = random.uniform(least_tilt_deg, most_tilt_deg);
    double azimuth_deg = random.uniform(-120.0, 120.0);
    std::string text = "UNITS/MM\nTOOL PATH/WANDER,TOOL,BALL_6\nTLDATA/MILL,6.0,3.0,50.0,0.0,0.0\n"
                       "MSYS/0.0,0.0,0.0,1.0,0.0,0.0,0.0,1.0,0.0\nSPINDL/RPM,8000,CLW\nCOOLNT/ON\n";
    const auto go = [&](double lift) {
        const double tilt = base::radFromDeg(tilt_deg);
        const double azimuth = base::radFromDeg(azimuth_deg);
        text += fmt::format("GOTO/{:.6f},{:.6f},{:.6f},{:.9f},{:.9f},{:.9f}\n", x, y, z + lift,
                            std::sin(tilt) * std::cos(azimuth), std::sin(tilt) * std::sin(azimuth), std::cos(tilt));
    };
    text += "RAPID\n";
    go(60.0);
    text += "FEDRAT/MMPM,1500.0\n";
    for (int i = 0; i < points; ++i) {
        go(0.0);
        x += random.uniform(-4.0, 6.0);
        y += random.uniform(-5.0, 5.0);
        z += random.uniform(-1.0, 1.0);
        tilt_deg = std::clamp(tilt_deg + random.uniform(-3.0, 3.0), least_tilt_deg, most_tilt_deg);
        azimuth_deg = std::clamp(azimuth_deg + random.uniform(-6.0, 6.0), -150.0, 150.0);
    }
    text += "RAPID\n";
    go(60.0);
    return text + "END-OF-PATH\n";
}

}  // namespace cusp::post::test
