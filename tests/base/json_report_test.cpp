// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The stamp, the diagnostics and the refusal of numbers JSON cannot say.
#include <cusp/base/json_report.hpp>
#include <cusp/base/version.hpp>

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace {

using namespace cusp::base;

TEST(JsonReport, StartsWithTheStamp) {
    Json report = jsonReport("post", 2);
    report["blocks"] = 17;
    EXPECT_EQ(jsonText(report).value(), "{\n  \"schema\": 2,\n  \"command\": \"post\",\n  \"version\": \"" +
                                            std::string(version()) + "\",\n  \"blocks\": 17\n}\n");
}

TEST(JsonReport, DiagnosticsCarryOnlyWhatIsKnown) {
    Diagnostics list(2);
    list.error("a.b", "no", {"F.apt", 3, 0, {}});
    list.warning("c.d", "hm", {{}, 0, 0, "axis"});
    list.note("e.f", "so");
    EXPECT_EQ(diagnosticsToJson(list).dump(),
              R"({"errors":1,"warnings":1,"suppressed":1,"items":[)"
              R"({"severity":"error","code":"a.b","message":"no","file":"F.apt","line":3},)"
              R"({"severity":"warning","code":"c.d","message":"hm","key":"axis"}]})");
}

TEST(JsonReport, NumbersThatAreNoneAreErrors) {
    Json report = jsonReport("evaluate", 1);
    report["values"] = {1.0, std::nan(""), 2.0};
    report["deep"]["a/b"] = -std::numeric_limits<double>::infinity();
    const auto text = jsonText(report);
    ASSERT_FALSE(text.has_value());
    EXPECT_EQ(toText(text.error()), "error: /values/1: this result is no finite number [json.not-finite]\n"
                                    "error: /deep/a~1b: this result is no finite number [json.not-finite]\n");
}

TEST(JsonReport, BytesThatAreNoUtf8DoNotThrow) {
    Json report;
    report["name"] = "K\xF6ln";
    EXPECT_EQ(jsonText(report).value(), "{\n  \"name\": \"K\xEF\xBF\xBDln\"\n}\n");
}

TEST(JsonReport, NumbersReadBackExactly) {
    for (const double value : {0.1, 1.0 / 3.0, 1e-300, 123456.789e200, std::numeric_limits<double>::denorm_min()}) {
        Json report;
        report["value"] = value;
        EXPECT_EQ(Json::parse(jsonText(report).value())["value"].get<double>(), value);
    }
}

}  // namespace
