// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp post` from the outside.
#include "command_line.hpp"

namespace cusp::cli {
namespace {

using PostCommand = CommandLine;

TEST_F(PostCommand, WritesAProgramAndSaysSo) {
    const std::string cl = write("part.cls", small_cl);
    const auto outcome = run({"post", cl, "-m", "fooke-endura-ca", "-o", path("PART.MPF")});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.errors, "");
    EXPECT_NE(outcome.output.find("4 cutter locations"), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("linear travel not checked"), std::string::npos) << outcome.output;
    const std::string program = read("PART.MPF");
    EXPECT_EQ(program.substr(0, 7), "; PART\n");
    EXPECT_NE(program.find("TRAORI\n"), std::string::npos);
    EXPECT_EQ(program.substr(program.size() - 4), "M30\n");
}

TEST_F(PostCommand, SameInputSameBytes) {
    const std::string cl = write("part.cls", small_cl);
    run({"post", cl, "-m", "fooke-endura-ca", "-o", path("A.MPF"), "--name", "X"});
    run({"post", cl, "-m", "fooke-endura-ca", "-o", path("B.MPF"), "--name", "X"});
    EXPECT_EQ(read("A.MPF"), read("B.MPF"));
    EXPECT_FALSE(read("A.MPF").empty());
}

TEST_F(PostCommand, StandardInputToStandardOutput) {
    const auto outcome = run({"post", "-", "-m", "fooke-endura-ca", "-o", "-"}, small_cl);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_EQ(outcome.output.substr(0, 10), "; PROGRAM\n");
    EXPECT_EQ(outcome.output.substr(outcome.output.size() - 4), "M30\n");
}

TEST_F(PostCommand, JsonHasTheDocumentedKeys) {
    const std::string cl = write("part.cls", small_cl);
    const auto outcome = run({"post", cl, "-m", "fooke-endura-ca", "-o", path("PART.MPF"), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const auto json = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(json["command"], "post");
    EXPECT_EQ(json["schema"], 1);
    EXPECT_EQ(json["cutter_locations"], 4);
    EXPECT_EQ(json["operations"], 1);
    EXPECT_EQ(json["tool_changes"], 1);
    EXPECT_EQ(json["warnings"], 0);
    EXPECT_EQ(json["limit_violations"], 0);
    EXPECT_EQ(json["program"], path("PART.MPF"));
    EXPECT_NEAR(json["rotary_travel_deg"].get<double>(), 36.8698976, 1e-6);
    std::size_t blocks = 0;
    for (const char c : read("PART.MPF")) blocks += c == '\n' ? 1U : 0U;
    std::size_t comments = 0;
    const std::string program = read("PART.MPF");
    for (std::size_t at = 0; at < program.size(); at = program.find('\n', at) + 1)
        comments += program[at] == ';' ? 1U : 0U;
    EXPECT_EQ(json["blocks"], blocks - comments);
}

/// One straight cut of so many millimetres at 600 mm/min.
std::string straightCut(double length_mm) {
    return "TOOL PATH/OP1,TOOL,MILL\nMSYS/0,0,0,1,0,0,0,1,0\nSPINDL/RPM,1000,CLW\nRAPID\nGOTO/0,0,50\n"
           "FEDRAT/MMPM,600\nGOTO/0,0,0\nGOTO/" +
           std::to_string(length_mm) + ",0,0\nRAPID\nGOTO/" + std::to_string(length_mm) + ",0,50\nEND-OF-PATH\n";
}

TEST_F(PostCommand, CycleTimeGrowsByLengthOverFeed) {
    const auto secondsOf = [&](double length_mm) {
        const std::string cl = write("part.cls", straightCut(length_mm));
        const auto outcome = run({"post", cl, "-m", "three-axis", "-o", path("PART.MPF"), "--json"});
        EXPECT_EQ(outcome.exit_code, 0) << outcome.errors;
        const auto json = nlohmann::json::parse(outcome.output);
        EXPECT_EQ(json["cycle_time_basis"], "assumed");
        EXPECT_EQ(json["cycle_time_dwell_s"], 0.0);
        return json["cycle_time_s"].get<double>();
    };
    // Ten seconds for the cut; the rest is 100 mm of the way home at rapid speed.
    const double longer = secondsOf(200.0) - secondsOf(100.0);
    EXPECT_GT(longer, 10.0);
    EXPECT_LT(longer, 10.5);
}

TEST_F(PostCommand, NoCycleTimeIsNull) {
    const std::string cl = write("part.cls", small_cl);
    const auto outcome =
        run({"post", cl, "-m", "fooke-endura-ca", "-o", path("PART.MPF"), "--json", "--no-cycle-time"});
    EXPECT_TRUE(nlohmann::json::parse(outcome.output)["cycle_time_s"].is_null());
}

TEST_F(PostCommand, ABrokenClFileLeavesNothingBehind) {
    const std::string cl = write("part.cls", std::string(small_cl) + "CIRCLE/0,0,0,0,0,1,5\nGOTO/1.0,x,3.0\n");
    const auto outcome = run({"post", cl, "-m", "fooke-endura-ca", "-o", path("PART.MPF")});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.errors.find("part.cls:14:"), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.output.find("NO PROGRAM WRITTEN"), std::string::npos) << outcome.output;
    EXPECT_EQ(left(), std::vector<std::string>{"part.cls"});
}

TEST_F(PostCommand, AnOldProgramSurvivesAFailedPosting) {
    const std::string cl = write("part.cls", "GOTO/1.0,2.0\n");
    write("PART.MPF", "the old one\n");
    EXPECT_EQ(run({"post", cl, "-m", "fooke-endura-ca", "-o", path("PART.MPF")}).exit_code, 3);
    EXPECT_EQ(read("PART.MPF"), "the old one\n");
    EXPECT_EQ(left(), (std::vector<std::string>{"PART.MPF", "part.cls"}));
}

TEST_F(PostCommand, ALimitViolationIsFoundNotWritten) {
    std::string cl_text = small_cl;
    cl_text.insert(cl_text.find("RAPID\nGOTO/10"), "GOTO/5.0,0.0,0.0,0.8660254037844387,0.0,-0.5\n");  // A 120°
    const std::string cl = write("part.cls", cl_text);
    const auto outcome = run({"post", cl, "-m", "fooke-endura-ca", "-o", path("PART.MPF")});
    EXPECT_EQ(outcome.exit_code, 1);
    EXPECT_NE(outcome.errors.find("A axis would need"), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.errors.find("CL line 10"), std::string::npos) << outcome.errors;
    EXPECT_EQ(left(), std::vector<std::string>{"part.cls"});
}

TEST_F(PostCommand, ExitCodesForUsageAndFiles) {
    const std::string cl = write("part.cls", small_cl);
    EXPECT_EQ(run({"post"}).exit_code, 2);
    EXPECT_EQ(run({"post", cl, "-m", "fooke-endura-ca", "-o", path("P.MPF"), "--dialect", "cobol"}).exit_code, 2);
    EXPECT_EQ(run({"post", cl, "-m", "fooke-endura-ca", "-o", "-", "--json"}).exit_code, 2);
    EXPECT_EQ(run({"post", path("none.cls"), "-m", "fooke-endura-ca", "-o", path("P.MPF")}).exit_code, 4);
    EXPECT_EQ(run({"post", cl, "-m", "fooke-endura-ca", "-o", path("no/such/folder/P.MPF")}).exit_code, 4);
    const auto outcome = run({"post", cl, "-m", "no-such-machine", "-o", path("P.MPF")});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.errors.find("fooke-endura-ca"), std::string::npos) << "names the machines that ship";
    EXPECT_EQ(left(), std::vector<std::string>{"part.cls"});
}

TEST_F(PostCommand, FlagsWinOverTheJobFile) {
    const std::string cl = write("part.cls", small_cl);
    const std::string job = write("job.toml", "[post]\nwork_offset = \"G505\"\nprogram_name = \"FROM_JOB\"\n");
    auto config = run({"post", cl, "-m", "fooke-endura-ca", "-o", path("P.MPF"), "--config", job, "--print-config"});
    EXPECT_EQ(config.exit_code, 0);
    EXPECT_NE(config.output.find("work_offset = \"G505\""), std::string::npos) << config.output;
    run({"post", cl, "-m", "fooke-endura-ca", "-o", path("P.MPF"), "--config", job, "--name", "FLAG"});
    EXPECT_EQ(read("P.MPF").substr(0, 7), "; FLAG\n");
    EXPECT_NE(read("P.MPF").find(" G505\n"), std::string::npos);
    EXPECT_EQ(run({"post", cl, "-m", "fooke-endura-ca", "-o", path("P.MPF"), "--work-offset", "G1"}).exit_code, 3);
}

TEST_F(PostCommand, AFullDeviceIsNotSuccess) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "this system has no /dev/full";
    const std::string cl = write("part.cls", small_cl);
    EXPECT_EQ(run({"post", cl, "-m", "fooke-endura-ca", "-o", "/dev/full"}).exit_code, 4);
}

TEST_F(PostCommand, ASetupMakesLinearTravelKnown) {
    const std::string cl = write("part.cls", small_cl);
    write("tools.toml", "schema = 1\nname = \"tools\"\n[[tool]]\nname = \"BALL_6\"\nshape = \"ball\"\ndiameter_mm = 6\n"
                        "cutting_height_mm = 20\ngauge_length_mm = 110\n");
    const std::string head = "schema = 1\nname = \"plate\"\ntool_library = \"tools.toml\"\n[work_offset.G54]\n";
    const std::string good = write("setup.toml", head + "origin_mm = [1000, 0, -700]\n");
    const auto kept = run({"post", cl, "-m", "fooke-endura-ca", "-o", path("A.MPF"), "--setup", good});
    EXPECT_EQ(kept.exit_code, 0) << kept.errors;
    EXPECT_NE(kept.output.find("  X moves between 1000.000 mm and "), std::string::npos) << kept.output;
    EXPECT_EQ(kept.output.find("not checked"), std::string::npos) << kept.output;
    EXPECT_NE(read("A.MPF").find("; X Y Z are the tool tip (TRAORI); linear travel kept in the setup: plate\n"),
              std::string::npos);
    const auto json = nlohmann::json::parse(
        run({"post", cl, "-m", "fooke-endura-ca", "-o", path("A.MPF"), "--setup", good, "--json"}).output);
    EXPECT_EQ(json["linear_travel"], "checked");
    EXPECT_EQ(json["linear_range_mm"]["X"][0], 1000.0);

    const std::string low = write("low.toml", head + "origin_mm = [1000, 0, -2000]\n");
    const auto beyond = run({"post", cl, "-m", "fooke-endura-ca", "-o", path("B.MPF"), "--setup", low});
    EXPECT_EQ(beyond.exit_code, 1);
    EXPECT_NE(beyond.errors.find("error: Z axis would need -1"), std::string::npos) << beyond.errors;
    EXPECT_NE(beyond.errors.find("limit -1250 mm [kinematics.linear-limit]"), std::string::npos) << beyond.errors;
    const std::string unknown = write("unknown.toml", head + "origin_mm = [1000, 0, x]\n");
    EXPECT_EQ(run({"post", cl, "-m", "fooke-endura-ca", "-o", path("B.MPF"), "--setup", unknown}).exit_code, 3);
    EXPECT_EQ(run({"post", cl, "-m", "fooke-endura-ca", "-o", path("B.MPF"), "--setup", path("none")}).exit_code, 4);
    EXPECT_EQ(left(),
              (std::vector<std::string>{"A.MPF", "low.toml", "part.cls", "setup.toml", "tools.toml", "unknown.toml"}));
}

TEST_F(PostCommand, ANurbsCurveIsRefusedByName) {
    const std::string cl =
        write("part.cls", "TOOL PATH/OP1,TOOL,BALL_6\nTLDATA/MILL,6.,3.,50.,0.,0.\nFEDRAT/MMPM,250.\n"
                          "SPINDL/RPM,100,CLW\nGOTO/0,0,0,0,0,1\nNURBS/3\nKNOT/0,0,1,1\nCNTRL/0,0,0\n"
                          "CNTRL/1,0,0\nGOTO/1,0,0\nEND-OF-PATH\n");
    const auto posted = run({"post", cl, "-m", "fooke-endura-ca", "-o", path("P.MPF")});
    EXPECT_EQ(posted.exit_code, 3);
    EXPECT_NE(posted.errors.find("part.cls:6: error: a NURBS curve cannot be posted: export the operation with linear "
                                 "or circular moves [post.nurbs]\n"),
              std::string::npos)
        << posted.errors;
    const std::string program = write("OLD.MPF", "G54 G90\nM30\n");
    const auto verified = run({"verify", program, "-m", "fooke-endura-ca", "--against", cl});
    EXPECT_EQ(verified.exit_code, 3);
    EXPECT_NE(verified.errors.find("part.cls:6: error: a NURBS curve is not compared with programs"), std::string::npos)
        << verified.errors;
}

TEST_F(PostCommand, TheMapNamesTheClLineOfEveryBlock) {
    const std::string cl = write("part.cls", small_cl);
    const auto outcome =
        run({"post", cl, "-m", "fooke-endura-ca", "-o", path("P.MPF"), "--map", path("P.csv"), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const std::string map = read("P.csv");
    EXPECT_TRUE(map.starts_with("block,program_line,cl_line\n10,5,\n")) << map;
    // One line for each block; the feed to CL line 9 is the one that has X10 for the first time.
    EXPECT_EQ(static_cast<std::size_t>(std::count(map.begin(), map.end(), '\n')) - 1,
              nlohmann::json::parse(outcome.output)["blocks"].get<std::size_t>());
    const std::string program = read("P.MPF");
    const auto at = program.rfind('\n', program.find(" X10\n"));
    const std::string block = program.substr(at + 2, program.find(' ', at) - at - 2);
    const auto line = std::count(program.begin(), program.begin() + static_cast<std::ptrdiff_t>(at) + 1, '\n') + 1;
    EXPECT_NE(map.find("\n" + block + "," + std::to_string(line) + ",9\n"), std::string::npos) << map << program;
}

TEST_F(PostCommand, TheSetupSheetSaysWhatToClamp) {
    const std::string cl = write("part.cls", small_cl);
    const std::string setup = write("setup.toml", "schema = 1\nname = \"plate\"\n[work_offset.G54]\n"
                                                  "origin_mm = [1000.0, 0.0, -600.0]\n[[tool]]\nname = \"BALL_6\"\n"
                                                  "length_mm = 150.0\n[[fixture]]\nname = \"vise\"\n"
                                                  "work_offset = \"G54\"\nmin_mm = [-100.0, -80.0, -120.0]\n"
                                                  "max_mm = [-10.0, 80.0, -20.0]\n");
    const auto outcome = run(
        {"post", cl, "-m", "fooke-endura-ca", "-o", path("P.MPF"), "--setup", setup, "--setup-sheet", path("P.md")});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    EXPECT_NE(outcome.errors.find("warning: the path is not checked against the fixtures of the setup: vise"),
              std::string::npos)
        << outcome.errors;
    const std::string sheet = read("P.md");
    for (
        const std::string line :
        {"# Setup sheet: P\n", "| G54 | X 0.000, Y 0.000, Z 0.000 | X 1000.000, Y 0.000, Z -600.000 |\n",
         "| BALL_6 | diameter 6, corner radius 3, cutting length 50 | 150.000 | 8000 rev/min | 1 |\n",
         "| 1 | OP1 | 1 | BALL_6 | G54 | X 0.000, Y 0.000, Z 0.000 | X 10.000, Y 0.000, Z 50.000 | 1200 | 60 mm | 3 s | ",
         "| vise | G54 | X -100.000, Y -80.000, Z -120.000 to X -10.000, Y 80.000, Z -20.000 |\n",
         "The path is NOT checked against them."})
        EXPECT_NE(sheet.find(line), std::string::npos) << line << sheet;
}

TEST_F(PostCommand, NothingIsWrittenBesideAProgramThatIsNot) {
    const std::string cl = write("part.cls", "GOTO/1.0,2.0\n");
    EXPECT_EQ(run({"post", cl, "-m", "fooke-endura-ca", "-o", path("P.MPF"), "--map", path("P.csv"), "--setup-sheet",
                   path("P.md")})
                  .exit_code,
              3);
    EXPECT_EQ(left(), std::vector<std::string>{"part.cls"});
}

}  // namespace
}  // namespace cusp::cli
