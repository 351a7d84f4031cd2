// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// XON, XOFF, and the line ends a control wants.
#include <cusp/comm/dnc/plain_streamer.hpp>

#include <cusp/comm/dnc/run_transfer.hpp>
#include <algorithm>
#include <fmt/format.h>

namespace cusp::comm {

namespace {

constexpr std::uint8_t xon = 0x11;
constexpr std::uint8_t xoff = 0x13;
/// Little at a time: what has left cannot be held any more, and a control's reserve after XOFF is some dozens of bytes.
constexpr std::size_t piece_bytes = 32;
constexpr double most_wait_s = 0.05;

std::string withLineEnds(const std::string& text, LineEnd end) {
    if (end == LineEnd::Keep) return text;
    std::string out;
    out.reserve(text.size() + (text.size() / 16));
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool carriage_return = text[i] == '\r' && i + 1 < text.size() && text[i + 1] == '\n';
        if (carriage_return) continue;
        if (text[i] == '\n' && end == LineEnd::CrLf) out += '\r';
        out += text[i];
    }
    return out;
}

}  // namespace

PlainStreamer::PlainStreamer(const std::string& program, const PlainOptions& options)
    : text_(bytesOf(withLineEnds(options.leader + program + options.trailer, options.line_end))),
      held_(options.wait_for_xon) {}

ByteView PlainStreamer::next(std::size_t most) const {
    if (held_) return {};
    return ByteView(text_).subspan(at_, std::min(most, text_.size() - at_));
}

void PlainStreamer::receive(ByteView bytes) {
    for (const std::uint8_t byte : bytes) {
        if (byte == xoff)
            held_ = true;
        else if (byte == xon)
            held_ = false;
        else
            ++other_;
    }
}

base::Result<void> runPlain(PlainStreamer& streamer, ByteStream& stream, const PlainOptions& options,
                            base::Progress& progress) {
    const auto place = [&] { return fmt::format("after byte {} of {}", streamer.sentBytes(), streamer.totalBytes()); };
    progress.begin(streamer.totalBytes(), "sending");
    double moved_s = transferClockSeconds();
    while (!streamer.allSent() || stream.queuedBytes() > 0) {
        if (progress.stopRequested()) return base::fail("dnc.cancelled", fmt::format("cancelled {}", place()));
        const auto came = stream.read(streamer.held() || stream.queuedBytes() >= piece_bytes ? 0.002 : 0.0);
        if (!came) return base::fail("io.link-lost", fmt::format("the line broke {}", place()));
        streamer.receive(*came);
        const std::size_t queued = stream.queuedBytes();
        const ByteView piece = queued < piece_bytes ? streamer.next(piece_bytes) : ByteView();
        const auto written = piece.empty() ? base::Result<std::size_t>(0) : stream.write(piece);
        if (!written) return base::fail("io.link-lost", fmt::format("the line broke {}", place()));
        streamer.sent(*written);
        progress.advance(*written);
        const double now_s = transferClockSeconds();
        if (*written > 0 || stream.queuedBytes() < queued) moved_s = now_s;
        if (now_s > moved_s + options.held_s)
            return base::fail("dnc.held",
                              fmt::format("the control has held the line for {:.0f} s {}", options.held_s, place()));
        if (*written == 0 && piece.empty() == false) stream.wait(most_wait_s);
    }
    progress.end();
    return {};
}

}  // namespace cusp::comm
