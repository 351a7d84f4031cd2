// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp schema`: the documentation page of a file cusp reads, straight from the table that reads it.
#include "command.hpp"
#include "console.hpp"
#include "job_file.hpp"

#include <cusp/base/schema_field.hpp>
#include <cusp/machine/setup_definition.hpp>
#include <cusp/optimizer/finishing/plan_job.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <memory>
#include <string>
#include <vector>

namespace cusp::cli {

namespace {

std::string machineFilePage() {
    std::vector<base::FieldInfo> fields = machine::machineSection().describe();
    fields.push_back(
        base::nestedInfo("control", post::controlSection().doc(), "table", {}, post::controlSection().describe()));
    return base::schemaMarkdown(
        "Machine files",
        "A machine is one TOML file: how its axes stand on one another, what they can do, and "
        "what its control wants to read. The unit of a number is the end of its key; a key that "
        "is not listed here is an error. `cusp machine check FILE` says whether a file is sound.",
        fields);
}

std::string postJobPage() {
    return base::schemaMarkdown(
        "Posting jobs", "`cusp post --config JOB.toml` reads these; a flag of the same name wins over the file.",
        postJobSection().describe());
}

std::string setupFilePage() {
    return base::schemaMarkdown(
        "Setup files",
        "A setup says where the workpiece lies in the machine and how long the tools are; with it `cusp post --setup` "
        "checks the travel of the linear axes. The unit of a number is the end of its key; a key that is not listed here "
        "is an error.",
        machine::setupSection().describe());
}

std::string planJobPage() {
    return base::schemaMarkdown(
        "Planning jobs",
        "`cusp plan JOB.toml -o P.apt` reads these. The unit of a number is the end of its key; a key that is not listed here is "
        "an error. Examples: `examples/benchmark/table2_ga.toml` and `table2_vega.toml`.",
        finishing::planJobSection().describe());
}

std::string pageOf(const std::string& name) {
    if (name == "machine-file") return machineFilePage();
    if (name == "plan-job") return planJobPage();
    return name == "setup-file" ? setupFilePage() : postJobPage();
}

}  // namespace

void addSchemaCommand(CLI::App& app, Action& action) {
    CLI::App* schema = app.add_subcommand("schema", "Prints the documentation page (Markdown) of a file cusp reads.");
    const auto page = std::make_shared<std::string>();
    schema->add_option("PAGE", *page, "machine-file, setup-file, post-job or plan-job")
        ->required()
        ->check(CLI::IsMember({"machine-file", "setup-file", "post-job", "plan-job"}));
    schema->callback([page, &action] {
        action = [page] {
            say(pageOf(*page));
            return ExitCode::Done;
        };
    });
}

}  // namespace cusp::cli
