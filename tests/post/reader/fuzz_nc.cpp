// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of the 840D reader: any bytes are a program, and none may end it but with a value.
#include <cusp/post/reader/program_reader.hpp>

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

namespace {

using namespace cusp::post;

class Nowhere : public reader::ProgramSink {
public:
    void motion(const reader::ExecutedMotion&) override {}
    void event(const reader::BlockPlace&, const reader::ExecutedEvent&) override {}
};

/// A C/A head without anything the reader does not use.
MachineFile machineFile() {
    MachineFile file;
    file.machine.chain = {"workpiece", "base", "X", "Y", "Z", "C", "A", "tool"};
    for (const char* name : {"X", "Y", "Z"}) file.machine.linear[name] = {};
    file.machine.rotary["C"].direction = {0.0, 0.0, 1.0};
    file.machine.rotary["C"].winding = cusp::machine::RotaryAxis::Winding::Endless;
    file.machine.rotary["A"].direction = {1.0, 0.0, 0.0};
    return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const MachineFile machine = machineFile();
    std::istringstream in(std::string(data, data + size));
    Nowhere sink;
    cusp::base::Diagnostics report;
    reader::readProgram(in, "fuzz.mpf", machine, {}, sink, report);
    return 0;
}
