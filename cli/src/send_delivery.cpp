// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Transfers run, watched, recorded, and said.
#include "send_delivery.hpp"

#include "console.hpp"
#include "send_monitor.hpp"
#include "send_record.hpp"
#include "shown_progress.hpp"

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/hash.hpp>
#include <cusp/comm/dnc/fetcher.hpp>
#include <cusp/comm/dnc/plain_streamer.hpp>
#include <cusp/comm/dnc/run_transfer.hpp>
#include <cusp/comm/link/file_delivery.hpp>
#include <cusp/comm/link/transports.hpp>

#include <fmt/format.h>

#include <random>

namespace cusp::cli {

namespace {

base::Json rateJson(const comm::RateCheck& check) {
    base::Json out;
    out["link_bytes_per_s"] = check.link_bytes_per_s;
    out["mean_bytes_per_s"] = check.mean_bytes_per_s;
    out["peak_bytes_per_s"] = check.peak_bytes_per_s;
    out["peak_blocks_per_s"] = check.peak_blocks_per_s;
    out["peak_at_s"] = check.peak_at_s;
    out["buffer_bytes"] = check.buffer_bytes;
    out["starves_at_s"] = check.starves_at_s ? base::Json(*check.starves_at_s) : base::Json();
    out["needed_bytes_per_s"] = check.needed_bytes_per_s;
    return out;
}

base::Json summary(const SendFlags& flags, const comm::Program& program, const SendRecord& record) {
    base::Json out = base::jsonReport("send", 1);
    out["program"] = flags.program;
    out["to"] = flags.to;
    out["name"] = program.name;
    out["bytes"] = program.text.size();
    out["blocks"] = program.blocks;
    out["digest"] = base::sha256Hex(program.text);
    out["ledger"] = record.path().empty() ? base::Json() : base::Json(record.path());
    out["transfer"] = record.transfer().empty() ? base::Json() : base::Json(record.transfer());
    return out;
}

base::Json linkJson(const comm::Sender& sender, double seconds) {
    const comm::TransferOutcome& outcome = sender.outcome();
    const comm::SenderStatistics& statistics = sender.statistics();
    base::Json out;
    out["end"] = wordFor(outcome.end);
    out["code"] = outcome.code.empty() ? base::Json() : base::Json(outcome.code);
    out["message"] = outcome.message.empty() ? base::Json() : base::Json(outcome.message);
    out["confirmed_bytes"] = outcome.confirmed_bytes;
    out["resumable"] = outcome.resumable;
    out["resume_block"] = outcome.resume_block > 0 ? base::Json(outcome.resume_block) : base::Json();
    out["compared"] = outcome.compared;
    out["armed"] = outcome.armed;
    out["started"] = outcome.started;
    out["seconds"] = seconds;
    out["chunks_sent"] = statistics.chunks_sent;
    out["chunks_repeated"] = statistics.chunks_repeated;
    out["timeouts"] = statistics.timeouts;
    out["damaged_replies"] = statistics.damaged_replies;
    out["damaged_requests"] = statistics.damaged_requests;
    out["resets_seen"] = statistics.resets_seen;
    out["link_bytes_per_s"] = statistics.link_bytes_per_s ? base::Json(*statistics.link_bytes_per_s) : base::Json();
    out["rate_check"] = statistics.rate_check ? rateJson(*statistics.rate_check) : base::Json();
    return out;
}

ExitCode exitCodeOf(const comm::TransferOutcome& outcome) {
    if (outcome.end == comm::TransferEnd::Delivered) return ExitCode::Done;
    if (outcome.code == "dnc.cancelled") return ExitCode::Interrupted;
    const bool found = outcome.end == comm::TransferEnd::Refused || outcome.code == "dnc.failed" ||
                       outcome.code == "dnc.compare-differs" || outcome.code == "dnc.interrupted" ||
                       outcome.code == "dnc.ended-early";
    return found ? ExitCode::FoundSomething : ExitCode::Io;
}

void tellOutcome(const SendFlags& flags, const comm::TransferOutcome& outcome) {
    base::Diagnostics out;
    out.error(outcome.code, outcome.message, {flags.to, 0, 0, {}});
    if (outcome.resumable) out.note("send.resumable", "sending it again goes on from what the control has kept");
    tell(out);
}

std::string sentText(const comm::Sender& sender, const SendFlags& flags, double seconds) {
    const comm::TransferOutcome& outcome = sender.outcome();
    std::string out = fmt::format("{} ({} bytes, {} blocks) is at {}: digest verified{}{}{}\n", sender.header().name,
                                  sender.totalBytes(), sender.header().blocks, flags.to,
                                  outcome.compared ? ", compared byte by byte" : "", outcome.armed ? ", armed" : "",
                                  outcome.started ? ", started" : "");
    out += fmt::format("{:.1f} s, {:.2f} kB/s; {} of {} chunks repeated\n", seconds,
                       sender.totalBytes() / std::max(seconds, 1e-6) / 1000.0, sender.statistics().chunks_repeated,
                       sender.statistics().chunks_sent);
    if (sender.statistics().link_bytes_per_s)
        out += fmt::format("measured link: {:.2f} kB/s\n", *sender.statistics().link_bytes_per_s / 1000.0);
    return out;
}

/// Said once, when the control answers that it is held for somebody else.
class BusyNote {
public:
    void look(const comm::Sender& sender, const SendFlags& flags) {
        if (told_ || !sender.waitsForAnother()) return;
        told_ = true;
        base::Diagnostics out;
        out.note("dnc.busy",
                 "the control is held for another sender or a program just armed; asking again for up to 40 s",
                 {flags.to, 0, 0, {}});
        tell(out);
    }

private:
    bool told_ = false;
};

/// Said once, when the sender has judged the link and goes on all the same.
class SlowLinkWarning {
public:
    void look(const comm::Sender& sender) {
        const auto& check = sender.statistics().rate_check;
        if (told_ || !check || sender.over()) return;
        told_ = true;
        if (!check->starves_at_s) return;
        base::Diagnostics out;
        out.warning("dnc.link-too-slow", comm::toText(*check));
        tell(out);
    }

private:
    bool told_ = false;
};

}  // namespace

std::string_view wordFor(comm::TransferEnd end) {
    switch (end) {
        case comm::TransferEnd::Delivered: return "delivered";
        case comm::TransferEnd::Refused: return "refused";
        case comm::TransferEnd::Aborted: return "aborted";
    }
    return "aborted";
}

std::uint32_t randomClient() {
    std::random_device device;
    return 1 + (device() >> 1U);
}

ExitCode sendOverLink(const SendFlags& flags, const comm::LinkUrl& url, const comm::Program& program,
                      const comm::SenderOptions& options) {
    auto record = SendRecord::begin(flags, program);
    if (!record) return failWith(record.error());
    auto link = comm::openLink(url);
    if (!link) {
        record->end("no link", base::toText(link.error().front()));
        return failWith(link.error());
    }
    comm::Sender sender(program, options, (*link)->traits());
    std::unique_ptr<SendMonitor> monitor;
    if (!flags.monitor.empty()) {
        auto opened = SendMonitor::open(flags, program, *record);
        if (!opened) {
            record->end("not sent", base::toText(opened.error().front()));
            return failWith(opened.error());
        }
        monitor = *std::move(opened);
        if (!flags.json) sayNow("monitor page at " + monitor->url() + "\n");
    }
    const double begin_s = comm::transferClockSeconds();
    {
        ShownProgress progress;
        SlowLinkWarning warning;
        BusyNote busy;
        comm::runTransfer(sender, **link, progress, [&](const comm::Sender& at) {
            if (!options.refuse_slow_link) warning.look(at);
            busy.look(at, flags);
            if (monitor) monitor->look(at);
        });
    }
    const double seconds = comm::transferClockSeconds() - begin_s;
    const comm::TransferOutcome& outcome = sender.outcome();
    record->end(std::string(wordFor(outcome.end)), outcome.code.empty()
                                                       ? fmt::format("{} bytes confirmed", outcome.confirmed_bytes)
                                                       : fmt::format("{}: {}", outcome.code, outcome.message));
    if (outcome.end != comm::TransferEnd::Delivered) tellOutcome(flags, outcome);
    if (monitor) monitor->end(sender, *record);
    if (flags.json) {
        base::Json out = summary(flags, program, *record);
        out.update(linkJson(sender, seconds));
        sayJson(out);
    } else if (outcome.end == comm::TransferEnd::Delivered) {
        say(sentText(sender, flags, seconds));
    }
    return exitCodeOf(outcome);
}

ExitCode sendPlain(const SendFlags& flags, const comm::LinkUrl& url, const comm::Program& program) {
    auto record = SendRecord::begin(flags, program);
    if (!record) return failWith(record.error());
    auto stream = comm::ByteStream::open(url);
    if (!stream) {
        record->end("no link", base::toText(stream.error().front()));
        return failWith(stream.error());
    }
    comm::PlainOptions options;
    options.wait_for_xon = flags.wait_for_xon;
    if (flags.line_end == "lf") options.line_end = comm::LineEnd::Lf;
    if (flags.line_end == "crlf") options.line_end = comm::LineEnd::CrLf;
    comm::PlainStreamer streamer(program.text, options);
    const double begin_s = comm::transferClockSeconds();
    ShownProgress progress;
    const auto ran = comm::runPlain(streamer, *stream, options, progress);
    const double seconds = comm::transferClockSeconds() - begin_s;
    record->end(ran ? "sent, unconfirmed" : "aborted", ran ? "" : base::toText(ran.error().front()));
    if (!ran) tell(ran.error());
    if (flags.json) {
        base::Json out = summary(flags, program, *record);
        out["end"] = ran ? "sent, unconfirmed" : "aborted";
        out["code"] = ran ? base::Json() : base::Json(ran.error().front().code);
        out["sent_bytes"] = streamer.sentBytes();
        out["seconds"] = seconds;
        sayJson(out);
    } else if (ran) {
        say(fmt::format("{} bytes have left for {} in {:.1f} s; nothing confirms what arrived\n", streamer.sentBytes(),
                        flags.to, seconds));
    }
    if (ran) return ExitCode::Done;
    return ran.error().front().code == "dnc.cancelled" ? ExitCode::Interrupted : ExitCode::Io;
}

ExitCode deliverToFolder(const SendFlags& flags, const comm::LinkUrl& url, const comm::Program& program) {
    auto record = SendRecord::begin(flags, program);
    if (!record) return failWith(record.error());
    auto delivered = comm::deliverFile(url.path, program.name, program.text);
    std::string caller;
    if (delivered && flags.extcall) {
        caller = "CALL_" + program.name;
        // SD42700 names the folder the control looks in; EXTCALL then takes the bare name.
        const std::string text = fmt::format("; runs {} from the external program memory, through the reload buffer\n"
                                             "; SHA-256 {}\nEXTCALL(\"{}\")\nM30\n",
                                             program.name, delivered->digest, program.name);
        if (auto written = base::writeWholeFile(url.path + "/" + caller, text); !written)
            delivered = base::fail(std::move(written).error());
    }
    record->end(delivered ? "delivered" : "aborted", delivered ? "" : base::toText(delivered.error().front()));
    if (!delivered) return failWith(delivered.error());
    if (flags.json) {
        base::Json out = summary(flags, program, *record);
        out["end"] = "delivered";
        out["path"] = delivered->path;
        out["caller"] = caller.empty() ? base::Json() : base::Json(caller);
        sayJson(out);
    } else {
        say(fmt::format("{} ({} bytes), SHA-256 {}\n", delivered->path, program.text.size(), delivered->digest));
        if (!caller.empty()) say(fmt::format("{}/{} calls it\n", url.path, caller));
    }
    return ExitCode::Done;
}

ExitCode fetchProgram(const SendFlags& flags, const comm::LinkUrl& url) {
    auto link = comm::openLink(url);
    if (!link) return failWith(link.error());
    comm::FetcherOptions options;
    options.client = randomClient();
    comm::Fetcher fetcher(flags.fetch, options, (*link)->traits());
    {
        ShownProgress progress;
        comm::runFetch(fetcher, **link, progress);
    }
    if (!fetcher.code().empty()) {
        base::Diagnostics out;
        out.error(fetcher.code(), fetcher.message(), {flags.to, 0, 0, {}});
        tell(out);
        if (interrupted()) return ExitCode::Interrupted;
        return fetcher.code() == "dnc.not-found" ? ExitCode::FoundSomething : ExitCode::Io;
    }
    const std::string text = fetcher.text();
    auto target = base::OutputTarget::open(flags.output);
    if (!target) return failWith(target.error());
    if (auto written = target->write(text); !written) return failWith(written.error());
    if (auto committed = target->commit(); !committed) return failWith(committed.error());
    if (flags.json) {
        base::Json out = base::jsonReport("send", 1);
        out["fetched"] = flags.fetch;
        out["from"] = flags.to;
        out["output"] = flags.output;
        out["bytes"] = text.size();
        out["digest"] = base::sha256Hex(text);
        sayJson(out);
    } else if (flags.output != "-") {
        say(fmt::format("{} ({} bytes), SHA-256 {}\n", flags.output, text.size(), base::sha256Hex(text)));
    }
    return ExitCode::Done;
}

}  // namespace cusp::cli
