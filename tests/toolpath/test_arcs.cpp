// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Arcs in every dialect's form: sense, plane, helix, whole circle, and what is refused.
#include "cl_text.hpp"

#include <cusp/base/random.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace cusp::toolpath::test {
namespace {

std::string nx(const std::string& body) {
    return readOut("TOOL PATH/A,TOOL,B\nFEDRAT/MMPM,60.\nRAPID\nGOTO/2,0,0\n" + body + "END-OF-PATH\n").text;
}

TEST(Circle, SenseOfTheAxisIsTheDialects) {
    // A quarter from (2,0) to (0,2) about the origin: counter-clockwise.
    EXPECT_NE(nx("CIRCLE/0,0,0,0,0,-1,2,.06,.5,30,0\nPAINT/COLOR,31\nGOTO/0,2,0\n")
                  .find("5 arc 0 2 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 2\n"),
              std::string::npos);
    EXPECT_EQ(recordsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2\nGOTO/0,2,0"),
              "1 go 2 0 0 axis 0 0 1\n2 arc 0 2 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 2\n");
    EXPECT_EQ(readOut("UNIT/MM\nTRNTYP/WORLD\nGOTO/2,0,0\nCIRCLE/0,0,0,0,0,-1.\nGOTO/0,2,0\nFINI\n").text,
              "3 go 2 0 0 axis 0 0 1\n4 arc 0 2 0 axis 0 0 1 center 0 0 0 normal 0 0 -1 radius 2\n6 end\n");
}

TEST(Circle, WholeTurnsAndHelices) {
    EXPECT_EQ(recordsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2\nGOTO/2,0,0"),
              "1 go 2 0 0 axis 0 0 1\n2 arc 2 0 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 2 full\n");
    EXPECT_EQ(recordsOf("GOTO/2,0,5\nCIRCLE/0,0,0,0,0,-1,2\nGOTO/2,0,4"),
              "1 go 2 0 5 axis 0 0 1\n2 arc 2 0 4 axis 0 0 1 center 0 0 5 normal 0 0 -1 radius 2 full\n");
    // Rounding put the end a little before the start; a little behind it is a short arc.
    EXPECT_NE(recordsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2\nGOTO/2,-0.0001,0").find(" full"), std::string::npos);
    EXPECT_EQ(recordsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2\nGOTO/2,0.0001,0").find(" full"), std::string::npos);
}

TEST(Circle, GoesOnFromItsEnd) {
    EXPECT_EQ(recordsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2\nFEDRAT/60\nGOTO/0,2,0\nCIRCLE/0,0,0,0,0,1,2\nGOTO/-2,0,0"),
              "1 go 2 0 0 axis 0 0 1\n3 feed 1 mm/s\n2 arc 0 2 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 2\n"
              "5 arc -2 0 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 2\n");
    EXPECT_EQ(readOut("UNITS/INCHES\nGOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2\nGOTO/0,2,0\nFINI\n").text,
              "2 go 50.8 0 0 axis 0 0 1\n3 arc 0 50.8 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 50.8\n5 end\n");
    EXPECT_EQ(recordsOf("GOTO/2,0,0\nRAPID\nCIRCLE/0,0,0,0,0,1,2\nGOTO/0,2,0\nGOTO/1,1,1"),
              "1 go 2 0 0 axis 0 0 1\n3 arc 0 2 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 2\n"
              "5 go 1 1 1 axis 0 0 1\n"
              "4: warning: RAPID before an arc: the arc is made at the feed [cl.rapid-cancelled]\n");
}

TEST(Circle, RefusesWhatIsNoArc) {
    EXPECT_EQ(problemsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2\nGOTO/0,2.02,0"),
              "2: error: CIRCLE: the radius is 2 mm, but the start lies 2 mm and the end 2.02 mm from the centre; they "
              "may differ by 0.01 mm [cl.arc]\n");
    EXPECT_EQ(problemsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2.02\nGOTO/0,2,0"),
              "2: error: CIRCLE: the radius is 2.02 mm, but the start lies 2 mm and the end 2 mm from the centre; they "
              "may differ by 0.01 mm [cl.arc]\n");
    EXPECT_EQ(problemsOf("GOTO/0,0,0\nCIRCLE/0,0,0,0,0,1,0\nGOTO/0,0,0"),
              "2: error: CIRCLE: the radius is 0 mm; it must be more than 0.01 mm [cl.arc]\n");
    EXPECT_EQ(problemsOf("CIRCLE/0,0,0,0,0,1,2\nGOTO/0,2,0"),
              "1: error: CIRCLE: where the arc starts is not known: no GOTO right before it [cl.arc]\n");
    EXPECT_EQ(problemsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2\nGODLTA/0,2,0"),
              "2: error: CIRCLE is not followed by a GOTO that says where the arc ends [cl.arc]\n");
    EXPECT_EQ(problemsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2"),
              "2: error: CIRCLE is not followed by a GOTO that says where the arc ends [cl.arc]\n");
    EXPECT_EQ(problemsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2\nGOTO/0,2,0,0,1,0"),
              "2: error: CIRCLE: the tool axis turns between start and end of the arc [cl.arc]\n");
    EXPECT_EQ(problemsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,1,2,8"),
              "2: error: CIRCLE takes 6 to 7 values (centre, axis, radius …), not 8 [cl.arc]\n");
    EXPECT_EQ(problemsOf("GOTO/2,0,0\nCIRCLE/0,0,0,0,0,2,2"),
              "2: error: CIRCLE: the axis 0,0,2 has length 2; it must be 1 [cl.axis]\n");
}

TEST(Movarc, IsRightHandedAboutItsAxisAndTurnsAsItSays) {
    const std::string quarter = "1 go 2 0 0 axis 0 0 1\n2 arc 0 2 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 2\n";
    EXPECT_EQ(recordsOf("GOTO/2,0,0\nMOVARC/0,0,0,0,0,1,2,ANGLE,90\nGOTO/0,2,0"), quarter);
    EXPECT_EQ(recordsOf("GOTO/2,0,0\nMOVARC/0,0,0,0,0,1,2\nGOTO/0,2,0"), quarter);
    EXPECT_EQ(recordsOf("GOTO/2,0,0\nMOVARC/ CENTER, 0, 0, 0, AXIS, 0, 0, 1, RADIUS, 2\nGOTO/0,2,0"), quarter);
    EXPECT_EQ(recordsOf("GOTO/2,0,0\nMOVARC/0,0,0,0,0,-1,2,ANGLE,270.\nGOTO/0,2,0"),
              "1 go 2 0 0 axis 0 0 1\n2 arc 0 2 0 axis 0 0 1 center 0 0 0 normal 0 0 -1 radius 2\n");
    EXPECT_EQ(recordsOf("GOTO/2,0,0\nMOVARC/0,0,0,0,0,1,2,ANGLE,360\nGOTO/2,0,0"),
              "1 go 2 0 0 axis 0 0 1\n2 arc 2 0 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 2 full\n");
    EXPECT_EQ(readOut("UNITS/INCHES\nGOTO/2,0,0\nMOVARC/0,0,0,0,0,1,2,ANGLE,90\nGOTO/0,2,0\nFINI\n").text,
              "2 go 50.8 0 0 axis 0 0 1\n3 arc 0 50.8 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 50.8\n5 end\n");
}

TEST(Movarc, RefusesWhatDoesNotFit) {
    // A post that leaves the axis up on clockwise arcs would be read the wrong way round without its angle.
    EXPECT_EQ(problemsOf("GOTO/2,0,0\nMOVARC/0,0,0,0,0,1,2,ANGLE,90\nGOTO/0,-2,0"),
              "2: error: MOVARC: the angle is 90 degrees, but from its start to its end the arc turns by 270 about its "
              "axis [cl.arc]\n");
    EXPECT_EQ(
        problemsOf("GOTO/2,0,0\nMOVARC/0,0,0,0,0,1,2,ANGLE,720\nGOTO/2,0,-4"),
        "2: error: MOVARC: the angle is 720 degrees, but from its start to its end the arc turns by 360 about its "
        "axis [cl.arc]\n");
    const std::string not_understood = " is not understood; centre, axis, radius and ANGLE are [cl.arc]\n";
    for (const std::string body : {"0,0,0,0,0,1", "0,0,0,0,0,1,2,3", "0,0,0,0,0,1,2,ANGLE", "0,0,0,0,0,1,2,TIMES,3",
                                   "AXIS,0,0,0,0,0,1,2", "", "CENTER,0,0,0,AXIS,0,0,1,RADIUS"}) {
        EXPECT_EQ(problemsOf("GOTO/2,0,0\nMOVARC/" + body), "2: error: MOVARC/" + body + not_understood);
    }
    EXPECT_EQ(problemsOf("GOTO/2,0,0\nMOVARC/0,0,0,0,0,1,2"),
              "2: error: MOVARC is not followed by a GOTO that says where the arc ends [cl.arc]\n");
}

TEST(Nurbs, IsKeptAsItsNumbers) {
    const ReadOut out = readOut("TOOL PATH/A,TOOL,B\nFEDRAT/MMPM,250.\nGOTO/0,0,0,0,0,1\nNURBS/3,4\nKNOT/0,0,0,0\n"
                                "KNOT/1.,1.,$\n1.,1.\nCNTRL/0,0,0,1\n$$ a comment\nCNTRL/1,2,0,1\nCNTRL/2,2,0,1\n"
                                "CNTRL/3,0,0,1\nGOTO/4,0,0\nEND-OF-PATH\n");
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(out.text,
              "1 operation 'A'\n2 feed 4.166666666666667 mm/s\n3 tool - 'B'\n3 go 0 0 0 axis 0 0 1\n"
              "4 spline 3 4 knots 0 0 0 0 1 1 1 1 control 0 0 0 1 control 1 2 0 1 control 2 2 0 1 control 3 0 0 1\n"
              "13 go 4 0 0 axis 0 0 1\n14 end\n");
}

TEST(Nurbs, RefusesWhatIsNotWhole) {
    EXPECT_EQ(problemsOf("NURBS/3"), "1: error: NURBS is not followed by its CNTRL statements [cl.nurbs]\n");
    EXPECT_EQ(problemsOf("GOTO/0,0,0\nKNOT/0,1"), "2: error: KNOT without a NURBS before it [cl.nurbs]\n");
    EXPECT_EQ(problemsOf("NURBS/3\nCNTRL/0,x,0"),
              "2: error: CNTRL: 'x' is not a number [cl.number]\n"
              "1: error: NURBS is not followed by its CNTRL statements [cl.nurbs]\n");
    EXPECT_EQ(problemsOf("NURBS/3,,4"), "1: error: NURBS: '' is not a number [cl.number]\n");
    // Where the curve ends is not known.
    EXPECT_EQ(problemsOf("NURBS/3\nCNTRL/0,0,0\nGODLTA/1,0,0"),
              "3: error: GODLTA: where the tool stands is not known: no GOTO or FROM before it [cl.start-unknown]\n");
}

/// CATIA's form, as in a turning program of its own, but milling.
std::string tlon(const std::string& sense, const std::string& circle, const std::string& until,
                 const std::string& line) {
    return "AUTOPS\nINDIRV/ " + sense + "\nTLON,GOFWD/      (CIRCLE/ " + circle + "),ON," + until + "(LINE/ " + line +
           ")\n";
}

TEST(Tlon, TurnsTowardsIndirv) {
    const std::string start = "GOTO  /   20.40000,    0.00000,  -30.00000\n";
    // In the XZ plane, about −X to +Z: right-handed about +Y.
    EXPECT_EQ(recordsOf(start + tlon("0.00000, 0.00000, 1.00000", "25.00000, 0.00000, -30.00000,$\n 4.60000", "",
                                     "25.00000, 0.00000, -30.00000,$\n 25.00000, 0.00000, -25.40000")),
              "1 go 20.4 0 -30 axis 0 0 1\n4 arc 25 0 -25.4 axis 0 0 1 center 25 0 -30 normal 0 1 0 radius 4.6\n");
    EXPECT_EQ(recordsOf(start + tlon("0,0,-1", "25,0,-30,4.6", "", "25,0,-30,25,0,-34.6")),
              "1 go 20.4 0 -30 axis 0 0 1\n4 arc 25 0 -34.6 axis 0 0 1 center 25 0 -30 normal 0 -1 0 radius 4.6\n");
    // The second meeting: three quarters.
    EXPECT_EQ(recordsOf(start + tlon("0,0,1", "25,0,-30,4.6", "2,INTOF,", "25,0,-30,25,0,-34.6")),
              "1 go 20.4 0 -30 axis 0 0 1\n4 arc 25 0 -34.6 axis 0 0 1 center 25 0 -30 normal 0 1 0 radius 4.6\n");
}

TEST(Tlon, EndsWhereCircleAndLineMeet) {
    // The line is given by two points of its own; it cuts the circle of radius 5 at (4,3) and (4,-3).
    EXPECT_EQ(recordsOf("GOTO/5,0,0\n" + tlon("0,1,0", "0,0,0,5", "", "4,10,0,4,20,0")),
              "1 go 5 0 0 axis 0 0 1\n4 arc 4 3 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 5\n");
    EXPECT_EQ(recordsOf("GOTO/5,0,0\n" + tlon("0,-1,0", "0,0,0,5", "", "4,10,0,4,20,0")),
              "1 go 5 0 0 axis 0 0 1\n4 arc 4 -3 0 axis 0 0 1 center 0 0 0 normal 0 0 -1 radius 5\n");
    // A line through the start: the start itself is met last.
    EXPECT_EQ(recordsOf("GOTO/5,0,0\n" + tlon("0,1,0", "0,0,0,5", "", "0,0,0,-5,0,0")),
              "1 go 5 0 0 axis 0 0 1\n4 arc -5 0 0 axis 0 0 1 center 0 0 0 normal 0 0 1 radius 5\n");
}

TEST(Tlon, RefusesWhatIsNotClear) {
    const std::string start = "GOTO/5,0,0\n";
    EXPECT_EQ(problemsOf(start + tlon("0,1,0", "0,0,0,5", "", "0,0,0,0,-5,0")),
              "4: error: TLON: the line ends on the circle at 0,-5,0, but the arc meets it first elsewhere: where the "
              "arc ends is not clear [cl.arc]\n");
    EXPECT_EQ(problemsOf(start + tlon("0,1,0", "0,0,0,5", "", "6,0,0,6,1,0")),
              "4: error: TLON: the line does not meet the circle [cl.arc]\n");
    EXPECT_EQ(problemsOf(start + tlon("0,1,0", "0,0,0,5", "", "0,1,0,0,1,0")),
              "4: error: TLON: the line does not meet the circle [cl.arc]\n");
    EXPECT_EQ(problemsOf(start + tlon("1,0,0", "0,0,0,5", "", "0,0,0,0,5,0")),
              "4: error: TLON: INDIRV points along the radius: the sense of the arc is not clear [cl.arc]\n");
    EXPECT_EQ(problemsOf(start + tlon("0,1,0", "0,0,0,6", "", "0,0,0,0,6,0")),
              "4: error: TLON: the radius is 6 mm, but the start lies 5 mm and the end 6 mm from the centre; they may "
              "differ by 0.01 mm [cl.arc]\n");
    EXPECT_EQ(problemsOf(start + "TLON,GOFWD/(CIRCLE/0,0,0,5),ON,(LINE/0,0,0,0,5,0)"),
              "2: error: TLON: the arc needs a GOTO and an INDIRV before it, and no cycle [cl.arc]\n");
    EXPECT_EQ(problemsOf(start + "INDIRV/0,1,0\nTLON,GOFWD/C1,PAST,L1"),
              "3: error: 'TLON,GOFWD/C1,PAST,L1' is not understood; TLON,GOFWD/(CIRCLE/centre,radius),ON,(LINE/…) is "
              "[cl.unsupported-motion]\n");
    EXPECT_EQ(problemsOf("INDIRV/0,1"), "1: error: INDIRV takes 3 values, not 2 [cl.syntax]\n");
}

/// Random arcs in random planes, written by this test in two forms: both give the arc that was meant.
TEST(Arcs, BothFormsMeanTheSameArc) {
    constexpr std::uint64_t seed = 41;
    base::Random random(seed);
    const auto direction = [&random] {
        return geometry::Vector3(random.normal(), random.normal(), random.normal()).normalized();
    };
    for (int i = 0; i < 500; ++i) {
        const geometry::Vector3 normal = direction();
        const geometry::Vector3 u = normal.unitOrthogonal();
        const geometry::Vector3 v = normal.cross(u);
        const geometry::Vector3 center = 100.0 * direction();
        const double radius = random.uniform(0.5, 50.0);
        const double sweep = random.uniform(0.05, 2.0 * std::numbers::pi - 0.05);
        const geometry::Vector3 end = center + radius * (std::cos(sweep) * u + std::sin(sweep) * v);
        const auto print = [](const geometry::Vector3& p) {
            return fmt::format("{:.7f},{:.7f},{:.7f}", p[0], p[1], p[2]);
        };
        const std::string go = "GOTO/" + print(center + radius * u) + "\n";
        const std::string driven = tlon(print(v), fmt::format("{},{:.7f}", print(center), radius),
                                        sweep > std::numbers::pi ? "2,INTOF," : "", print(center) + "," + print(end));
        const std::string circle =
            fmt::format("CIRCLE/{},{},{:.7f}\nGOTO/{}", print(center), print(normal), radius, print(end));
        for (const std::string& text : {go + driven, go + circle}) {
            const ReadOut out = readOut("UNITS/MM\n" + text + "\nFINI\n");
            ASSERT_EQ(out.problems, "") << "seed " << seed << " i " << i << "\n" << text;
            const auto& arc = std::get<ArcMotion>(out.records.at(1).statement);
            EXPECT_LT((arc.normal - normal).norm(), 1e-5) << text;
            EXPECT_LT((arc.end.tip_mm - end).norm(), 1e-6) << text;
            EXPECT_LT((arc.center_mm - center).norm(), 1e-4) << text;
            EXPECT_FALSE(arc.full_circle);
        }
    }
}

}  // namespace
}  // namespace cusp::toolpath::test
