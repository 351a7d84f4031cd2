// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Printing and reading are each other's inverse, for thousands of random structs.
#include "everything.hpp"

#include <cusp/base/random.hpp>

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace {

using namespace cusp::base;
using namespace cusp::base::testing;

/// What a user may write, as the struct holds it: rounded decimals mostly, any bits at times.
double drawInside(Random& random, const char* key, double low, double high) {
    const double bits = std::bit_cast<double>(random.next());
    double written = random.uniform(low, high);
    if (high < 1e9 && random.chance(0.7)) {
        const double scale = std::pow(10.0, static_cast<double>(random.integer(0, 9)));
        written = std::round(written * scale) / scale;
    } else if (random.chance(0.3) && std::isfinite(bits) && bits >= low && bits <= high && std::abs(bits) > 1e-300) {
        written = bits;
    }
    return unitOfKey(key).toInside(written) + 0.0;
}

std::string drawText(Random& random) {
    static const std::vector<std::string> pieces{"a",    "Z9", " ",  "\"", "\\", "\n", "\t", "\x01",
                                                 "\x7F", "ü",  "刀", ".",  "#",  "'",  "= ["};
    std::string out;
    for (std::uint64_t i = random.below(8); i > 0; --i)
        out += pieces[static_cast<std::size_t>(random.below(pieces.size()))];
    return out;
}

Axis drawAxis(Random& random) {
    Axis axis;
    axis.min_rad = drawInside(random, "x_deg", -360.0, 0.0);
    axis.max_rad = drawInside(random, "x_deg", 0.0, 360.0);
    if (random.chance(0.5)) axis.home_rad = drawInside(random, "x_deg", -180.0, 180.0);
    return axis;
}

Everything drawEverything(Random& random) {
    Everything out;
    out.plain = drawInside(random, "x", -1e300, 1e300);
    out.lead_rad = drawInside(random, "x_deg", -180.0, 180.0);
    out.feed_mm_per_s = drawInside(random, "x_mm_per_min", -1e5, 1e5);
    out.limited = drawInside(random, "x", 1.0, 9.0);
    out.positive_mm = drawInside(random, "x_mm", 1.0, 1e6);
    out.count = random.integer(1, std::int64_t{1} << 62);
    out.on = random.chance(0.5);
    out.name = drawText(random);
    for (double& x : out.direction) x = drawInside(random, "x", -1.0, 1.0);
    for (double& x : out.size_mm) x = drawInside(random, "x_mm", -1e4, 1e4);
    for (std::uint64_t i = random.below(4); i > 0; --i)
        out.angles_rad.push_back(drawInside(random, "x_deg", -720.0, 720.0));
    out.names.clear();
    for (std::uint64_t i = random.below(4); i > 0; --i) out.names.push_back(drawText(random));
    for (std::uint64_t i = random.below(4); i > 0; --i)
        out.rotary_rad[drawText(random)] = drawInside(random, "x_deg", -180.0, 180.0);
    if (random.chance(0.5)) out.spare_mm = drawInside(random, "x_mm", -10.0, 10.0);
    if (random.chance(0.5)) out.remark = drawText(random);
    out.colour = random.chance(0.5) ? Everything::Colour::Red : Everything::Colour::Green;
    if (random.chance(0.5)) out.second_colour = Everything::Colour::Red;
    out.axis = drawAxis(random);
    if (random.chance(0.5)) out.tail = drawAxis(random);
    out.steps.clear();
    for (std::uint64_t i = random.below(3); i > 0; --i) out.steps.push_back({drawText(random), drawAxis(random)});
    for (std::uint64_t i = random.below(3); i > 0; --i) out.axes[drawText(random)] = drawAxis(random);
    return out;
}

TEST(SchemaRoundTrip, PrintThenReadIsTheSameStruct) {
    constexpr std::uint64_t seed = 20240612;
    RecordProperty("seed", std::to_string(seed));
    Random random(seed);
    for (int i = 0; i < 3000; ++i) {
        const Everything value = drawEverything(random);
        const std::string text = everythingSection().toToml(value, i % 2 == 0 ? PrintDocs::No : PrintDocs::Yes);
        Diagnostics report;
        const Everything back = readEverything(text, report);
        ASSERT_EQ(toText(report), "") << "seed " << seed << ", struct " << i << "\n" << text;
        ASSERT_TRUE(back == value) << "seed " << seed << ", struct " << i << "\n" << text;
    }
}

/// Decimals of up to 12 digits come back letter by letter in every unit, not only with the same value.
TEST(SchemaRoundTrip, WrittenNumbersComeBackAsWritten) {
    constexpr std::uint64_t seed = 20240613;
    RecordProperty("seed", std::to_string(seed));
    Random random(seed);
    for (const char* key : {"x", "x_mm", "x_um", "x_deg", "x_mm_per_min", "x_m_per_min", "x_deg_per_min", "x_percent",
                            "x_inch", "x_ms", "x_hours", "x_kw"})
        for (int i = 0; i < 5000; ++i) {
            const std::string digits = std::to_string(random.integer(1, 999999));
            const std::string written =
                (random.chance(0.5) ? "-" : "") + digits + "." + std::to_string(random.integer(0, 99999)) + "1";
            const FieldInfo info = describeField<double>(key, "", {});
            ASSERT_EQ(printValue(unitOfKey(key).toInside(std::stod(written)), info), written) << key;
        }
}

}  // namespace
