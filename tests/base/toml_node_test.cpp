// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Views of a TOML file: values, order, places; and texts that try to break the parser.
#include <cusp/base/atomic_file.hpp>
#include <cusp/base/toml_node.hpp>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace {

using namespace cusp::base;

std::string errorOf(std::string_view text) {
    const auto document = TomlDocument::parse(text, "T.toml");
    return document ? std::string("no error") : toText(document.error());
}

std::string repeat(std::string_view piece, std::size_t count) {
    std::string out;
    for (std::size_t i = 0; i < count; ++i) out += piece;
    return out;
}

TEST(TomlNode, ValuesByType) {
    const auto document =
        TomlDocument::parse("i = 3\nf = 2.5\nt = \"x\"\nb = true\nl = [1]\nd = 2024-01-02\n[s]\n", "T");
    ASSERT_TRUE(document.has_value());
    const TomlNode root = document->root();
    EXPECT_EQ(root.at("i")->integer(), 3);
    EXPECT_EQ(root.at("i")->number(), 3.0);
    EXPECT_EQ(root.at("f")->number(), 2.5);
    EXPECT_EQ(root.at("f")->integer(), std::nullopt);
    EXPECT_EQ(root.at("t")->text(), "x");
    EXPECT_EQ(root.at("t")->number(), std::nullopt);
    EXPECT_EQ(root.at("b")->boolean(), true);
    EXPECT_EQ(root.at("l")->elements().size(), 1U);
    EXPECT_EQ(root.at("d")->typeName(), "a date");
    EXPECT_TRUE(root.at("s")->isTable());
    EXPECT_FALSE(root.at("none").has_value());
    EXPECT_FALSE(root.at("i")->at("x").has_value());
    EXPECT_TRUE(root.at("i")->keys().empty());
    EXPECT_TRUE(root.at("i")->elements().empty());
}

TEST(TomlNode, KeysKeepTheOrderOfTheFile) {
    const auto document = TomlDocument::parse("z = 1\na = 2\n[m]\n[b.c]\n", "T");
    EXPECT_EQ(document->root().keys(), (std::vector<std::string>{"z", "a", "m", "b"}));
}

TEST(TomlNode, PlacesAndPaths) {
    const auto document = TomlDocument::parse("[rotary.A]\nmin_deg = -120\n\n[[anchor]]\n[[anchor]]\n"
                                              "tool_axis = [0,\n 1]\n[rotary.\"B C\"]\nx = 1\n",
                                              "M.toml");
    ASSERT_TRUE(document.has_value());
    const TomlNode root = document->root();
    const Location min = root.at("rotary")->at("A")->at("min_deg")->where();
    EXPECT_EQ(min.file, "M.toml");
    EXPECT_EQ(min.line, 2U);
    EXPECT_EQ(min.column, 11U);
    EXPECT_EQ(min.key, "rotary.A.min_deg");
    const TomlNode anchor = root.at("anchor")->elements()[1];
    EXPECT_EQ(anchor.where().key, "anchor[1]");
    EXPECT_EQ(anchor.where().line, 5U);
    const Location second = anchor.at("tool_axis")->elements()[1].where();
    EXPECT_EQ(second.key, "anchor[1].tool_axis[1]");
    EXPECT_EQ(second.line, 7U);
    EXPECT_EQ(root.at("rotary")->at("B C")->at("x")->where().key, "rotary.\"B C\".x");
    const Location missing = anchor.whereKey("source");
    EXPECT_EQ(missing.key, "anchor[1].source");
    EXPECT_EQ(missing.line, 5U);
    EXPECT_EQ(root.whereKey("name").line, 0U);
    EXPECT_EQ(root.whereKey("rotary").line, 1U);
}

TEST(TomlNode, OutlivesItsText) {
    std::optional<TomlDocument> document;
    {
        const std::string text = "a = \"kept\"\n";
        document = TomlDocument::parse(text, "T").value();
    }
    EXPECT_EQ(document->root().at("a")->text(), "kept");
}

TEST(TomlNode, ByteOrderMarkAndLineEndings) {
    EXPECT_EQ(TomlDocument::parse("\xEF\xBB\xBF"
                                  "a = 1\r\nb = 2\r\n",
                                  "T")
                  ->root()
                  .keys()
                  .size(),
              2U);
    EXPECT_EQ(TomlDocument::parse("", "T")->root().keys().size(), 0U);
    EXPECT_EQ(TomlDocument::parse("a = 1", "T")->root().at("a")->integer(), 1);
}

TEST(TomlNode, NestingDoesNotOverflowTheStack) {
    const std::string too_deep = "lists and tables nested deeper than 32";
    for (const std::string& text : {"a = " + repeat("[", 100000), "a = " + repeat("[", 100000) + repeat("]", 100000),
                                    "a = " + repeat("{b=", 100000)})
        EXPECT_NE(errorOf(text).find(too_deep), std::string::npos) << errorOf(text);
    for (const std::string& text :
         {repeat("a.", 1000000) + "a = 1\n", "[" + repeat("a.", 1000000) + "a]\n",
          "x = {" + repeat("a . ", 1000000) + "a = 1}\n", "[" + repeat("\"a\".", 100000) + "a]\n",
          "x = [ \"\"\"a\"\"\"\", {" + repeat("a.", 100000) + "a = 1} ]\n"})
        EXPECT_EQ(errorOf(text), "T.toml:1: error: a key of more than 32 parts [toml.syntax]\n");
    EXPECT_EQ(errorOf("a = " + repeat("[", 31) + repeat("]", 31)), "no error");
    EXPECT_EQ(errorOf(repeat("a.", 31) + "a = 1"), "no error");
}

TEST(TomlNode, DotsInTextsAndCommentsAreNoDepth) {
    const std::string dots = repeat(".", 1000);
    EXPECT_EQ(errorOf("# " + dots + "\na = \"" + dots + "\" # " + dots + "\nb = '''\n'" + dots + "'''\nc = \"\\\"" +
                      dots + "\"\n"),
              "no error");
    EXPECT_EQ(errorOf("a = \"\"\"\nx\n\"\"\"\n" + repeat("a.", 40) + "a = 1"),
              "T.toml:4: error: a key of more than 32 parts [toml.syntax]\n");
}

TEST(TomlNode, SizeIsLimited) {
    const std::size_t limit = std::size_t{16} << 20U;
    EXPECT_EQ(errorOf(std::string(limit, '\n')), "no error");
    EXPECT_EQ(
        errorOf(std::string(limit + 1, '\n')),
        "T.toml: error: this file is larger than 16 MiB; a machine, tool or job file never is [toml.too-large]\n");
    const auto endless = TomlDocument::readFile("/dev/zero");
    ASSERT_FALSE(endless.has_value());
    EXPECT_EQ(
        toText(endless.error()),
        "/dev/zero: error: this file is larger than 16 MiB; a machine, tool or job file never is [toml.too-large]\n");
}

TEST(TomlNode, ReadsFilesAndSaysWhyNot) {
    std::string path = (std::filesystem::temp_directory_path() / "cusp-test-XXXXXX").string();
    ASSERT_NE(::mkdtemp(path.data()), nullptr);
    const std::string file = path + "/a.toml";
    ASSERT_TRUE(writeWholeFile(file, "a = 1\n").has_value());
    EXPECT_EQ(TomlDocument::readFile(file)->root().at("a")->integer(), 1);
    EXPECT_EQ(TomlDocument::readFile(file)->fileName(), file);
    std::filesystem::remove_all(path);
    EXPECT_EQ(toText(TomlDocument::readFile(file).error()),
              file + ": error: cannot open this file: No such file or directory [io.open]\n");
}

}  // namespace
