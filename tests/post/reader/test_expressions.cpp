// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// R parameters, DEF and arithmetic, against values worked out by hand.
#include "nc_recorder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace cusp::post::reader::test {
namespace {

struct Expression {
    const char* text;
    double value;
};

class Evaluates : public testing::TestWithParam<Expression> {};

TEST_P(Evaluates, AsTheControlDoes) {
    const Recording out =
        run(fmt::format("DEF REAL _HOME=-10, _FAR\nDEF INT COUNT=2.6\nR1=3 R10=R1*2\nG0 X={} Y0 Z0\nM30\n",
                        GetParam().text),
            shippedMachine("three-axis"));
    ASSERT_EQ(out.problems, "");
    EXPECT_NEAR(out.motions[0].motion.end_pose->tip_mm.x, GetParam().value, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Expressions, Evaluates,
                         testing::Values(Expression{"1+2*3", 7}, Expression{"(1+2)*3", 9}, Expression{"2-3-4", -5},
                                         Expression{"8/4/2", 1}, Expression{"-R1", -3}, Expression{"--R1", 3},
                                         Expression{"R10/R1", 2}, Expression{"_HOME-_FAR", -10}, Expression{"COUNT", 3},
                                         Expression{"SIN(30)*2", 1}, Expression{"COS(60)", 0.5},
                                         Expression{"TAN(45)", 1}, Expression{"ATAN2(1,-1)", 135},
                                         Expression{"SQRT(R1*R1+16)", 5}, Expression{"ABS(_HOME)", 10},
                                         Expression{"ASIN(0.5)", 30}, Expression{"7 DIV 2", 3},
                                         Expression{"7 MOD 4", 3}, Expression{"POT(R1)", 9},
                                         Expression{"TRUNC(-2.7)", -2}, Expression{"ROUND(2.5)", 3}));

TEST(Expressions, AWordEndsWhereNoOperatorFollows) {
    const Recording out = run("R1=2\nG0 X=R1 Y=R1 -1 Z=(R1)\nM30\n", shippedMachine("three-axis"));
    ASSERT_EQ(out.problems, "");
    EXPECT_EQ(norm(out.motions[0].motion.end_pose->tip_mm - Vector3{2, 1, 2}), 0.0);
}

TEST(Expressions, AssignmentsInOneBlockTakeEffectInOrder) {
    const Recording out = run("R1=1 R2=R1+1 R1=R2*10\nG0 X=R1 Y=R2 Z0\nM30\n", shippedMachine("three-axis"));
    ASSERT_EQ(out.problems, "");
    EXPECT_EQ(norm(out.motions[0].motion.end_pose->tip_mm - Vector3{20, 2, 0}), 0.0);
}

}  // namespace
}  // namespace cusp::post::reader::test
