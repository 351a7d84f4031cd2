// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What a user may choose for one posting; the `[post]` table of a job file.
#pragma once

#include <cusp/base/toml_schema.hpp>

#include <optional>
#include <string>

namespace cusp::post {

struct PostOptions {
    /// Program name, at most 24 letters, digits and underscores (840D); empty: from the output file's name.
    std::string program_name;
    /// Spindle speed for CL files that give none before the first cut.
    std::optional<double> spindle_rpm;
    /// Overrides the machine file's work offset ("G54", "G505").
    std::string work_offset;
    /// A cut with the spindle off is an error instead of a warning.
    bool strict = false;
};

[[nodiscard]] const base::Section<PostOptions>& postSection();

/// The rules of the table for options that came another way (flags). Errors: `post.program-name`, `post.work-offset`,
/// `post.spindle-speed`, each with the key.
void checkOptions(const PostOptions& options, base::Diagnostics& report);

/// A name an 840D takes, made from a file name: "nx part-7.cls" → "NX_PART_7".
[[nodiscard]] std::string programNameFromFile(const std::string& path);

}  // namespace cusp::post
