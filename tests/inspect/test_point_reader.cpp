// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Points from text: tables in all their spellings, DMIS, PC-DMIS, Calypso.
#include "points_text.hpp"

#include <gtest/gtest.h>

namespace cusp::inspect::test {
namespace {

void expectPoint(const PointsRead& out, std::size_t i, double x, double y, double z) {
    ASSERT_EQ(out.errors, "");
    ASSERT_LT(i, out.points.size());
    EXPECT_EQ(out.points.positions[i], Vector3(x, y, z));
}

TEST(PointTable, SeparatorsAndDecimalMarks) {
    for (const std::string text :
         {"1.5,2,-3e-1\n4,5,6\n", "1.5 2 -0.3\n4 5 6\n", "  1.5\t2\t-0.3\r\n4\t5\t6\r\n", "1.5;2;-0.3\n4;5;6",
          "1,5;2;-0,3\n4;5;6\n", "1,5 2 -0,3\n4 5 6\n", "1,5\t2,0\t-0,3\n4\t5\t6\n", "1.5|2|-0.3\n4|5|6\n",
          "1,5 | 2 | -0,3\n4 | 5 | 6\n", "1.5, 2, -0.3\n\n# remark\n4, 5, 6,\n",
          "\xef\xbb\xbf"
          "1.5,2,-0.3\n4,5,6\n",
          "1.5,2,-0.3\r4,5,6\r"}) {
        const PointsRead out = readText(text);
        SCOPED_TRACE(text);
        expectPoint(out, 0, 1.5, 2.0, -0.3);
        expectPoint(out, 1, 4.0, 5.0, 6.0);
        EXPECT_EQ(out.points.size(), 2U);
        EXPECT_EQ(out.remarks, "");
        EXPECT_FALSE(out.points.unit_stated);
        EXPECT_TRUE(out.points.directions.empty());
    }
}

TEST(PointTable, DirectionsNamesAndNumbers) {
    PointsRead out = readText("1,2,3,0,0.6,0.8\n4,5,6,0,0,1\n");
    expectPoint(out, 0, 1, 2, 3);
    ASSERT_EQ(out.points.directions.size(), 2U);
    EXPECT_EQ(out.points.directions[0], Vector3(0, 0.6, 0.8));

    out = readText("P1;1,0;2,0;3,0\nP2;4,0;5,0;6,0\n");
    expectPoint(out, 1, 4, 5, 6);

    out = readText("1 10 20 30 0 0 1\n2 11 21 31 0 1 0\n3 12 22 32 1 0 0\n");
    expectPoint(out, 2, 12, 22, 32);
    EXPECT_EQ(out.points.directions.size(), 3U);

    // An intensity or a colour is no direction.
    out = readText("1.5 2 3 200\n4 5 6 100\n");
    expectPoint(out, 1, 4, 5, 6);
    EXPECT_EQ(
        out.remarks,
        "1: warning: the table has no header: columns 1 to 3 are taken as x, y, z; 1 further columns are not used; "
        "--columns says otherwise [points.unused-columns]\n");
    out = readText("1.5 2 3 200 100 0\n4 5 6 100 0 0\n");
    expectPoint(out, 0, 1.5, 2, 3);
    EXPECT_TRUE(out.points.directions.empty());
}

TEST(PointTable, Headers) {
    PointsRead out = readText("name;X [mm];Y [mm];Z [mm];nx;ny;nz\nA;1,5;2;3;0;0;1\n");
    expectPoint(out, 0, 1.5, 2, 3);
    EXPECT_TRUE(out.points.unit_stated);
    EXPECT_EQ(out.points.directions.size(), 1U);
    EXPECT_EQ(out.remarks, "1: note: columns not used: name [points.unused-columns]\n");

    out = readText("x_in y_in z_in\n1 2 3\n");
    expectPoint(out, 0, 25.4, 50.8, 3 * 25.4);
    EXPECT_EQ(out.points.mm_per_unit, 25.4);

    out = readText("section_X,x,y,z\n-5.0,1,2,3\n-5,4,5,6\n-30,7,8,9\n-5,1,1,1\n");
    EXPECT_EQ(out.points.section_labels, (std::vector<std::string>{"X=-5", "X=-30"}));
    EXPECT_EQ(out.points.sections, (std::vector<std::int32_t>{0, 0, 1, 0}));

    // The measured coordinates among nominal ones.
    out = readText("x_nom,y_nom,z_nom,x_meas,y_meas,z_meas\n0,0,0,1,2,3\n");
    expectPoint(out, 0, 1, 2, 3);
}

TEST(PointTable, RemarksSayWhatThePointsAre) {
    PointsRead out = readText("# probe radius 1.5 mm, probe-centre points\n1,2,3\n");
    EXPECT_EQ(out.points.kind, PointKind::Centre);
    EXPECT_EQ(out.points.probe_radius_mm, 1.5);
    out = readText("# Surface points\n1,2,3\n");
    EXPECT_EQ(out.points.kind, PointKind::Surface);
    out = readText("# nothing about it\n1,2,3\n");
    EXPECT_EQ(out.points.kind, std::nullopt);
    // The caller knows better.
    out = readText("# probe-centre points\n1,2,3\n", {.kind = PointKind::Surface});
    EXPECT_EQ(out.points.kind, PointKind::Surface);
}

TEST(PointTable, OptionsGoBeforeWhatIsFound) {
    PointsRead out = readText("7,0,0,1\n", {.columns = "z,x,y,-"});
    expectPoint(out, 0, 0, 0, 7);
    out = readText("10,5,20,25,3,125\n", {.decimal = '.'});
    expectPoint(out, 0, 10, 5, 20);
    out = readText("x [inch],y [inch],z [inch]\n1,2,3\n", {.mm_per_unit = 1.0});
    expectPoint(out, 0, 1, 2, 3);
    EXPECT_EQ(out.remarks, "warning: the file says its unit is 25.4 mm; it is read as 1 mm, as asked "
                           "[points.unit-overruled]\n");
}

TEST(PointTable, FarOffTheOriginKeepsEveryBit) {
    const PointsRead out = readText("450000.123456789,5400000.987654321,123.000000001\n");
    expectPoint(out, 0, 450000.123456789, 5400000.987654321, 123.000000001);
}

TEST(PointTable, BlockSizeChangesNothing) {
    const std::string text = "# remark\r\nx;y;z\r\n1,5;2;3\r\n\r\n4;5;6\r\n7;8;9";
    const PointsRead whole = readText(text);
    for (std::size_t block = 1; block < 20; ++block) {
        const PointsRead pieces = readText(text, {.block_bytes = block});
        EXPECT_EQ(pieces.points.positions, whole.points.positions) << block;
        EXPECT_EQ(pieces.points.lines, (std::vector<std::uint64_t>{3, 5, 6})) << block;
    }
}

TEST(PointTable, DuplicatesAreSaid) {
    const PointsRead out = readText("1,2,3\n4,5,6\n1,2,3\n4,5,6\n-0,0,1\n0,0,1\n");
    EXPECT_EQ(out.points.size(), 6U);
    EXPECT_EQ(out.remarks,
              "3: warning: 3 of 6 points have the coordinates of an earlier one (the first: that of line 1); "
              "all are kept [points.duplicates]\n");
}

TEST(Dmis, ActualAndRawPoints) {
    const PointsRead out = readText("DMISMN/'PART',05.2\n"
                                    "UNITS/INCH,ANGDEC\n"
                                    "PRCOMP/OFF\n"
                                    "$$ F is the nominal\n"
                                    "F(PT1)=FEAT/POINT,CART,9,9,9,0,0,1\n"
                                    "FA(PT1)=FEAT/POINT,CART,1.0,2.0,$\n"
                                    "3.0,0,0,1\n"
                                    "FA(C1)=FEAT/CIRCLE,INNER,CART,0,0,0,0,0,1,5\n"
                                    "PTDATA/CART,4,5,6,0,1,0\n"
                                    "ENDFIL\n");
    expectPoint(out, 0, 25.4, 50.8, 3.0 * 25.4);
    expectPoint(out, 1, 4.0 * 25.4, 127.0, 6.0 * 25.4);
    EXPECT_EQ(out.points.size(), 2U);
    EXPECT_EQ(out.points.format, "dmis");
    EXPECT_EQ(out.points.kind, PointKind::Centre);
    EXPECT_EQ(out.points.lines, (std::vector<std::uint64_t>{6, 9}));
    EXPECT_EQ(out.remarks, "note: statements that say no point: DMISMN (1), ENDFIL (1), FEAT/CIRCLE (1) "
                           "[points.other-statements]\n");
}

TEST(PcDmis, FeaturesAndTables) {
    PointsRead out = readText("PNT1       =FEAT/CONTACT/VECTOR POINT/DEFAULT,CARTESIAN\n"
                              "            THEO/<0.02,0.22,-0.2>,<0,0,1>\n"
                              "            ACTL/<0.021,0.22,-0.201>,<0,0,1>\n"
                              "            TARG/<0.02,0.22,-0.2>,<0,0,1>\n"
                              "CIR1       =FEAT/CONTACT/CIRCLE/DEFAULT,CARTESIAN,IN\n"
                              "            ACTL/<7,7,7>,<0,0,1>,3\n"
                              "PNT2       =AUTO/VECTOR POINT,FEAT/POINT\n"
                              "            ACTL/4,5,6,0,1,0\n");
    expectPoint(out, 0, 0.021, 0.22, -0.201);
    expectPoint(out, 1, 4, 5, 6);
    EXPECT_EQ(out.points.size(), 2U);
    EXPECT_EQ(out.points.directions.size(), 2U);

    out = readText("DIM LOC1= LOCATION OF POINT PNT1  UNITS=IN ,$\n"
                   "GRAPH=OFF  TEXT=OFF  MULT=10.00  OUTPUT=BOTH\n"
                   "AX    NOMINAL       +TOL       -TOL       MEAS        DEV     OUTTOL\n"
                   "X      1.0000     0.0100     0.0100     1.0010     0.0010     0.0000 ----#----\n"
                   "Y      2.0000     0.0100     0.0100     2.0000     0.0000     0.0000 ----#----\n"
                   "Z      3.0000     0.0100     0.0100     3.0000     0.0000     0.0000 ----#----\n"
                   "END OF DIMENSION LOC1\n");
    expectPoint(out, 0, 1.001 * 25.4, 2.0 * 25.4, 3.0 * 25.4);
    EXPECT_EQ(out.points.size(), 1U);
}

TEST(Calypso, CoordinatesOfFeatures) {
    const PointsRead out = readText("planid\tpartnb\tid\ttype\tidsymbol\tactual\tnominal\tfeatureid\n"
                                    "P\t1\tX1\txValue\tx\t1,5\t1\tPoint1\n"
                                    "P\t1\tY1\tyValue\ty\t2\t2\tPoint1\n"
                                    "P\t1\tZ1\tzValue\tz\t-3\t3\tPoint1\n"
                                    "P\t1\tD1\tdiameter\td\t8\t8\tCircle1\n"
                                    "P\t1\tX2\txValue\tx\t4\t1\tPoint2\n"
                                    "P\t1\tY2\tyValue\ty\t5\t2\tPoint2\n"
                                    "P\t1\tZ2\tzValue\tz\t6\t3\tPoint2\n"
                                    "END\n");
    expectPoint(out, 0, 1.5, 2, -3);
    expectPoint(out, 1, 4, 5, 6);
    EXPECT_EQ(out.points.format, "calypso");
    EXPECT_EQ(out.remarks, "note: 1 characteristics are no coordinate of a point [points.other-features]\n");
}

}  // namespace
}  // namespace cusp::inspect::test
