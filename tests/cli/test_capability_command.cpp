// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp capability`: what it says, the folder it leaves, and what it refuses.
#include "command_line.hpp"

namespace cusp::cli {
namespace {

class CapabilityCommand : public CommandLine {
protected:
    /// One document with a diameter of 10 ± 0.1 mm on each of `values`.
    std::string document(const std::string& name, const std::vector<std::string>& values) const {
        std::string text =
            R"(<QIFDocument versionQIF="3.0.0"><FileUnits><PrimaryUnits><LinearUnit><UnitConversion>)"
            "<Factor>0.001</Factor></UnitConversion></LinearUnit></PrimaryUnits></FileUnits><Characteristics>"
            R"(<CharacteristicDefinitions><DiameterCharacteristicDefinition id="1"><Tolerance>)"
            "<MaxValue>0.1</MaxValue><MinValue>-0.1</MinValue></Tolerance></DiameterCharacteristicDefinition>"
            "</CharacteristicDefinitions><CharacteristicNominals>"
            R"(<DiameterCharacteristicNominal id="2"><CharacteristicDefinitionId>1</CharacteristicDefinitionId>)"
            "<TargetValue>10</TargetValue></DiameterCharacteristicNominal></CharacteristicNominals>"
            R"(<CharacteristicItems><DiameterCharacteristicItem id="3"><Name>bore</Name>)"
            "<CharacteristicNominalId>2</CharacteristicNominalId></DiameterCharacteristicItem>"
            "</CharacteristicItems></Characteristics><Results>";
        for (const std::string& value : values)
            text += "<MeasurementResults><CharacteristicMeasurements><DiameterCharacteristicMeasurement>"
                    "<CharacteristicItemId>3</CharacteristicItemId><Value>" +
                    value +
                    "</Value></DiameterCharacteristicMeasurement></CharacteristicMeasurements></MeasurementResults>";
        return write(name, text + "</Results></QIFDocument>");
    }
};

TEST_F(CapabilityCommand, TakesSeveralFilesAsOneOrderOfParts) {
    const auto outcome =
        run({"capability", document("a.qif", {"9.98", "10.02"}), document("b.qif", {"10.00"}), "--json"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.errors;
    const auto summary = nlohmann::json::parse(outcome.output);
    EXPECT_EQ(summary["parts"].size(), 3U);
    const auto& bore = summary["characteristics"][0];
    EXPECT_EQ(bore["count"], 3);
    // s = 0.02, moving ranges 0.04 and 0.02.
    EXPECT_NEAR(bore["pp"].get<double>(), 0.2 / (6.0 * 0.02), 1e-9);
    EXPECT_NEAR(bore["cp"].get<double>(), 0.2 / (6.0 * 0.03 / 1.1283791670955126), 1e-9);
    EXPECT_TRUE(bore["trend_probability"].is_null());
}

TEST_F(CapabilityCommand, LeavesAPageAndFindsWhatIsBeyond) {
    const auto outcome = run({"capability", document("a.qif", {"9.98", "10.2"}), "-o", path("report")});
    EXPECT_EQ(outcome.exit_code, 1) << outcome.errors;
    EXPECT_NE(outcome.output.find("2 parts, 1 characteristics"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(read("report/capability.json"))["characteristics"][0]["beyond_limits"], 1);
    EXPECT_TRUE(read("report/capability.html").starts_with("<!doctype html>"));
}

TEST_F(CapabilityCommand, SaysWhatItCannotRead) {
    const std::string broken = write("broken.qif", "<QIFDocument versionQIF=\"3.0.0\">");
    const auto outcome = run({"capability", broken, "-o", path("report")});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(outcome.errors, broken + ":1:33: error: not well-formed XML: no element found [qif.xml]\n");
    const std::string empty = write("empty.qif", "<QIFDocument versionQIF=\"3.0.0\"/>");
    EXPECT_EQ(run({"capability", empty}).errors,
              empty + ": error: the document holds no measured characteristic with a value [capability.nothing]\n");
    EXPECT_EQ(left(), (std::vector<std::string>{"broken.qif", "empty.qif"}));
}

TEST_F(CapabilityCommand, ChecksAgainstASchemaOnDemand) {
    const std::string file = document("a.qif", {"9.98"});
    const auto outcome = run({"capability", file, "--qif-schema", path("schema")});
    EXPECT_EQ(outcome.exit_code, 4);
    EXPECT_EQ(outcome.errors,
              path("schema") + "/QIFApplications/QIFDocument.xsd: error: there is no such schema [io.open]\n");
}

}  // namespace
}  // namespace cusp::cli
