// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Joins post, links, control, cut, probe and inspection; each does what its own command does.
#include <cusp/loop/virtual_shop.hpp>

#include <cusp/comm/controller/control_host.hpp>
#include <cusp/comm/dnc/run_transfer.hpp>
#include <cusp/comm/link/transports.hpp>
#include <cusp/post/writer/program_planner.hpp>
#include <cusp/post/writer/sinumerik_writer.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <thread>
#include <utility>

namespace cusp::loop {
namespace {

/// Between two looks of the serving thread at its link.
constexpr double look_s = 0.004;
/// Of virtual time: no finishing path runs longer.
constexpr double longest_run_s = 24.0 * 3600.0;
/// The one sender and the one boot of the control there are.
constexpr std::uint32_t client = 4711;
constexpr std::uint64_t boot_seed = 0x5eed'0001;

/// The control's end of a link, served by a thread of its own until the transfer is over.
class ControlStation {
public:
    explicit ControlStation(comm::VirtualControl& control)
        : host_(control, {}), receiver_({}, host_, boot_seed), service_(receiver_) {}

    base::Result<std::string> listen(const std::string& link) {
        const auto url = comm::parseLinkUrl(link);
        if (!url) return base::fail(url.error());
        auto server = comm::openServer(*url, service_);
        if (!server) return base::fail(server.error());
        server_ = *std::move(server);
        return server_->name();
    }

    /// The operator stands at the control and permits one start.
    void serve() {
        constexpr double enabled_s = 60.0;
        receiver_.enableStart(comm::transferClockSeconds(), enabled_s);
        thread_ = std::thread([this] {
            while (!done_.load(std::memory_order_acquire)) {
                if (const auto step = server_->step(look_s); !step) return;
                receiver_.tick(comm::transferClockSeconds());
            }
        });
    }
    void stop() {
        done_.store(true, std::memory_order_release);
        if (thread_.joinable()) thread_.join();
    }
    ~ControlStation() { stop(); }
    ControlStation(const ControlStation&) = delete;
    ControlStation& operator=(const ControlStation&) = delete;

private:
    comm::ControlHost host_;
    comm::Receiver receiver_;
    comm::ReceiverService service_;
    std::unique_ptr<comm::LinkServer> server_;
    std::atomic<bool> done_{false};
    std::thread thread_;
};

base::Result<DeliveryRecord> deliver(const PostedProgram& program, comm::VirtualControl& control,
                                     const std::string& link_text) {
    ControlStation station(control);
    const auto address = station.listen(link_text);
    if (!address) return base::fail(address.error());
    const auto url = comm::parseLinkUrl(*address);
    if (!url) return base::fail(url.error());
    station.serve();
    auto link = comm::openLink(*url);
    if (!link) return base::fail(link.error());
    comm::SenderOptions options;
    options.client = client;
    options.compare = true;
    options.arm = true;
    options.start = true;
    comm::Program sent{
        .name = program.name, .text = program.text, .blocks = static_cast<std::uint32_t>(program.blocks)};
    comm::Sender sender(std::move(sent), options, (*link)->traits());
    const double begin_s = comm::transferClockSeconds();
    comm::runTransfer(sender, **link, base::noProgress());
    const double seconds = comm::transferClockSeconds() - begin_s;
    station.stop();
    const comm::TransferOutcome& outcome = sender.outcome();
    if (outcome.end != comm::TransferEnd::Delivered || !outcome.started)
        return base::fail("shop.transfer", fmt::format("the program did not reach the control over {}: {} ({})",
                                                       *address, outcome.message, outcome.code));
    return DeliveryRecord{.link = *address,
                          .bytes = program.text.size(),
                          .chunks = sender.statistics().chunks_sent,
                          .chunks_repeated = sender.statistics().chunks_repeated,
                          .seconds = seconds,
                          .compared = outcome.compared};
}

base::Result<void> checkFinished(const PostedProgram& program, const comm::ControlStatus& status) {
    if (status.finished) return {};
    base::Diagnostics report;
    for (const comm::Alarm& alarm : status.alarms)
        report.error("shop.alarm", fmt::format("alarm {}: {}", alarm.number, alarm.text),
                     {program.name, alarm.line, 0, {}});
    if (!report.hasErrors())
        report.error("shop.alarm",
                     fmt::format("the control stands after line {}: {}", status.completed_line, status.waiting_for),
                     {program.name, status.completed_line, 0, {}});
    return base::fail(std::move(report));
}

double maxAbs(const inspect::Evaluation& evaluation) {
    return std::max(std::abs(evaluation.statistics.min_mm), std::abs(evaluation.statistics.max_mm));
}

}  // namespace

base::Result<PostedProgram> postPath(const toolpath::ToolPath& path, const post::MachineFile& file,
                                     const kinematics::Machine& machine, const std::string& name,
                                     base::Diagnostics& warnings) {
    post::PostOptions options;
    options.program_name = post::programNameFromFile(name);
    base::Diagnostics report;
    post::MachineFile used = file;
    used.control.format = post::sufficientFormat(file, options.form.value_or(file.control.form), report);
    PostedProgram out{.name = options.program_name, .text = {}, .blocks = 0};
    post::SinumerikWriter writer([&out](std::string_view text) { out.text += text; }, used,
                                 {.program_name = options.program_name, .work_offset = {}, .comments = {}});
    post::ProgramPlanner planner(used, machine, options, path.file_name, writer, report);
    for (const toolpath::ClRecord& record : path.records) planner.take(record);
    static_cast<void>(planner.finish());
    out.blocks = writer.finish();
    if (report.hasErrors()) return base::fail(std::move(report));
    warnings.append(report);
    return out;
}

base::Result<ExecutedProgram> runProgram(const PostedProgram& program, const post::MachineFile& file,
                                         const kinematics::Machine& machine, const CuttingSetup& setup,
                                         const std::string& link) {
    comm::ControlOptions options;
    options.tool_length_mm = setup.tool_length_mm;
    options.wcs_origin_mm = setup.wcs_origin_mm;
    comm::VirtualControl control(file, machine, options);
    ExecutedProgram out;
    control.record([&out](const comm::ControlSample& sample) { out.track.add(sample.time_s, sample.axes); });
    if (link.empty()) {
        if (!control.select(program.name, program.text) || !control.start())
            return base::fail("shop.transfer", "the control does not take the program");
        out.delivery.bytes = program.text.size();
    } else {
        auto delivery = deliver(program, control, link);
        if (!delivery) return base::fail(delivery.error());
        out.delivery = *std::move(delivery);
    }
    control.runToRest(longest_run_s);
    const comm::ControlStatus& status = control.status();
    if (const auto ok = checkFinished(program, status); !ok) return base::fail(ok.error());
    out.run_s = status.time_s;
    out.off_path_mm = status.planning.largest_tip_mm;
    return out;
}

double MeasuredPart::maxAbsInDatum() const { return maxAbs(report.datum); }
double MeasuredPart::maxAbsBestFit() const { return maxAbs(report.best_fit); }

base::Result<MeasuredPart> cutAndMeasure(const AxisTrack& track, const CutJob& job, const RealMachine& real,
                                         const InspectionTask& task) {
    const simulation::CutterPath cut = realPath(track, real, job.cutter(), job.part_from_wcs);
    auto run = measurePart(cut, task.plan, *task.nominal, task.cmm);
    if (!run) return base::fail(run.error());
    base::Diagnostics remarks;
    auto report = inspect::inspectPoints(run->points, *task.nominal, task.inspection, remarks);
    if (!report) return base::fail(report.error());
    report->nominal_file = task.nominal_file;
    double most = 0.0;
    for (const double value : run->true_deviation_mm) most = std::max(most, std::abs(value));
    return MeasuredPart{.measurement = *std::move(run), .report = *std::move(report), .true_max_abs_mm = most};
}

}  // namespace cusp::loop
