// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of verification: any bytes are a program, held against one CL file and one setup.
#include <cusp/post/verify/verify_program.hpp>

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

namespace {

using namespace cusp;

post::MachineFile machineFile() {
    post::MachineFile file;
    file.machine.chain = {"workpiece", "base", "X", "Y", "Z", "C", "A", "tool"};
    file.machine.linear["X"].direction = {1.0, 0.0, 0.0};
    file.machine.linear["Y"].direction = {0.0, 1.0, 0.0};
    file.machine.linear["Z"].direction = {0.0, 0.0, 1.0};
    for (auto& [name, axis] : file.machine.linear) axis.max_mm = 500.0;
    file.machine.rotary["C"].direction = {0.0, 0.0, 1.0};
    file.machine.rotary["C"].winding = machine::RotaryAxis::Winding::Endless;
    file.machine.rotary["A"].direction = {1.0, 0.0, 0.0};
    file.machine.rotary["A"].min_rad = -1.7;
    file.machine.rotary["A"].max_rad = 1.7;
    return file;
}

toolpath::ToolPath clFile() {
    std::istringstream in(
        "UNITS/MM\nTOOL PATH/A,TOOL,T1\nLOAD/TOOL,5\nSPINDL/RPM,1000,CLW\nCOOLNT/ON\nRAPID\nGOTO/0,0,9,0,0,1\n"
        "FEDRAT/MMPM,100\nGOTO/0,0,0\nGOTO/10,0,0,0,0.6,0.8\nGOTO/10,10,0,0.6,0,0.8\nCYCLE/DRILL,DEPTH,5,MMPM,100,"
        "CLEAR,2\nGOTO/20,0,0,0,0,1\nCYCLE/OFF\nEND-OF-PATH\n");
    base::Diagnostics warnings;
    auto path = toolpath::readToolPath(in, "P.cls", {}, warnings);
    return path ? *std::move(path) : toolpath::ToolPath{};
}

machine::SetupDefinition setupFile() {
    auto setup = machine::readSetup(
        "schema = 1\nname = \"S\"\n[work_offset.G54]\norigin_mm = [100.0, 100.0, 50.0]\n[[tool]]\nnumber = 5\n"
        "length_mm = 100.0\n",
        "S.toml");
    return setup ? *std::move(setup) : machine::SetupDefinition{};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const post::MachineFile machine = machineFile();
    static const toolpath::ToolPath path = clFile();
    static const machine::SetupDefinition setup = setupFile();
    std::istringstream in(std::string(data, data + size));
    post::verify::VerifyOptions options;
    options.setup = &setup;
    const auto report = post::verify::verifyProgram(in, "fuzz.mpf", machine, &path, options);
    if (report) static_cast<void>(post::verify::toText(*report));
    return 0;
}
