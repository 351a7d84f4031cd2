// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzzes the readers of machine and setup files: any bytes give a value or diagnostics, what was read prints as text that
// reads back the same, and a machine that was read can be computed with.
#include <cusp/kinematics/laws.hpp>
#include <cusp/machine/setup_definition.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string>

namespace {

[[noreturn]] void stopWith(const char* what, const std::string& text) {
    std::cerr << what << ":\n" << text;
    std::abort();
}

void fuzzMachine(const std::string& text) {
    const auto file = cusp::post::parseMachineFile(text, "fuzz.toml");
    if (!file) {
        if (cusp::base::toText(file.error()).empty()) stopWith("refused without a word", text);
        return;
    }
    const std::string printed = cusp::post::toToml(*file);
    const auto again = cusp::post::parseMachineFile(printed, "again.toml");
    if (!again) stopWith("a machine does not read back", printed + cusp::base::toText(again.error()));
    if (cusp::post::toToml(*again) != printed) stopWith("a machine reads back as another", printed);
    const cusp::kinematics::Machine machine(file->machine);
    constexpr std::uint64_t poses = 3;
    static_cast<void>(cusp::kinematics::runLaws(machine, 1, poses));
    static_cast<void>(cusp::kinematics::checkAnchors(machine));
    static_cast<void>(cusp::machine::unknownProvenance(file->machine));
}

void fuzzSetup(const std::string& text) {
    const auto setup = cusp::machine::readSetup(text, "fuzz.toml");
    if (!setup) {
        if (cusp::base::toText(setup.error()).empty()) stopWith("refused without a word", text);
        return;
    }
    const auto& section = cusp::machine::setupSection();
    const std::string printed = section.toToml(*setup);
    const auto again = cusp::machine::readSetup(printed, "again.toml");
    if (!again) stopWith("a setup does not read back", printed + cusp::base::toText(again.error()));
    if (section.toToml(*again) != printed) stopWith("a setup reads back as another", printed);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(data, data + size);
    fuzzMachine(text);
    fuzzSetup(text);
    return 0;
}
