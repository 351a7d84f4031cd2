// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The recording sink.
#include "nc_recorder.hpp"

#include <cstdlib>
#include <fstream>
#include <iostream>
#include <sstream>

namespace cusp::post::reader::test {

namespace {

class Recorder : public ProgramSink {
public:
    explicit Recorder(Recording& out) : out_(out) {}
    void motion(const ExecutedMotion& motion) override {
        out_.motions.push_back({motion, *motion.state});
        out_.motions.back().motion.state = nullptr;
    }
    void event(const BlockPlace& place, const ExecutedEvent& event) override { out_.events.emplace_back(place, event); }

private:
    Recording& out_;
};

}  // namespace

MachineFile shippedMachine(const std::string& name) {
    auto machine = readMachineFile(CUSP_SOURCE_DIR "/machines/" + name + ".toml");
    if (!machine) {
        std::cerr << base::toText(machine.error()) << '\n';
        std::abort();
    }
    return *std::move(machine);
}

Recording run(const std::string& program, const MachineFile& machine, const ReaderOptions& options) {
    Recording out;
    Recorder recorder(out);
    std::istringstream in(program);
    out.summary = readProgram(in, "", machine, options, recorder, out.report);
    for (const base::Diagnostic& problem : out.report) out.problems += base::toText(problem) + "\n";
    return out;
}

Recording runLines(const std::string& lines) {
    static const MachineFile machine = shippedMachine("head-c200-a95");
    return run(lines + "\nM30\n", machine);
}

std::string fileText(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

}  // namespace cusp::post::reader::test
