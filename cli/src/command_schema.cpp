// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp schema`: the documentation page of a file cusp reads, straight from the table that reads it.
#include "command.hpp"
#include "console.hpp"
#include "job_file.hpp"

#include <cusp/base/schema_field.hpp>
#include <cusp/geometry/surface_file.hpp>
#include <cusp/machine/setup_definition.hpp>
#include <cusp/optimizer/finishing/optimize_job.hpp>
#include <cusp/optimizer/finishing/plan_job.hpp>
#include <cusp/optimizer/tilt/tilt_job.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <memory>
#include <string>
#include <vector>

namespace cusp::cli {

namespace {

/// A file cusp reads. A new one is one more entry of `pages`; `make docs` and the tests walk the same table.
struct Page {
    const char* name;
    const char* title;
    const char* introduction;
    std::vector<base::FieldInfo> (*fields)();
};

std::vector<base::FieldInfo> machineFileFields() {
    std::vector<base::FieldInfo> fields = machine::machineSection().describe();
    fields.push_back(
        base::nestedInfo("control", post::controlSection().doc(), "table", {}, post::controlSection().describe()));
    return fields;
}

constexpr Page pages[] = {
    {"machine-file", "Machine files",
     "A machine is one TOML file: how its axes stand on one another, what they can do, and what its control wants to read. "
     "The unit of a number is the end of its key; a key that is not listed here is an error. `cusp machine check FILE` says "
     "whether a file is sound.",
     machineFileFields},
    {"setup-file", "Setup files",
     "A setup says where the workpiece lies in the machine and how long the tools are; with it `cusp post --setup` checks "
     "the travel of the linear axes. The unit of a number is the end of its key; a key that is not listed here is an error.",
     [] { return machine::setupSection().describe(); }},
    {"surface-file", "Surface files",
     "A surface file is a nominal surface written down in TOML: polynomials as a paper prints them, Bézier nets, B-splines "
     "and NURBS. `examples/benchmark/surface.toml` is one. Lengths are in mm; a key that is not listed here is an error.",
     [] { return geometry::surfaceFileSection().describe(); }},
    {"post-job", "Posting jobs",
     "`cusp post --config JOB.toml` reads these; a flag of the same name wins over the file.",
     [] { return postJobSection().describe(); }},
    {"plan-job", "Planning jobs",
     "`cusp plan JOB.toml -o P.apt` reads these. The unit of a number is the end of its key; a key that is not listed here is "
     "an error. Examples: `examples/benchmark/table2_ga.toml` and `table2_vega.toml`.",
     [] { return finishing::planJobSection().describe(); }},
    {"optimize-job", "Optimisation jobs",
     "`cusp optimize JOB.toml -o DIR` reads these. The unit of a number is the end of its key; a key that is not listed here is "
     "an error. Examples: `examples/benchmark/paper.toml` and `true.toml`.",
     [] { return finishing::optimizeJobSection().describe(); }},
    {"tilt-job", "Tilting jobs",
     "`cusp tilt JOB.toml -o DIR` reads these. The unit of a number is the end of its key; a key that is not listed here is an "
     "error. Examples: `examples/tilt/cavity.toml`, `dome.toml` and `mould.toml`.",
     [] { return tilt::tiltJobSection().describe(); }},
};

std::vector<std::string> pageNames() {
    std::vector<std::string> names;
    for (const Page& page : pages) names.emplace_back(page.name);
    return names;
}

void printPage(const std::string& name) {
    for (const Page& page : pages) {
        if (name == page.name) say(base::schemaMarkdown(page.title, page.introduction, page.fields()));
    }
}

}  // namespace

void addSchemaCommand(CLI::App& app, Action& action) {
    CLI::App* schema = app.add_subcommand("schema", "Prints the documentation page (Markdown) of a file cusp reads.");
    const auto page = std::make_shared<std::string>();
    schema->add_option("PAGE", *page, "without it, the names of all pages")->check(CLI::IsMember(pageNames()));
    schema->callback([page, &action] {
        action = [page] {
            if (page->empty()) {
                for (const std::string& name : pageNames()) say(name + "\n");
            } else {
                printPage(*page);
            }
            return ExitCode::Done;
        };
    });
}

}  // namespace cusp::cli
