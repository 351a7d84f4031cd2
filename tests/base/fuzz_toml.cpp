// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzzes the TOML reader: any bytes give a value or diagnostics, and what was read prints as text that reads back the same.
#include "everything.hpp"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cusp::base;
    using namespace cusp::base::testing;
    const std::string text(data, data + size);
    Diagnostics report;
    const Everything value = readEverything(text, report);
    if (report.hasErrors()) {
        if (toText(report).empty()) std::abort();
        return 0;
    }
    const std::string printed = everythingSection().toToml(value, size % 2 == 0 ? PrintDocs::No : PrintDocs::Yes);
    Diagnostics again;
    const Everything back = readEverything(printed, again);
    if (again.hasErrors() || !(back == value)) {
        std::cerr << "does not read back:\n" << printed << toText(again);
        std::abort();
    }
    return 0;
}
