// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A parsed TOML file and views of its values with their positions; the TOML library itself stays behind this header.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/result.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::base {

/// A view of one value in a TomlDocument; valid as long as the document lives.
class TomlNode {
public:
    [[nodiscard]] bool isTable() const;
    [[nodiscard]] bool isArray() const;
    /// Integers and floats both count as numbers; strings never do.
    [[nodiscard]] std::optional<double> number() const;
    [[nodiscard]] std::optional<std::int64_t> integer() const;
    [[nodiscard]] std::optional<bool> boolean() const;
    [[nodiscard]] std::optional<std::string> text() const;
    /// "a string", "a table" …, for messages.
    [[nodiscard]] std::string typeName() const;

    /// Elements of an array, in order; empty when this is no array.
    [[nodiscard]] std::vector<TomlNode> elements() const;
    /// Keys of a table in file order; empty when this is no table.
    [[nodiscard]] std::vector<std::string> keys() const;
    [[nodiscard]] std::optional<TomlNode> at(std::string_view key) const;

    /// File, line, column and key path of this value.
    [[nodiscard]] Location where() const;
    /// The same place with one more key on the path: for a key that is missing in this table.
    [[nodiscard]] Location whereKey(std::string_view key) const;

private:
    friend class TomlDocument;
    TomlNode(const void* node, std::shared_ptr<const std::string> file, std::string path)
        : node_(node), file_(std::move(file)), path_(std::move(path)) {}

    const void* node_;
    std::shared_ptr<const std::string> file_;
    std::string path_;
};

/// A parsed TOML file. Its first syntax error ends the parse (TOML is not line-oriented); schema errors are all found.
class TomlDocument {
public:
    /// Errors: `io.*` when the file cannot be read, `toml.too-large` above 16 MiB, `toml.syntax` with line and column.
    [[nodiscard]] static Result<TomlDocument> readFile(const std::string& path);
    /// `file_name` is only used in messages.
    [[nodiscard]] static Result<TomlDocument> parse(std::string_view text, const std::string& file_name);

    [[nodiscard]] TomlNode root() const;
    [[nodiscard]] const std::string& fileName() const { return *file_; }

private:
    struct Content;
    TomlDocument() = default;
    std::shared_ptr<const Content> content_;
    std::shared_ptr<const std::string> file_;
};

}  // namespace cusp::base
