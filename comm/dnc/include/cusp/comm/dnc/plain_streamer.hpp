// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Drip feed to controls that speak no protocol: text down a line, held by XOFF and let go by XON. Sans-I/O.
#pragma once

#include <cusp/base/progress.hpp>
#include <cusp/comm/link/byte_stream.hpp>
#include <cusp/comm/link/bytes.hpp>

#include <string>

namespace cusp::comm {

enum class LineEnd { Keep, Lf, CrLf };

struct PlainOptions {
    LineEnd line_end = LineEnd::Keep;
    /// The control asks for the program by XON; nothing is sent before.
    bool wait_for_xon = false;
    std::string leader = {};   ///< before the program: "%\n" with many controls
    std::string trailer = {};  ///< behind it
    /// Longest time without the line taking a byte before the transfer is given up; a drip feed may be held for long.
    double held_s = 600.0;
};

/// What the line is to carry next, given what the control has said. No checksums, no acknowledgement: what the line does
/// to a byte stays done, and nobody is told.
class PlainStreamer {
public:
    PlainStreamer(const std::string& program, const PlainOptions& options);
    /// The next bytes, at most `most`; none while the control holds the line.
    [[nodiscard]] ByteView next(std::size_t most) const;
    void sent(std::size_t bytes) { at_ += bytes; }
    /// XON and XOFF act; anything else is the control's own business and is counted only.
    void receive(ByteView bytes);

    [[nodiscard]] bool held() const { return held_; }
    [[nodiscard]] bool allSent() const { return at_ == text_.size(); }
    [[nodiscard]] std::size_t sentBytes() const { return at_; }
    [[nodiscard]] std::size_t totalBytes() const { return text_.size(); }
    [[nodiscard]] std::size_t otherBytes() const { return other_; }

private:
    Bytes text_;
    std::size_t at_ = 0;
    std::size_t other_ = 0;
    bool held_;
};

/// Runs it over a line in real time, to the last byte's leaving. Errors: `dnc.held`, `dnc.cancelled`, `io.link-lost`, all
/// with how far it came.
[[nodiscard]] base::Result<void> runPlain(PlainStreamer& streamer, ByteStream& stream, const PlainOptions& options,
                                          base::Progress& progress);

}  // namespace cusp::comm
