// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The `[post]` table of a job file and the name an 840D program may bear.
#include <cusp/post/writer/post_options.hpp>

#include <cusp/post/control/control_definition.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace cusp::post {

namespace {

constexpr std::size_t name_limit = 24;  // PM12 p42

bool isNameCharacter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

bool fitsAnyProgram(const std::string& name) {
    return name.size() <= name_limit && std::all_of(name.begin(), name.end(), isNameCharacter);
}

/// `where` names the place of a key, in a job file or on the command line.
template <class Where>
void check(const PostOptions& options, const Where& where, base::Diagnostics& report) {
    if (!fitsAnyProgram(options.program_name))
        report.error("post.program-name",
                     "an 840D program name has at most 24 letters, digits and underscores; \"" + options.program_name +
                         "\" does not fit",
                     where("program_name"));
    if (!options.work_offset.empty() && !isSettableFrame(options.work_offset))
        report.error("post.work-offset",
                     "\"" + options.work_offset +
                         "\" is no settable frame of an 840D: G54 to G57, G505 to G599, or G500",
                     where("work_offset"));
    if (options.spindle_rpm && !(*options.spindle_rpm > 0.0 && std::isfinite(*options.spindle_rpm)))
        report.error("post.spindle-speed", "the spindle speed must be above 0 rev/min", where("spindle_rpm"));
}

}  // namespace

const base::Section<PostOptions>& postSection() {
    static const auto section =
        base::Section<PostOptions>("Choices for one posting; every one is also a flag of `cusp post`.")
            .field("program_name", &PostOptions::program_name,
                   "Program name: at most 24 letters, digits, underscores. Empty: from the output file's name.")
            .field("spindle_rpm", &PostOptions::spindle_rpm,
                   "Spindle speed, clockwise, for CL files that give none before the first cut.", base::positive())
            .field("work_offset", &PostOptions::work_offset, "Work offset, e.g. G54. Empty: the machine file's.")
            .field("strict", &PostOptions::strict,
                   "What the reader does not know, and a cut with the spindle off, are errors instead of warnings.")
            .check([](const PostOptions& options, const base::TomlNode& table, base::Diagnostics& report) {
                check(options, [&table](const char* key) { return table.whereKey(key); }, report);
            });
    return section;
}

void checkOptions(const PostOptions& options, base::Diagnostics& report) {
    check(options, [](const char* key) { return base::Location{{}, 0, 0, key}; }, report);
}

std::string programNameFromFile(const std::string& path) {
    const std::size_t slash = path.find_last_of('/');
    std::string stem = slash == std::string::npos ? path : path.substr(slash + 1);
    if (const std::size_t dot = stem.find_last_of('.'); dot != std::string::npos && dot > 0) stem.resize(dot);
    std::string name;
    for (const char c : stem) {
        if (name.size() == name_limit) break;
        name.push_back(isNameCharacter(c) ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : '_');
    }
    return name.empty() || name == "_" ? "PROGRAM" : name;
}

}  // namespace cusp::post
