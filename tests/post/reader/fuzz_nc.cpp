// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of the 840D reader: any bytes are a program, and none may end it but with a value.
#include <cusp/post/reader/move_sampler.hpp>
#include <cusp/post/reader/program_reader.hpp>

#include <cstddef>
#include <cstdint>
#include <sstream>
#include <string>

namespace {

using namespace cusp::post;

/// Looks at every motion as verification does.
class Looker : public reader::ProgramSink {
public:
    explicit Looker(const MachineFile& machine) : chain_(machine.machine) {}
    void motion(const reader::ExecutedMotion& motion) override {
        if (!motion.start_pose || !motion.end_pose) return;
        static_cast<void>(reader::poseAt(motion, chain_, 0.5));
        static_cast<void>(reader::bendOf(motion, chain_));
    }
    void event(const reader::BlockPlace&, const reader::ExecutedEvent&) override {}

private:
    reader::ForwardChain chain_;
};

/// A C/A head without anything the reader does not use.
MachineFile machineFile() {
    MachineFile file;
    file.machine.chain = {"workpiece", "base", "X", "Y", "Z", "C", "A", "tool"};
    file.machine.linear["X"].direction = {1.0, 0.0, 0.0};
    file.machine.linear["Y"].direction = {0.0, 1.0, 0.0};
    file.machine.linear["Z"].direction = {0.0, 0.0, 1.0};
    file.machine.rotary["C"].direction = {0.0, 0.0, 1.0};
    file.machine.rotary["C"].winding = cusp::machine::RotaryAxis::Winding::Endless;
    file.machine.rotary["A"].direction = {1.0, 0.0, 0.0};
    return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const MachineFile machine = machineFile();
    std::istringstream in(std::string(data, data + size));
    Looker sink(machine);
    cusp::base::Diagnostics report;
    reader::ReaderOptions options;
    options.setup.tool_length_mm = 100.0;
    reader::readProgram(in, "fuzz.mpf", machine, options, sink, report);
    return 0;
}
