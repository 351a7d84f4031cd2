// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp machine check`: is a machine definition sound, and how much of it is known rather than assumed?
#include "command.hpp"
#include "console.hpp"
#include "machine_lookup.hpp"

#include <cusp/base/json_report.hpp>
#include <cusp/base/units.hpp>
#include <cusp/kinematics/laws.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cusp::cli {

namespace {

struct CheckOptions {
    std::vector<std::string> machines;
    std::uint64_t seed = 1;
    std::uint64_t poses = 10000;
    bool json = false;
    bool print_config = false;
};

struct Checked {
    LoadedMachine machine;
    kinematics::LawReport laws;
    std::vector<kinematics::AnchorReport> anchors;
    std::vector<std::string> assumed;

    [[nodiscard]] bool passes() const {
        return laws.passes() && std::all_of(anchors.begin(), anchors.end(), [](const auto& a) { return a.passes(); });
    }
};

std::string rotaryText(const kinematics::Machine& model) {
    std::string out;
    for (std::size_t i = 0; i < model.rotaryCount(); ++i) {
        const auto& range = model.rotaryRange(i);
        out += fmt::format("  {:<3} rotary  ", model.rotaryNames()[i]);
        out += range.endless
                   ? "endless\n"
                   : fmt::format("{:.6g}° to {:.6g}°\n", base::degFromRad(range.min), base::degFromRad(range.max));
    }
    return out;
}

std::string lawText(const kinematics::Law& law) {
    if (law.checked == 0) return fmt::format("    {:<48} does not apply to this machine\n", law.name);
    return fmt::format("    {:<48} worst {:<9.2g} bound {:<7.0e} {:<4} {}\n", law.name, law.worst, law.bound, law.unit,
                       law.passes() ? "ok" : "BROKEN");
}

std::string anchorText(const std::vector<kinematics::AnchorReport>& anchors) {
    if (anchors.empty())
        return "  unanchored: no pose from outside cusp is on file. The laws above cannot see a wrong sign; try the first "
               "program with the spindle far from the part.\n";
    std::string out = "  poses known from outside:\n";
    for (const auto& anchor : anchors)
        out += fmt::format("    {} (off by {:.4f}°, known to {:.4f}°): {}\n", anchor.passes() ? "met" : "NOT MET",
                           base::degFromRad(anchor.error_rad), base::degFromRad(anchor.tolerance_rad), anchor.source);
    return out;
}

std::string assumedText(const std::vector<std::string>& assumed) {
    if (assumed.empty()) return "  every value has a source\n";
    std::string out = fmt::format("  {} values are assumed, no source is given for them:", assumed.size());
    std::size_t column = 121;
    for (const std::string& key : assumed) {
        if (column + key.size() > 110) {
            out += "\n   ";
            column = 3;
        }
        out += " " + key;
        column += key.size() + 1;
    }
    return out + "\n";
}

std::string toText(const Checked& checked) {
    const auto& definition = checked.machine.file.machine;
    std::string chain;
    for (const std::string& link : definition.chain) chain += (chain.empty() ? "" : " – ") + link;
    std::string out = fmt::format("{}: {}\n  chain {}\n{}", checked.machine.path, definition.name, chain,
                                  rotaryText(checked.machine.model));
    out += fmt::format("  laws of kinematics, {} poses, seed {}:\n", checked.laws.poses, checked.laws.seed);
    for (const auto& law : checked.laws.laws) out += lawText(law);
    out += anchorText(checked.anchors) + assumedText(checked.assumed);
    return out + (checked.passes() ? "  sound\n" : "  NOT SOUND: do not post for this machine\n");
}

base::Json toJson(const Checked& checked) {
    base::Json out;
    out["file"] = checked.machine.path;
    out["name"] = checked.machine.file.machine.name;
    out["sound"] = checked.passes();
    out["poses"] = checked.laws.poses;
    out["seed"] = checked.laws.seed;
    out["laws"] = base::Json::array();
    for (const auto& law : checked.laws.laws)
        out["laws"].push_back({{"name", law.name},
                               {"worst", law.worst},
                               {"bound", law.bound},
                               {"unit", law.unit},
                               {"checked", law.checked},
                               {"pass", law.checked == 0 ? base::Json() : base::Json(law.passes())}});
    out["anchors"] = base::Json::array();
    for (const auto& anchor : checked.anchors)
        out["anchors"].push_back({{"source", anchor.source},
                                  {"error_deg", base::degFromRad(anchor.error_rad)},
                                  {"tolerance_deg", base::degFromRad(anchor.tolerance_rad)},
                                  {"pass", anchor.passes()}});
    out["assumed"] = checked.assumed;
    return out;
}

ExitCode runCheck(const CheckOptions& options) {
    base::Json reports = base::Json::array();
    base::Diagnostics problems;
    bool sound = true;
    for (const std::string& name : options.machines) {
        auto machine = loadMachine(name);
        if (!machine) {
            problems.append(machine.error());
            continue;
        }
        if (options.print_config) {
            say(post::toToml(machine->file));
            continue;
        }
        Checked checked{*std::move(machine), {}, {}, {}};
        checked.laws = kinematics::runLaws(checked.machine.model, options.seed, options.poses);
        checked.anchors = kinematics::checkAnchors(checked.machine.model);
        checked.assumed = machine::unknownProvenance(checked.machine.file.machine);
        sound = sound && checked.passes();
        if (options.json)
            reports.push_back(toJson(checked));
        else
            say(toText(checked));
    }
    if (options.json && !options.print_config) {
        base::Json summary = base::jsonReport("machine check", 1);
        summary["machines"] = std::move(reports);
        summary["diagnostics"] = base::diagnosticsToJson(problems);
        sayJson(summary);
    }
    if (problems.hasErrors()) return failWith(problems);
    return sound ? ExitCode::Done : ExitCode::FoundSomething;
}

}  // namespace

void addMachineCommand(CLI::App& app, Action& action) {
    CLI::App* machine = app.add_subcommand("machine", "Machine definitions.");
    machine->require_subcommand(1);
    CLI::App* check =
        machine->add_subcommand("check", "Validates machine files and puts their kinematics to the test.");
    const auto options = std::make_shared<CheckOptions>();
    check->add_option("FILE", options->machines, "Machine files, or names of machines that ship with cusp.")
        ->required();
    check->add_option("--poses", options->poses, "Poses to try.")
        ->capture_default_str()
        ->check(CLI::Range(1, 10000000));
    check->add_option("--seed", options->seed, "Seed of the poses.")->capture_default_str();
    check->add_flag("--json", options->json, "One machine-readable summary on stdout.");
    check->add_flag("--print-config", options->print_config, "Prints the whole definition, defaults written out.");
    check->callback([options, &action] { action = [options] { return runCheck(*options); }; });
}

}  // namespace cusp::cli
