// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of what the CAD reader hands over: any bytes end in faces that are sound, or in a problem.
#include "cad_stream.hpp"

#include <cstdint>
#include <cstdlib>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cusp::geometry;
    const std::string bytes(data, data + size);
    const auto model = cad::fromStream(bytes, "fuzz");
    if (!model) {
        if (!model.error().hasErrors()) std::abort();
        return 0;
    }
    for (const auto& face : model->faces) {
        const auto made = toFace(face.surface, Outward::DuCrossDv);
        if (made && made->patches().empty()) std::abort();
    }
    if (!cad::fromStream(cad::toStream(*model), "fuzz")) std::abort();
    return 0;
}
