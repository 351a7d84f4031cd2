// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One table of fields drives reading, unknown-key errors, `--print-config` and the documentation page of a TOML file.
#pragma once

#include <cusp/base/diagnostics.hpp>
#include <cusp/base/schema_field.hpp>
#include <cusp/base/toml_node.hpp>

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace cusp::base {

/// The field table of a struct T. Rooms build theirs once and hand it to the functions below:
///
///     Section<LinearAxis> section("A linear axis.");
///     section.field("min_mm", &LinearAxis::min_mm, "Lower end of travel.", required());
///
/// The unit of a number is the end of its key: `_mm`, `_deg`, `_mm_per_min` … (`unitOfKey`). Members hold the unit used
/// inside (mm, rad, s); the conversion is made here and nowhere else.
template <class T>
class Section {
    template <class M>
    struct WithoutOptional {
        using Type = M;
    };
    template <class M>
    struct WithoutOptional<std::optional<M>> {
        using Type = M;
    };

public:
    /// What a user may write, and what each word means.
    template <class M>
    using Words = std::vector<std::pair<std::string, typename WithoutOptional<M>::Type>>;

    explicit Section(std::string doc) : doc_(std::move(doc)) {}

    /// A plain value: double, std::int64_t, bool, std::string, std::array<double, n>; std::vector of those;
    /// std::map<std::string, …> of those (named numbers: `rotary_deg = {A = 10}`); std::optional of any of these (an
    /// absent key leaves it as it is by default, which should be empty: TOML cannot write "nothing").
    template <class V>
    Section& field(const std::string& key, V T::* member, const std::string& doc, FieldRules rules = {}) {
        FieldInfo info = describeField<V>(key, doc, rules);
        info.default_text = rules.required ? "" : printValue(T{}.*member, info);
        fields_.push_back(
            {info,
             [member, info](T& out, const TomlNode& node, Diagnostics& report) {
                 readValue(node, info, out.*member, report);
             },
             [member, info](const T& value, ConfigPrinter& out) { out.value(info, printValue(value.*member, info)); }});
        return *this;
    }

    /// One of a fixed set of words; for an optional member, or no such key.
    template <class M>
    Section& choice(std::string key, M T::* member, const Words<M>& words, std::string doc, FieldRules rules = {}) {
        FieldInfo info;
        info.key = std::move(key);
        info.doc = std::move(doc);
        info.required = rules.required;
        info.type = wordList(words);
        const auto word_of = [words](const M& value) {
            for (const auto& [word, meaning] : words)
                if (value == M(meaning)) return quoteToml(word);
            return std::string();
        };
        info.default_text = rules.required ? "" : word_of(T{}.*member);
        fields_.push_back(
            {info,
             [member, words, info](T& out, const TomlNode& node, Diagnostics& report) {
                 const auto text = node.text();
                 for (const auto& [word, meaning] : words)
                     if (text && *text == word) {
                         out.*member = meaning;
                         return;
                     }
                 reportWrongType(node, info, report);
             },
             [member, word_of, info](const T& value, ConfigPrinter& out) { out.value(info, word_of(value.*member)); }});
        return *this;
    }

    /// A nested table `[key]`.
    template <class U>
    Section& table(std::string key, U T::* member, const Section<U>& section, FieldRules rules = {}) {
        FieldInfo info = nestedInfo(std::move(key), section.doc(), "table", rules, section.describe());
        fields_.push_back({info,
                           [member, section](T& out, const TomlNode& node, Diagnostics& report) {
                               out.*member = section.read(node, report);
                           },
                           [member, section, info](const T& value, ConfigPrinter& out) {
                               printTable(section, value.*member, info, "[", quoteTomlKey(info.key), out);
                           }});
        return *this;
    }

    /// A nested table that may be absent; the member is empty then.
    template <class U>
    Section& table(std::string key, std::optional<U> T::* member, const Section<U>& section, FieldRules rules = {}) {
        FieldInfo info = nestedInfo(std::move(key), section.doc(), "table", rules, section.describe());
        fields_.push_back({info,
                           [member, section](T& out, const TomlNode& node, Diagnostics& report) {
                               out.*member = section.read(node, report);
                           },
                           [member, section, info](const T& value, ConfigPrinter& out) {
                               if (value.*member)
                                   printTable(section, *(value.*member), info, "[", quoteTomlKey(info.key), out);
                           }});
        return *this;
    }

    /// An array of tables `[[key]]`.
    template <class U>
    Section& tables(std::string key, std::vector<U> T::* member, const Section<U>& section, FieldRules rules = {}) {
        FieldInfo info = nestedInfo(std::move(key), section.doc(), "array of tables", rules, section.describe());
        fields_.push_back({info,
                           [member, section, info](T& out, const TomlNode& node, Diagnostics& report) {
                               if (!node.isArray()) return reportWrongType(node, info, report);
                               std::vector<U> values;
                               for (const TomlNode& element : node.elements())
                                   values.push_back(section.read(element, report));
                               out.*member = std::move(values);
                           },
                           [member, section, info](const T& value, ConfigPrinter& out) {
                               if ((value.*member).empty()) out.value(info, "[]");
                               for (const U& element : value.*member)
                                   printTable(section, element, info, "[[", quoteTomlKey(info.key), out);
                           }});
        return *this;
    }

    /// Tables under names the user chooses: `[key.NAME]`. Order is the order of the names.
    template <class U>
    Section& named(std::string key, std::map<std::string, U> T::* member, const Section<U>& section,
                   FieldRules rules = {}) {
        FieldInfo info = nestedInfo(std::move(key), section.doc(), "named tables", rules, section.describe());
        fields_.push_back({info,
                           [member, section, info](T& out, const TomlNode& node, Diagnostics& report) {
                               if (!node.isTable()) return reportWrongType(node, info, report);
                               std::map<std::string, U> values;
                               for (const std::string& name : node.keys())
                                   if (const auto element = node.at(name))
                                       values[name] = section.read(*element, report);
                               out.*member = std::move(values);
                           },
                           [member, section, info](const T& value, ConfigPrinter& out) {
                               if ((value.*member).empty()) out.value(info, "{}");
                               for (const auto& [name, element] : value.*member)
                                   printTable(section, element, info, "[",
                                              quoteTomlKey(info.key) + "." + quoteTomlKey(name), out);
                           }});
        return *this;
    }

    /// A rule over the whole struct ("min must lie below max"), run only when every field was read without error.
    Section& check(std::function<void(const T&, const TomlNode&, Diagnostics&)> rule) {
        checks_.push_back(std::move(rule));
        return *this;
    }

    /// Reads every field, reports every problem. The result is only meaningful when `report` gained no error.
    [[nodiscard]] T read(const TomlNode& table, Diagnostics& report) const {
        const std::size_t errors_before = report.errorCount();
        T out{};
        if (!table.isTable()) {
            reportNotATable(table, report);
            return out;
        }
        for (const Field& field : fields_) {
            if (const auto node = table.at(field.info.key))
                field.read(out, *node, report);
            else if (field.info.required)
                reportMissing(table, field.info, report);
        }
        if (!shares_table_) reportUnknownKeys(table, {describe()}, report);
        if (report.errorCount() == errors_before)
            for (const auto& rule : checks_) rule(out, table, report);
        return out;
    }

    /// Says that other sections read the same table too (the root of a file whose tables belong to several rooms);
    /// unknown keys are then reported by whoever reads the whole: `reportUnknownKeys`.
    Section& sharesTable() {
        shares_table_ = true;
        return *this;
    }

    void print(const T& value, ConfigPrinter& out) const {
        for (const Field& field : fields_) field.print(value, out);
    }

    /// The struct as TOML text that reads back to the same struct; every default written out, units in the keys.
    [[nodiscard]] std::string toToml(const T& value, PrintDocs docs = PrintDocs::No) const {
        ConfigPrinter out(docs);
        print(value, out);
        return out.text();
    }

    [[nodiscard]] const std::string& doc() const { return doc_; }
    [[nodiscard]] std::vector<FieldInfo> describe() const {
        std::vector<FieldInfo> out;
        out.reserve(fields_.size());
        for (const Field& field : fields_) out.push_back(field.info);
        return out;
    }

private:
    template <class U>
    static void printTable(const Section<U>& section, const U& value, const FieldInfo& info, std::string_view before,
                           const std::string& key, ConfigPrinter& out) {
        out.open(before, key, before == "[[" ? "]]" : "]", info.doc);
        section.print(value, out);
        out.close();
    }

    struct Field {
        FieldInfo info;
        std::function<void(T&, const TomlNode&, Diagnostics&)> read;
        std::function<void(const T&, ConfigPrinter&)> print;
    };

    std::string doc_;
    std::vector<Field> fields_;
    std::vector<std::function<void(const T&, const TomlNode&, Diagnostics&)>> checks_;
    bool shares_table_ = false;
};

}  // namespace cusp::base
