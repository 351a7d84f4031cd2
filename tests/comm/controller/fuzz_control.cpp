// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Any bytes as a program for the virtual control, from memory or through the FIFO: it ends in an alarm, never in a crash.
#include <cusp/comm/controller/virtual_control.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const auto file = cusp::post::readMachineFile(CUSP_SOURCE_DIR "/machines/fooke-endura-ca.toml");
    if (!file) std::abort();
    static const cusp::kinematics::Machine machine(file->machine);
    if (size > 4096) return 0;
    cusp::comm::ControlOptions options;
    options.wcs_origin_mm = {3000.0, 0.0, -700.0};
    options.look_ahead_blocks = 70;
    cusp::comm::VirtualControl control(*file, machine, options);
    const std::string text(data, data + size);
    constexpr double seconds = 3.0;
    if (size % 2 == 0 ? control.select("P.MPF", text) : control.selectFifo("P.MPF") && control.feed(text)) {
        static_cast<void>(control.start());
        control.runToRest(0.5 * seconds);
        control.stop();
        control.runToRest(0.5 * seconds);
    }
    return 0;
}
