// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Reading a program piece by piece.
#include <cusp/comm/dnc/fetcher.hpp>

#include <cusp/comm/dnc/run_transfer.hpp>
#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace cusp::comm {

namespace {

constexpr std::size_t most_piece_bytes = 2048;
constexpr double least_timeout_s = 0.02;
constexpr double most_timeout_s = 1.5;
constexpr double least_wait_s = 1e-4;
constexpr double most_wait_s = 0.1;

std::size_t pieceBytes(const LinkTraits& link) {
    const std::size_t room =
        link.max_reply_bytes > upload_header_bytes ? link.max_reply_bytes - upload_header_bytes : 1;
    return std::min(room, most_piece_bytes);
}

}  // namespace

Fetcher::Fetcher(std::string name, FetcherOptions options, const LinkTraits& link)
    : name_(std::move(name)),
      options_(options),
      conversation_(
          RoundTrip(options.first_timeout_s, least_timeout_s, std::max(most_timeout_s, options.first_timeout_s)),
          static_cast<std::uint16_t>(options.client)),
      reader_(name_, pieceBytes(link), link.useful_in_flight, options.max_bytes) {}

std::optional<Request> Fetcher::poll(double now_s) {
    tick(now_s);
    if (over_) return std::nullopt;
    return reader_.poll(conversation_, now_s);
}

void Fetcher::tick(double now_s) {
    if (!last_gain_s_) last_gain_s_ = now_s;
    if (!over_ && now_s > *last_gain_s_ + options_.silence_s)
        end("dnc.no-answer",
            fmt::format("nothing came for {:.0f} s after byte {}", now_s - *last_gain_s_, reader_.received()));
}

void Fetcher::receive(ByteView reply, double now_s) {
    const auto read = conversation_.accept(reply, now_s);
    if (over_ || !read) return;
    if (read->reason == Reason::NotFound)
        return end("dnc.not-found", fmt::format("{}: {}", name_, toText(Reason::NotFound)));
    const auto piece = decodeUploadPiece(reply);
    if (read->reason != Reason::None || !piece || conversation_.argumentOf(read->tag) != piece->offset) return;
    const std::uint32_t before = reader_.received();
    if (!reader_.accept(*piece)) return end("dnc.changed", "the program changed while it was read, or is too long");
    if (reader_.received() > before) last_gain_s_ = now_s;
    conversation_.roundTrip().relax();
    if (reader_.done()) over_ = true;
}

void Fetcher::end(std::string code, std::string message) {
    code_ = std::move(code);
    message_ = std::move(message);
    over_ = true;
}

double Fetcher::nextWakeSeconds(double now_s) const {
    return std::max(now_s, reader_.nextAtSeconds(conversation_)) + least_wait_s;
}

void runFetch(Fetcher& fetcher, Link& link, base::Progress& progress) {
    const auto words = [](const base::Diagnostics& why) { return why.empty() ? "" : why.front().message; };
    progress.begin(0, "fetching");
    std::uint32_t told = 0;
    while (!fetcher.over()) {
        if (progress.stopRequested()) fetcher.linkLost("cancelled");
        while (link.ready()) {
            const auto request = fetcher.poll(transferClockSeconds());
            if (!request) break;
            if (auto sent = link.send(*request); !sent) fetcher.linkLost(words(sent.error()));
        }
        if (fetcher.over()) break;
        const double now_s = transferClockSeconds();
        const double wait_s =
            link.ready() ? std::clamp(fetcher.nextWakeSeconds(now_s) - now_s, 0.0, most_wait_s) : most_wait_s;
        auto reply = link.receive(wait_s);
        if (!reply) fetcher.linkLost(words(reply.error()));
        if (reply && *reply) fetcher.receive(**reply, transferClockSeconds());
        fetcher.tick(transferClockSeconds());
        progress.advance(fetcher.receivedBytes() - told);
        told = fetcher.receivedBytes();
    }
    progress.end();
}

}  // namespace cusp::comm
