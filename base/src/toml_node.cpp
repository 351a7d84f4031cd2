// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The adapter to toml++: the only file that includes it, built so that it returns errors instead of throwing them.
#define TOML_EXCEPTIONS 0
#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0
#define TOML_ENABLE_UNRELEASED_FEATURES 0
#define TOML_FLOAT_CHARCONV 1
// Values within values: far beyond any machine file, far below what a stack takes.
#define TOML_MAX_NESTED_VALUES 32
#include "toml_messages.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/schema_field.hpp>
#include <cusp/base/toml_node.hpp>

#include <algorithm>
#include <toml++/toml.h>
#include <utility>

namespace cusp::base {
namespace {

constexpr std::size_t max_file_bytes = std::size_t{16} << 20U;

const toml::node& nodeOf(const void* node) { return *static_cast<const toml::node*>(node); }

std::string joinPath(const std::string& path, std::string_view key) {
    const std::string last = quoteTomlKey(key);
    return path.empty() ? last : path + "." + last;
}

tl::unexpected<Diagnostics> failTooLarge(const std::string& file_name) {
    return fail("toml.too-large", "this file is larger than 16 MiB; a machine, tool or job file never is",
                {.file = file_name, .line = 0, .column = 0, .key = {}});
}

}  // namespace

struct TomlDocument::Content {
    toml::table root;
};

bool TomlNode::isTable() const { return nodeOf(node_).is_table(); }
bool TomlNode::isArray() const { return nodeOf(node_).is_array(); }

std::optional<double> TomlNode::number() const {
    if (const auto* value = nodeOf(node_).as_floating_point()) return value->get();
    if (const auto* value = nodeOf(node_).as_integer()) return static_cast<double>(value->get());
    return std::nullopt;
}

std::optional<std::int64_t> TomlNode::integer() const {
    if (const auto* value = nodeOf(node_).as_integer()) return value->get();
    return std::nullopt;
}

std::optional<bool> TomlNode::boolean() const {
    if (const auto* value = nodeOf(node_).as_boolean()) return value->get();
    return std::nullopt;
}

std::optional<std::string> TomlNode::text() const {
    if (const auto* value = nodeOf(node_).as_string()) return value->get();
    return std::nullopt;
}

std::string TomlNode::typeName() const {
    switch (nodeOf(node_).type()) {
        case toml::node_type::table: return "a table";
        case toml::node_type::array: return "a list";
        case toml::node_type::string: return "a text";
        case toml::node_type::integer: return "an integer";
        case toml::node_type::floating_point: return "a number";
        case toml::node_type::boolean: return "true or false";
        case toml::node_type::date: return "a date";
        case toml::node_type::time: return "a time of day";
        case toml::node_type::date_time: return "a date and time";
        case toml::node_type::none: break;
    }
    return "nothing";
}

std::vector<TomlNode> TomlNode::elements() const {
    std::vector<TomlNode> out;
    const auto* array = nodeOf(node_).as_array();
    if (array == nullptr) return out;
    out.reserve(array->size());
    for (std::size_t i = 0; i < array->size(); ++i)
        out.push_back({array->get(i), file_, path_ + "[" + std::to_string(i) + "]"});
    return out;
}

std::vector<std::string> TomlNode::keys() const {
    const auto* table = nodeOf(node_).as_table();
    if (table == nullptr) return {};
    // toml++ sorts by name; people read their file from the top.
    std::vector<std::pair<toml::source_position, std::string>> found;
    for (const auto& [key, value] : *table) found.emplace_back(key.source().begin, std::string(key.str()));
    std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> out;
    out.reserve(found.size());
    for (auto& [position, key] : found) out.push_back(std::move(key));
    return out;
}

std::optional<TomlNode> TomlNode::at(std::string_view key) const {
    const auto* table = nodeOf(node_).as_table();
    if (table == nullptr) return std::nullopt;
    const toml::node* value = table->get(key);
    if (value == nullptr) return std::nullopt;
    return TomlNode(value, file_, joinPath(path_, key));
}

Location TomlNode::where() const {
    const toml::source_position begin = nodeOf(node_).source().begin;
    // The root table has no place of its own; "1:1" would only lead the eye astray.
    if (path_.empty()) return {.file = *file_, .line = 0, .column = 0, .key = {}};
    return {.file = *file_, .line = begin.line, .column = begin.column, .key = path_};
}

Location TomlNode::whereKey(std::string_view key) const {
    Location out = where();
    out.key = joinPath(path_, key);
    if (const auto* table = nodeOf(node_).as_table()) {
        const auto entry = table->find(key);
        if (entry != table->end()) {
            out.line = entry->first.source().begin.line;
            out.column = entry->first.source().begin.column;
        }
    }
    return out;
}

Result<TomlDocument> TomlDocument::readFile(const std::string& path) {
    auto text = readWholeFile(path, max_file_bytes);
    if (text) return parse(*text, path);
    if (text.error().front().code == "io.too-large") return failTooLarge(path);
    return fail(std::move(text.error()));
}

Result<TomlDocument> TomlDocument::parse(std::string_view text, const std::string& file_name) {
    if (text.size() > max_file_bytes) return failTooLarge(file_name);
    if (const auto problem = findTextProblem(text))
        return fail("toml.syntax", std::string(problem->message),
                    {.file = file_name, .line = problem->line, .column = 0, .key = {}});
    toml::parse_result result = toml::parse(text);
    if (!result) {
        const toml::parse_error& error = result.error();
        const toml::source_position begin = error.source().begin;
        return fail("toml.syntax", cleanTomlMessage(error.description()),
                    {.file = file_name, .line = begin.line, .column = begin.column, .key = {}});
    }
    TomlDocument document;
    document.content_ = std::make_shared<const Content>(Content{std::move(result).table()});
    document.file_ = std::make_shared<const std::string>(file_name);
    return document;
}

TomlNode TomlDocument::root() const {
    const toml::node& root = content_->root;
    return TomlNode(&root, file_, {});
}

}  // namespace cusp::base
