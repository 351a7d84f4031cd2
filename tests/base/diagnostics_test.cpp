// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The text of a problem is a contract, and so is which problems a full list keeps.
#include <cusp/base/diagnostics.hpp>
#include <cusp/base/result.hpp>

#include <gtest/gtest.h>

namespace {

using cusp::base::Diagnostic;
using cusp::base::Diagnostics;
using cusp::base::Severity;
using cusp::base::toText;

TEST(Diagnostics, TextLeavesOutWhatIsNotKnown) {
    Diagnostic d{Severity::Error, "a.b", "message", {"P.apt", 12, 5, "rotary.A.min_deg"}};
    EXPECT_EQ(toText(d), "P.apt:12:5: error: rotary.A.min_deg: message [a.b]");
    d.where.key.clear();
    EXPECT_EQ(toText(d), "P.apt:12:5: error: message [a.b]");
    d.where.column = 0;
    EXPECT_EQ(toText(d), "P.apt:12: error: message [a.b]");
    d.where.line = 0;
    d.severity = Severity::Warning;
    EXPECT_EQ(toText(d), "P.apt: warning: message [a.b]");
    d.where.file.clear();
    d.severity = Severity::Note;
    d.code.clear();
    EXPECT_EQ(toText(d), "note: message");
    d.where.line = 3;
    EXPECT_EQ(toText(d), "3: note: message");
}

TEST(Diagnostics, TextCannotSteerATerminal) {
    const Diagnostic d{Severity::Error, "a.b", "found '\x1b[2J\n'", {"a\rb", 0, 0, {}}};
    EXPECT_EQ(toText(d), "a\\x0db: error: found '\\x1b[2J\\x0a' [a.b]");
}

TEST(Diagnostics, CountsAllButKeepsAtMostTheCap) {
    Diagnostics list(3);
    for (int i = 0; i < 5; ++i) list.error("x.y", std::to_string(i));
    EXPECT_EQ(list.errorCount(), 5U);
    EXPECT_EQ(list.size(), 3U);
    EXPECT_EQ(list.suppressed(), 2U);
    EXPECT_EQ(toText(list), "error: 0 [x.y]\nerror: 1 [x.y]\nerror: 2 [x.y]\n… and 2 more\n");
}

TEST(Diagnostics, ErrorTakesThePlaceOfTheLatestWarning) {
    Diagnostics list(3);
    list.warning("w", "1");
    list.error("e", "2");
    list.warning("w", "3");
    list.error("e", "4");
    list.note("n", "5");
    EXPECT_EQ(toText(list), "warning: 1 [w]\nerror: 2 [e]\nerror: 4 [e]\n… and 2 more\n");
    list.error("e", "6");
    list.error("e", "7");
    EXPECT_EQ(toText(list), "error: 2 [e]\nerror: 4 [e]\nerror: 6 [e]\n… and 4 more\n");
    EXPECT_EQ(list.errorCount(), 4U);
    EXPECT_EQ(list.warningCount(), 2U);
}

TEST(Diagnostics, AppendKeepsTheCounts) {
    Diagnostics full(1);
    full.warning("w", "1");
    full.warning("w", "2");
    full.error("e", "3");
    Diagnostics list;
    list.error("e", "0");
    list.append(full);
    EXPECT_EQ(toText(list), "error: 0 [e]\nerror: 3 [e]\n… and 2 more\n");
    EXPECT_EQ(list.errorCount(), 2U);
    EXPECT_EQ(list.warningCount(), 2U);
    list.append(list);
    EXPECT_EQ(list.errorCount(), 4U);
    EXPECT_EQ(list.size(), 4U);
    EXPECT_EQ(list.suppressed(), 4U);
}

TEST(Diagnostics, FailCarriesOneError) {
    const cusp::base::Result<int> result = cusp::base::fail("a.b", "no", {"F", 1, 2, {}});
    ASSERT_FALSE(result.has_value());
    EXPECT_TRUE(result.error().hasErrors());
    EXPECT_EQ(toText(result.error()), "F:1:2: error: no [a.b]\n");
}

}  // namespace
