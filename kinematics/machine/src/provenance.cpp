// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Which values of a machine file are documented, and which are assumed because no source speaks of them.
#include <cusp/machine/machine_definition.hpp>

#include <algorithm>
#include <string_view>

namespace cusp::machine {
namespace {

bool covers(std::string_view source_key, std::string_view key) {
    return key == source_key ||
           (key.size() > source_key.size() && key.starts_with(source_key) && key[source_key.size()] == '.');
}

bool isSourced(const MachineDefinition& definition, std::string_view key) {
    return std::any_of(definition.sources.begin(), definition.sources.end(), [&](const Source& source) {
        return std::any_of(source.keys.begin(), source.keys.end(),
                           [&](const std::string& source_key) { return covers(source_key, key); });
    });
}

std::vector<std::string> keysOf(const std::string& table, const std::vector<base::FieldInfo>& fields,
                                bool without_limits) {
    std::vector<std::string> keys;
    for (const base::FieldInfo& field : fields)
        if (!without_limits || (field.key != "min_deg" && field.key != "max_deg"))
            keys.push_back(table + "." + field.key);
    return keys;
}

void addUnsourced(const MachineDefinition& definition, const std::string& table, const std::vector<std::string>& keys,
                  std::vector<std::string>& out) {
    std::vector<std::string> unsourced;
    for (const std::string& key : keys)
        if (!isSourced(definition, key)) unsourced.push_back(key);
    if (unsourced.size() == keys.size())
        out.push_back(table);
    else
        out.insert(out.end(), unsourced.begin(), unsourced.end());
}

}  // namespace

std::vector<std::string> unknownProvenance(const MachineDefinition& definition) {
    std::vector<std::string> out;
    if (!isSourced(definition, "chain")) out.emplace_back("chain");
    for (const base::FieldInfo& field : machineSection().describe()) {
        if (field.key == "linear")
            for (const auto& [name, axis] : definition.linear)
                addUnsourced(definition, "linear." + name, keysOf("linear." + name, field.children, false), out);
        if (field.key == "rotary")
            for (const auto& [name, axis] : definition.rotary)
                addUnsourced(definition, "rotary." + name,
                             keysOf("rotary." + name, field.children, axis.winding == RotaryAxis::Winding::Endless),
                             out);
        if (field.key == "spindle") addUnsourced(definition, "spindle", keysOf("spindle", field.children, false), out);
    }
    return out;
}

}  // namespace cusp::machine
