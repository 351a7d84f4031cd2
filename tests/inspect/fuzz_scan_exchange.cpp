// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of what cusp and cusp-scan hand each other: any bytes end in what encodes to the same bytes, or in nothing.
#include "scan_exchange.hpp"

#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cusp::inspect;
    const std::string bytes(data, data + size);
    if (const auto request = decodeRequest(bytes); request && encode(*request) != bytes) std::abort();
    if (const auto answer = decodeAnswer(bytes); answer && encode(*answer) != bytes) std::abort();
    return 0;
}
