// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// `cusp demo`: the whole loop on the benchmark surface, one page at its end.
#include "command.hpp"
#include "console.hpp"
#include "demo_chain.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/pages/render.hpp>

#include <fmt/format.h>

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <unistd.h>

namespace cusp::cli {

namespace {

using Clock = std::chrono::steady_clock;

struct Flags {
    DemoOptions options;
    bool no_calibration = false;
    bool json = false;
};

double secondsSince(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::string line(const char* what, const loop::MeasuredPart& part, double limit_mm) {
    return fmt::format("  {:34} {:7.1f} µm in the fixed datums {:8.1f} µm best-fitted   {}\n", what,
                       part.maxAbsInDatum() * 1e3, part.maxAbsBestFit() * 1e3,
                       part.maxAbsInDatum() <= limit_mm ? "within" : "out");
}

std::string toText(const Flags& flags, const Demo& demo, double seconds) {
    const double limit_mm = flags.options.limit_mm;
    std::string out =
        fmt::format("{} passes within ±{} mm, {} blocks, {} bytes over {}\n", demo.plan.passes, flags.options.budget_mm,
                    demo.program.blocks, demo.run.delivery.bytes, demo.run.delivery.link);
    out += line("first part", demo.first.part, limit_mm);
    out += line("second part, nothing done", demo.uncorrected, limit_mm);
    out += line("second part, path corrected", demo.second.part, limit_mm);
    if (demo.calibrated) out += line("second part, machine corrected", *demo.calibrated, limit_mm);
    return out + fmt::format("{:.1f} s; the page: {}\n", seconds,
                             (std::filesystem::path(flags.options.folder) / "index.html").string());
}

base::Result<void> writeSummary(const Flags& flags, const Demo& demo, double seconds) {
    const std::filesystem::path folder(flags.options.folder);
    return base::jsonText(demoJson(demo, seconds, false))
        .and_then([&](const std::string& text) { return base::writeWholeFile((folder / "demo.json").string(), text); })
        .and_then([&] { return base::jsonText(demoJson(demo, seconds, true)); })
        .and_then([](const std::string& text) { return pages::renderPage("loop", text); })
        .and_then(
            [&](const std::string& html) { return base::writeWholeFile((folder / "index.html").string(), html); });
}

ExitCode runDemoCommand(const Flags& flags) {
    const Clock::time_point begin = Clock::now();
    const bool terminal = ::isatty(STDERR_FILENO) != 0;
    const auto demo = runDemo(flags.options, [&](const std::string& what) {
        if (terminal && !flags.json) say(fmt::format("{:6.1f} s  {}\n", secondsSince(begin), what));
        return !interrupted();
    });
    if (!demo) return demo.error().front().code == "demo.interrupted" ? ExitCode::Interrupted : failWith(demo.error());
    const double seconds = secondsSince(begin);
    if (const auto done = writeSummary(flags, **demo, seconds); !done) return failWith(done.error());
    if (flags.json)
        sayJson(demoJson(**demo, seconds, false));
    else
        say(toText(flags, **demo, seconds));
    return (*demo)->second.part.maxAbsInDatum() <= flags.options.limit_mm ? ExitCode::Done : ExitCode::FoundSomething;
}

}  // namespace

void addDemoCommand(CLI::App& app, Action& action) {
    CLI::App* demo = app.add_subcommand(
        "demo", "The whole loop: plan, post, send, cut on a machine with hidden errors, measure, correct, cut again.");
    const auto flags = std::make_shared<Flags>();
    DemoOptions& options = flags->options;
    demo->add_option("-o,--output", options.folder, "Folder for every file on the way, and index.html.")->required();
    demo->add_option("-m,--machine", options.machine, "Machine file, or the name of one that ships with cusp.")
        ->capture_default_str();
    demo->add_option("--nominal", options.nominal, "Surface of untrimmed faces; absent: the benchmark surface.");
    demo->add_option("--sections", options.sections, "Sections that are measured.")->capture_default_str();
    demo->add_option("--link", options.link,
                     "How the program reaches the control: modbus-tcp://, tcp:// …; port 0 takes a free one.")
        ->capture_default_str();
    demo->add_option("--budget-mm", options.budget_mm, "What the path may be off the surface.")
        ->capture_default_str()
        ->check(CLI::Range(0.001, 0.1));
    demo->add_option("--seed", options.seed, "Of the machine's errors and the measuring machine's.")
        ->capture_default_str();
    demo->add_flag("--no-calibration", flags->no_calibration, "Leaves out the artefact.");
    demo->add_flag("--json", flags->json, "One machine-readable summary on stdout.");
    demo->callback([flags, &action] {
        flags->options.calibrate = !flags->no_calibration;
        action = [flags] { return runDemoCommand(*flags); };
    });
}

}  // namespace cusp::cli
