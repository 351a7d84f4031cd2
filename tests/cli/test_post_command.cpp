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

}  // namespace
}  // namespace cusp::cli
