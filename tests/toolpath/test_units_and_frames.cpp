// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The unit of a file, its dialect, MSYS and the frames in CATIA's comments.
#include "cl_text.hpp"

#include <gtest/gtest.h>

#include <fmt/format.h>

namespace cusp::toolpath::test {
namespace {

const std::string unknown_unit =
    "error: the file does not say whether it is in mm or inch: no UNITS statement, and no feed in "
    "MMPM, MMPR, IPM or IPR; say which with --units mm or --units inch [cl.unit-unknown]\n";

double xOfFirstMotion(const ReadOut& out) {
    for (const ClRecord& record : out.records) {
        if (const auto* motion = std::get_if<LinearMotion>(&record.statement)) {
            return motion->location.tip_mm.x();
        }
    }
    return -1.0;
}

ClReaderOptions unitOption(double mm_per_unit) {
    ClReaderOptions options;
    options.mm_per_unit = mm_per_unit;
    return options;
}

TEST(Units, Stated) {
    for (const char* word : {"MM", "mm"}) {
        EXPECT_EQ(xOfFirstMotion(readOut(fmt::format("UNITS/{}\nGOTO/2,0,0\nFINI\n", word))), 2.0);
    }
    for (const char* word : {"INCH", "INCHES", "IN"}) {
        const ReadOut out = readOut(fmt::format("UNIT/{}\nGOTO/2,0,0\nFINI\n", word));
        EXPECT_EQ(xOfFirstMotion(out), 50.8);
        EXPECT_EQ(out.mm_per_unit, 25.4);
        EXPECT_EQ(out.problems, "");
    }
}

TEST(Units, ImpliedByAFeedThatComesLater) {
    EXPECT_EQ(xOfFirstMotion(readOut("GOTO/2,0,0\nFEDRAT/IPM,10.\nFINI\n")), 50.8);
    EXPECT_EQ(xOfFirstMotion(readOut("GOTO/2,0,0\nFEDRAT/10.,MMPR\nFINI\n")), 2.0);
    // As far as the look-ahead of one megabyte goes, and no further.
    std::string far = "GOTO/2,0,0\n";
    while (far.size() < 1000000) {
        far += "GOTO/3,0,0\n";
    }
    EXPECT_EQ(xOfFirstMotion(readOut(far + "FEDRAT/IPM,10.\nFINI\n")), 50.8);
    EXPECT_EQ(readOut(far + far + "FEDRAT/IPM,10.\nFINI\n").problems, "1: " + unknown_unit);
}

TEST(Units, UnknownIsAnErrorOnce) {
    EXPECT_EQ(readOut("GOTO/2,0,0\nFEDRAT/100\nGOTO/3,0,0\nFINI\n").problems, "1: " + unknown_unit);
    EXPECT_EQ(readOut("GOTO/2,0,0\nFINI\n", unitOption(25.4)).problems, "");
    EXPECT_EQ(xOfFirstMotion(readOut("GOTO/2,0,0\nFINI\n", unitOption(25.4))), 50.8);
}

TEST(Units, FeedsInTheOtherUnitAreLegalWhereTheUnitIsStated) {
    const ReadOut out = readOut("UNITS/MM\nFEDRAT/IPM,60.\nGOTO/2,0,0\nFINI\n");
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(out.text, "2 feed 25.4 mm/s\n3 go 2 0 0 axis 0 0 1\n4 end\n");
    EXPECT_EQ(readOut("FEDRAT/IPM,60.\nFEDRAT/MMPM,60.\nGOTO/2,0,0\nFINI\n", unitOption(1.0)).problems, "");
}

TEST(Units, Contradictions) {
    EXPECT_EQ(
        readOut("FEDRAT/IPM,60.\nGOTO/2,0,0\nFEDRAT/MMPM,60.\nFEDRAT/MMPM,60.\nFINI\n").problems,
        "3: error: FEDRAT in MMPM, but the first feed of the file made its unit inch: the unit of the points is not "
        "clear; say which with --units mm or --units inch [cl.unit-contradiction]\n");
    EXPECT_EQ(
        readOut("UNITS/MM\nGOTO/2,0,0\nUNITS/INCHES\nFINI\n").problems,
        "3: error: UNITS/INCHES, but the file was read in mm up to here: a change of unit inside a file is not read "
        "[cl.unit-contradiction]\n");
    EXPECT_EQ(readOut("UNITS/MM\nGOTO/2,0,0\nFINI\n", unitOption(25.4)).problems,
              "1: warning: the file says UNITS/MM; the unit given for it is not used [cl.unit-option]\n");
    EXPECT_EQ(readOut("UNITS/CM\nGOTO/2,0,0\nFINI\n", unitOption(25.4)).problems,
              "1: error: UNITS/CM is not understood; MM or INCHES is [cl.unit]\n");
}

TEST(DialectOf, IsToldByWhatOnlyOneSystemWrites) {
    EXPECT_EQ(readOut("TOOL PATH/A,TOOL,B\nFEDRAT/MMPM,1\nGOTO/1,1,1\nEND-OF-PATH\n").dialect, Dialect::Nx);
    EXPECT_EQ(readOut("$$     CATIA APT VERSION 1.0\nUNITS/MM\nGOTO/1,1,1\nFINI\n").dialect, Dialect::Catia);
    EXPECT_EQ(readOut("UNITS/MM\nGOTO/1,1,1\nFINI\n").dialect, Dialect::Apt);
    ClReaderOptions forced;
    forced.dialect = Dialect::Catia;
    EXPECT_EQ(readOut("UNITS/MM\nGOTO/1,1,1\nFINI\n", forced).dialect, Dialect::Catia);
    EXPECT_STREQ(dialectName(Dialect::Nx), "NX");
    EXPECT_STREQ(dialectName(Dialect::Catia), "CATIA");
    EXPECT_STREQ(dialectName(Dialect::Apt), "APT");
    EXPECT_STREQ(dialectName(Dialect::SolidWorksCam), "SolidWorks CAM");
}

TEST(Msys, IsOriginXAndY) {
    const ReadOut out = readOut("UNITS/INCHES\nMSYS/3.,2.,0.,0.,1.,0.,-1.,0.,0.\nGOTO/1,0,0\nEND-OF-PATH\n");
    EXPECT_EQ(out.text.substr(0, out.text.find('\n')),
              "2 frame origin 76.19999999999999 50.8 0 x 0 1 0 y -1 0 0 z 0 0 1");
    EXPECT_NE(readOut("UNITS/MM\nMSYS/0,0,0,1,0,0,0,-1,0\nGOTO/1,0,0\nEND-OF-PATH\n").text.find("z 0 0 -1"),
              std::string::npos);
}

TEST(Msys, Problems) {
    const auto problems = [](const std::string& values) {
        return readOut("UNITS/MM\nMSYS/" + values + "\nGOTO/1,0,0\nEND-OF-PATH\n").problems;
    };
    EXPECT_EQ(problems("0,0,0,1,0,0"),
              "2: error: MSYS takes 9 values (origin, X and Y direction), not 6 [cl.syntax]\n");
    const std::string not_perpendicular =
        "2: error: MSYS: the X and Y directions are not perpendicular unit vectors [cl.frame]\n";
    EXPECT_EQ(problems("0,0,0,1,0,0,.6,.8,0"), not_perpendicular);
    EXPECT_EQ(problems("0,0,0,2,0,0,0,1,0"), not_perpendicular);
}

TEST(Csys, GivesTheAxisOfA3Plus2Plane) {
    const ReadOut out =
        readOut("UNIT/MM\nTRNTYP/WORLD,0,0,0\nGOTO/1,0,0\nCSYS/0,0,-1.,0,-1.,0,0,0,0,1.,0,0\nGOTO/2,0,0\n"
                "GOTO/3,0,0,-1.,0,0\nSELECT/TOOL,4\nCSI_SET_FLUTE_LENGTH/38.\nFINI\n");
    EXPECT_EQ(out.dialect, Dialect::SolidWorksCam);
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(
        out.text,
        "3 go 1 0 0 axis 0 0 1\n4 plane origin 0 0 0 x 0 -1 0 y 0 0 1 z -1 0 0\n5 go 2 0 0 axis -1 0 0\n6 go 3 0 0 axis -1 0 0\n9 end\n");
}

TEST(Csys, Problems) {
    const auto problems = [](const std::string& statement) {
        return readOut("UNITS/MM\n" + statement + "\nGOTO/1,0,0\nFINI\n").problems;
    };
    EXPECT_EQ(problems("CSYS/1,0,0"), "2: error: CSYS takes 12 values (three rows of a matrix), not 3 [cl.syntax]\n");
    EXPECT_EQ(problems("CSYS/1,0,0,0,0,1,0,0,0,0,-1,0"),
              "2: error: CSYS: the matrix is not a rotation with an origin [cl.frame]\n");
    EXPECT_EQ(problems("TRNTYP/LOCAL,0,0,0"),
              "2: error: TRNTYP/LOCAL,0,0,0 is not yet read; without it the tool would go elsewhere than the file says "
              "[cl.unsupported-motion]\n");
    // Elsewhere CSYS is not known, but it turns the axis all the same.
    EXPECT_EQ(readOut("TOOL PATH/A,TOOL,B\nFEDRAT/MMPM,1\nCSYS/1\nGOTO/1,0,0\nEND-OF-PATH\n").problems,
              "3: error: CSYS is not yet read; without it the tool would go elsewhere than the file says "
              "[cl.unsupported-motion]\n");
}

const std::string catia_frame = "$$*CATIA0\n$$ Manufacturing Program.1\n"
                                "$$     1.00000     0.00000     0.00000     5.00000\n"
                                "$$     0.00000    -1.00000     0.00000     0.00000\n";

TEST(CatiaComments, CarryFrameAndOperation) {
    const ReadOut out = readOut("UNITS/MM\n" + catia_frame +
                                "$$ 0.0 0.0 -1.0 60.0\n$$ OPERATION NAME : Sweeping.1\nGOTO/1,0,0\nFINI\n");
    EXPECT_EQ(out.problems, "");
    EXPECT_EQ(
        out.text,
        "6 frame origin 5 0 60 x 1 0 0 y 0 -1 0 z 0 0 -1\n7 operation 'Sweeping.1'\n8 go 1 0 0 axis 0 0 1\n9 end\n");
    // The same comments mean nothing elsewhere.
    EXPECT_EQ(readOut("UNITS/MM\n$$ OPERATION NAME : Sweeping.1\nGOTO/1,0,0\nFINI\n").text,
              "3 go 1 0 0 axis 0 0 1\n4 end\n");
}

TEST(CatiaComments, AFrameCutShortIsAnError) {
    const std::string cut_short =
        "2: error: $$*CATIA0 is not followed by a name and the three rows of its matrix [cl.frame]\n";
    EXPECT_EQ(readOut("UNITS/MM\n" + catia_frame + "GOTO/1,0,0\nFINI\n").problems, cut_short);
    EXPECT_EQ(readOut("UNITS/MM\n" + catia_frame + "$$ 1 2 3\nGOTO/1,0,0\nFINI\n").problems, cut_short);
    EXPECT_EQ(readOut("UNITS/MM\n" + catia_frame + "$$ 0 0 1 0\nGOTO/1,0,0\nFINI\n").problems,
              "2: error: $$*CATIA0: the matrix is not a rotation with an origin [cl.frame]\n");
}

}  // namespace
}  // namespace cusp::toolpath::test
