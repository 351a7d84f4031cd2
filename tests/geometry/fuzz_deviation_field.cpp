// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of deviation fields in reports: any bytes end in a field that gives finite numbers, or in a problem.
#include <cusp/geometry/deviation_field.hpp>

#include <cmath>
#include <cstdint>
#include <cstdlib>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace cusp;
    const std::string text(data, data + size);
    const auto field = geometry::readReportedDeviationField(text, "fuzz", "datum");
    if (!field) {
        if (!field.error().hasErrors()) std::abort();
        return 0;
    }
    static_cast<void>(field->deviation({10.0, -20.0, 3.0}, geometry::Vector3::UnitZ()));
    static_cast<void>(field->covers({1e300, 0.0, 0.0}, 1.0));
    const auto again = geometry::DeviationField::fromJson(field->toJson(), {});
    if (!again || again->toJson() != field->toJson()) std::abort();
    return 0;
}
