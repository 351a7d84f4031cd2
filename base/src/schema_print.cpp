// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A schema written out: as the TOML of a struct, and as the documentation page of a file.
#include "schema_text.hpp"

#include <fmt/format.h>

namespace cusp::base {
namespace {

std::string commentLines(std::string_view doc) {
    std::string out;
    while (!doc.empty()) {
        const std::size_t end = doc.find('\n');
        out += "# " + std::string(doc.substr(0, end)) + "\n";
        doc = end == std::string_view::npos ? std::string_view() : doc.substr(end + 1);
    }
    return out;
}

bool isNested(const FieldInfo& field) { return !field.children.empty(); }

std::string cell(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '|') out += '\\';
        out += c == '\n' ? ' ' : c;
    }
    return out;
}

std::string code(std::string_view text) { return text.empty() ? std::string() : "`" + cell(text) + "`"; }

std::string demandText(const FieldInfo& field) {
    std::string range = rangeText(field.rules);
    if (!field.required) return range;
    return range.empty() ? "required" : "required, " + range;
}

std::string headerOf(const FieldInfo& field, const std::string& path) {
    if (field.type == "array of tables") return "[[" + path + "]]";
    return "[" + path + "]";
}

void appendTable(std::string& out, const std::vector<FieldInfo>& fields) {
    bool has_rows = false;
    for (const FieldInfo& field : fields) {
        if (isNested(field)) continue;
        if (!has_rows) out += "| key | type | unit | default | demanded | meaning |\n|---|---|---|---|---|---|\n";
        has_rows = true;
        out += fmt::format("| {} | {} | {} | {} | {} | {} |\n", code(field.key), cell(field.type),
                           displayUnit(unitOfKey(field.key)), code(field.default_text), demandText(field),
                           cell(field.doc));
    }
    if (has_rows) out += "\n";
}

void appendSections(std::string& out, const std::vector<FieldInfo>& fields, const std::string& path) {
    for (const FieldInfo& field : fields) {
        if (!isNested(field)) continue;
        std::string here = path.empty() ? field.key : path + "." + field.key;
        if (field.type == "named tables") here += ".NAME";
        out += "## `" + headerOf(field, here) + "`\n\n" + field.doc + "\n\n";
        if (field.type == "named tables") out += "One table per name; the names are yours to choose.\n\n";
        if (field.required) out += "Required.\n\n";
        appendTable(out, field.children);
        appendSections(out, field.children, here);
    }
}

}  // namespace

void ConfigPrinter::value(const FieldInfo& info, const std::string& text) {
    std::string& body = tables_[open_.back()].body;
    if (docs_ == PrintDocs::Yes) body += commentLines(info.doc);
    if (!text.empty())
        body += quoteTomlKey(info.key) + " = " + text + "\n";
    else if (docs_ == PrintDocs::Yes)
        body += "# " + quoteTomlKey(info.key) + " =\n";
}

void ConfigPrinter::open(std::string_view before, const std::string& key, std::string_view after,
                         std::string_view doc) {
    path_.push_back(path_.empty() ? key : path_.back() + "." + key);
    open_.push_back(tables_.size());
    std::string header = docs_ == PrintDocs::Yes ? commentLines(doc) : std::string();
    header += std::string(before) + path_.back() + std::string(after) + "\n";
    tables_.push_back({std::move(header), {}});
}

void ConfigPrinter::close() {
    path_.pop_back();
    open_.pop_back();
}

std::string ConfigPrinter::text() const {
    std::string out;
    for (const Table& table : tables_) {
        if (!out.empty() && !table.header.empty()) out += "\n";
        out += table.header + table.body;
    }
    return out;
}

std::string schemaMarkdown(const std::string& title, const std::string& intro, const std::vector<FieldInfo>& fields) {
    std::string out = "# " + title + "\n\n";
    if (!intro.empty()) out += intro + "\n\n";
    appendTable(out, fields);
    appendSections(out, fields, {});
    while (out.ends_with("\n\n")) out.pop_back();
    return out;
}

}  // namespace cusp::base
