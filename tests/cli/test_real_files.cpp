// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Real five-axis CL files, posted and proved on every shipped machine that can hold them.
#include "command_line.hpp"

namespace cusp::cli {
namespace {

class RealFiles : public CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        if (!std::filesystem::exists(CUSP_SHARED_DATA)) GTEST_SKIP() << "no real files at " << CUSP_SHARED_DATA;
    }
    /// `shared_flags` go to both commands.
    nlohmann::json postAndVerify(const std::string& name, const std::string& machine,
                                 const std::vector<std::string>& shared_flags = {}, const std::string& form = {}) {
        const std::string cl = std::string(CUSP_SHARED_DATA) + "/cl/" + name;
        std::vector<std::string> posting{
            "post", cl, "-m", machine, "-o", path("P.MPF"), "--spindle-rpm", "5000", "--no-cycle-time", "--json"};
        std::vector<std::string> verifying{"verify", path("P.MPF"), "-m", machine, "--against", cl, "--json"};
        if (!form.empty()) posting.insert(posting.end(), {"--form", form});
        // With vectors the control chooses the positions of the rotary axes, and nothing can be unwound.
        if (form == "traori-vectors") posting.insert(posting.end(), {"--pole-cone-deg", "3"});
        if (!form.empty()) verifying.insert(verifying.end(), {"--between-tip-tolerance-mm", "0.005"});
        for (auto* arguments : {&posting, &verifying})
            arguments->insert(arguments->end(), shared_flags.begin(), shared_flags.end());
        const auto posted = run(posting);
        EXPECT_EQ(posted.exit_code, 0) << machine << "\n" << posted.errors << posted.output;
        post = nlohmann::json::parse(posted.output, nullptr, false);
        const auto verified = run(verifying);
        EXPECT_EQ(verified.exit_code, 0) << machine << "\n" << verified.errors << verified.output;
        return nlohmann::json::parse(verified.output, nullptr, false);
    }

    nlohmann::json post;  ///< what the last posting said of itself
};

TEST_F(RealFiles, FiveAxisPathsFollowTheirClFiles) {
    for (const std::string machine : {"fooke-endura-ca", "head-c200-a95", "haas-umc-bc", "trunnion-ac"}) {
        const auto json = postAndVerify("nx_variable_axis.cls", machine);
        EXPECT_EQ(json["points"], 348);
        EXPECT_EQ(json["matched"], 348);
        EXPECT_LE(json["max_tip_error_mm"].get<double>(), 0.001);
        EXPECT_LE(json["max_axis_error_deg"].get<double>(), 0.001);
        EXPECT_EQ(json["limit_violations"], 0);
        // What the post says of its own program is what the witness finds.
        EXPECT_NEAR(post["max_axis_between_deg"].get<double>(), json["max_axis_between_deg"].get<double>(), 0.01)
            << machine;
    }
    EXPECT_EQ(postAndVerify("nx_apt_code.cls", "fooke-endura-ca")["matched"], 325);
}

TEST_F(RealFiles, EveryFormFollowsTheFile) {
    for (const std::string machine : {"fooke-endura-ca", "head-c200-a95", "haas-umc-bc", "trunnion-ac", "nutating-45"})
        for (const std::string form : {"traori-rotary", "traori-vectors", "machine"}) {
            const auto json = postAndVerify("nx_variable_axis.cls", machine,
                                            {"--tool-length-mm", "120", "--wcs-origin-mm", "10", "-20", "30"}, form);
            EXPECT_EQ(json["matched"], 348) << machine << ", " << form;
            EXPECT_LE(json["max_tip_error_mm"].get<double>(), 0.001);
            EXPECT_LE(json["max_axis_error_deg"].get<double>(), 0.001);
            EXPECT_LE(json["max_tip_between_mm"].get<double>(), 0.005);
            EXPECT_EQ(json["excursions"], post["excursions"]) << machine << ", " << form;
        }
}

TEST_F(RealFiles, EveryMillingFileIsPosted) {
    const auto posted = [&](const std::string& name, const std::string& machine, std::vector<std::string> more) {
        std::vector<std::string> arguments{"post",
                                           std::string(CUSP_SHARED_DATA) + "/cl/" + name,
                                           "-m",
                                           machine,
                                           "-o",
                                           path("P.MPF"),
                                           "--no-cycle-time",
                                           "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const auto outcome = run(arguments);
        EXPECT_EQ(outcome.exit_code, 0) << name << "\n" << outcome.errors;
        return nlohmann::json::parse(outcome.output, nullptr, false);
    };
    EXPECT_EQ(posted("catia_demo2.apt", "three-axis", {"--units", "mm", "--tap-pitch-mm", "1.5"})["cutter_locations"],
              2);
    EXPECT_NE(read("P.MPF").find("MCALL CYCLE84("), std::string::npos);
    EXPECT_EQ(posted("catia_demo4.apt", "three-axis", {})["cutter_locations"], 22);
    EXPECT_EQ(posted("swcam_wall_holes.apt", "nutating-45", {})["cutter_locations"], 1864);
    EXPECT_NE(read("P.MPF").find("CYCLE800("), std::string::npos);
    EXPECT_NE(read("P.MPF").find(" G41 "), std::string::npos);
    // Turning is refused by name.
    for (const std::string name : {"catia_demo1.apt", "catia_demo3.apt", "catia_demo5.apt"}) {
        const auto refused =
            run({"post", std::string(CUSP_SHARED_DATA) + "/cl/" + name, "-m", "three-axis", "-o", path("T.MPF")});
        EXPECT_EQ(refused.exit_code, 3) << name;
        EXPECT_NE(refused.errors.find("this is a turning program"), std::string::npos) << refused.errors;
    }
}

TEST_F(RealFiles, TheToolAxisStaysOnItsWay) {
    for (const std::string machine :
         {"haas-umc-bc", "trunnion-ac", "nutating-45", "fooke-endura-ca", "head-c200-a95"}) {
        const auto json = postAndVerify("nx_variable_axis.cls", machine);
        EXPECT_LE(json["max_axis_between_deg"].get<double>(), 0.05) << machine;
        EXPECT_GT(json["intermediate"], 0) << machine;
        // Only on the heads does C have ends; there the tool leaves the part to unwind it.
        const bool head = machine == "fooke-endura-ca" || machine == "head-c200-a95";
        EXPECT_EQ(json["excursions"] != 0, head) << machine;
        EXPECT_EQ(json["excursions"], post["excursions"]) << machine;
    }
}

TEST_F(RealFiles, LimitsMayBeRefusedOrMetInThePoleCone) {
    const std::string cl = std::string(CUSP_SHARED_DATA) + "/cl/nx_variable_axis.cls";
    std::vector<std::string> posting{"post",          cl,     "-m",         "fooke-endura-ca", "-o", path("P.MPF"),
                                     "--spindle-rpm", "5000", "--at-limit", "refuse"};
    const auto refused = run(posting);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_NE(refused.errors.find("error: the limits force a rewind while cutting, at CL line 193: "),
              std::string::npos)
        << refused.errors;
    posting.insert(posting.end(), {"--pole-cone-deg", "3"});
    const auto swung = run(posting);
    EXPECT_EQ(swung.exit_code, 0) << swung.errors;
    EXPECT_NE(swung.errors.find("[post.pole-cone]"), std::string::npos) << swung.errors;
}

TEST_F(RealFiles, ArcsFollowTheirClFiles) {
    for (const std::string machine : {"fooke-endura-ca", "three-axis"}) {
        EXPECT_EQ(postAndVerify("nx_zig.cls", machine)["matched"], 118);
        EXPECT_EQ(postAndVerify("nx_zigzag_smoothed.cls", machine)["matched"], 75);
    }
}

}  // namespace
}  // namespace cusp::cli
