// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp verify` from the outside, on programs `cusp post` wrote: true ones pass, altered ones do not.
#include "command_line.hpp"

namespace cusp::cli {
namespace {

class VerifyCommand : public CommandLine {
protected:
    void SetUp() override {
        CommandLine::SetUp();
        cl = write("part.cls", small_cl);
        ASSERT_EQ(run({"post", cl, "-m", "fooke-endura-ca", "-o", path("PART.MPF")}).exit_code, 0);
        program = read("PART.MPF");
    }
    base::ProcessOutcome verify(const std::string& text, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments{"verify", write("TRY.MPF", text), "-m", "fooke-endura-ca", "--against", cl};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return run(arguments);
    }
    std::string altered(const std::string& from, const std::string& to) const {
        const auto at = program.find(from);
        EXPECT_NE(at, std::string::npos) << from << " not in\n" << program;
        return at == std::string::npos ? program : std::string(program).replace(at, from.size(), to);
    }

    std::string cl;
    std::string program;
};

TEST_F(VerifyCommand, ATrueProgramPasses) {
    const auto outcome = verify(program, {"--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors << outcome.output;
    const auto json = nlohmann::json::parse(outcome.output);
    EXPECT_TRUE(json["pass"]);
    EXPECT_EQ(json["points"], 4);
    EXPECT_EQ(json["matched"], 4);
    EXPECT_EQ(json["limit_violations"], 0);
    EXPECT_LE(json["max_tip_error_mm"].get<double>(), 0.001);
    EXPECT_LE(json["max_axis_error_deg"].get<double>(), 0.001);
}

TEST_F(VerifyCommand, AlteredProgramsFail) {
    EXPECT_EQ(verify(altered("A36.8699", "A-36.8699")).exit_code, 1) << "sign";
    EXPECT_EQ(verify(altered("X10", "X10.01")).exit_code, 1) << "position";
    EXPECT_EQ(verify(altered("F1200", "F12000")).exit_code, 1) << "feed";
    EXPECT_EQ(verify(altered(" M3", "")).exit_code, 1) << "spindle";
    EXPECT_EQ(verify(altered("T=\"BALL_6\"", "T=\"BALL_8\"")).exit_code, 1) << "tool";
    EXPECT_NE(verify(altered("TRAORI\n", "\n")).exit_code, 0) << "transformation";
    EXPECT_NE(verify(altered(" G1 ", " G0 ")).exit_code, 0) << "rapid through material";
}

/// Every key docs/json.md names.
TEST_F(VerifyCommand, TheKeysOfItsJson) {
    const auto outcome = verify(program, {"--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const auto json = nlohmann::json::parse(outcome.output);
    for (const char* key : {"pass",
                            "points",
                            "matched",
                            "missed",
                            "blocks",
                            "motions",
                            "intermediate",
                            "links",
                            "excursions",
                            "extra",
                            "max_tip_error_mm",
                            "max_axis_error_deg",
                            "max_tip_between_mm",
                            "max_axis_between_deg",
                            "max_tip_between_rapid_mm",
                            "max_axis_between_rapid_deg",
                            "where",
                            "limit_violations",
                            "rotary_limits",
                            "linear_travel",
                            "against",
                            "diagnostics"})
        EXPECT_TRUE(json.contains(key)) << key;
    EXPECT_EQ(json["where"].size(), 6U);
    EXPECT_EQ(json["linear_travel"], "not checked");
}

TEST_F(VerifyCommand, ASetupChecksTheLinearTravel) {
    const auto in = [&](double z_mm) {
        const std::string setup =
            write("setup.toml", "schema = 1\nname = \"plate\"\n[work_offset.G54]\norigin_mm = [1000.0, 0.0, " +
                                    std::to_string(z_mm) + "]\n[[tool]]\nname = \"BALL_6\"\nlength_mm = 120.0\n");
        return verify(program, {"--setup", setup, "--json"});
    };
    const auto kept = in(-900.0);
    ASSERT_EQ(kept.exit_code, 0) << kept.errors << kept.output;
    EXPECT_EQ(nlohmann::json::parse(kept.output)["linear_travel"], "checked");
    const auto beyond = in(-100.0);
    EXPECT_EQ(beyond.exit_code, 1);
    EXPECT_GT(nlohmann::json::parse(beyond.output)["limit_violations"], 0);
    EXPECT_NE(beyond.errors.find("axis Z is at "), std::string::npos) << beyond.errors;
}

TEST_F(VerifyCommand, TheCuttingEdgeAndTheWorkOffsetAreTheUsers) {
    const std::string other = altered(" D1", " D2");
    EXPECT_EQ(verify(other).exit_code, 1);
    EXPECT_EQ(verify(other, {"--cutting-edge", "2"}).exit_code, 0);
    EXPECT_EQ(verify(altered(" G54", " G55"), {"--work-offset", "G55"}).exit_code, 1) << "only one of them is altered";
}

TEST_F(VerifyCommand, AMisspelledTransformationIsNamed) {
    const auto outcome = verify(altered("TRAFOOF", "TRAOOF"));
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_NE(outcome.errors.find("TRAFOOF"), std::string::npos) << outcome.errors;
    EXPECT_NE(outcome.errors.find("TRY.MPF:6:"), std::string::npos) << outcome.errors;
}

TEST_F(VerifyCommand, TheWrongMachineIsNotFooled) {
    // The same words on a head whose A turns the other way lean the tool to the other side.
    EXPECT_NE(run({"verify", path("PART.MPF"), "-m", "haas-umc-bc", "--against", cl}).exit_code, 0);
}

TEST_F(VerifyCommand, ExitCodesForFiles) {
    EXPECT_EQ(run({"verify", path("none.MPF"), "-m", "fooke-endura-ca"}).exit_code, 4);
    EXPECT_EQ(run({"verify", path("PART.MPF"), "-m", "fooke-endura-ca", "--against", path("none.cls")}).exit_code, 4);
    EXPECT_EQ(run({"verify", path("PART.MPF")}).exit_code, 2);
}

}  // namespace
}  // namespace cusp::cli
