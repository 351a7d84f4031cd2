// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Brings a program back from the control, sans-I/O.
#pragma once

#include <cusp/base/progress.hpp>
#include <cusp/comm/dnc/conversation.hpp>
#include <cusp/comm/dnc/piece_reader.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace cusp::comm {

struct FetcherOptions {
    std::uint32_t client = 1;  ///< random, not 0
    std::uint32_t max_bytes = 256U << 20U;
    double first_timeout_s = 1.0;
    double silence_s = 15.0;
};

class Fetcher {
public:
    /// `name` as the control stores it.
    Fetcher(std::string name, FetcherOptions options, const LinkTraits& link);

    [[nodiscard]] std::optional<Request> poll(double now_s);
    void receive(ByteView reply, double now_s);
    void tick(double now_s);
    [[nodiscard]] double nextWakeSeconds(double now_s) const;
    void linkLost(const std::string& reason) { end("io.link-lost", "the link broke: " + reason); }

    [[nodiscard]] bool over() const { return over_; }
    /// Empty when the program has come whole.
    [[nodiscard]] const std::string& code() const { return code_; }
    [[nodiscard]] const std::string& message() const { return message_; }
    [[nodiscard]] std::string text() const { return textOf(reader_.bytes()); }
    [[nodiscard]] std::uint32_t receivedBytes() const { return reader_.received(); }

private:
    void end(std::string code, std::string message);

    std::string name_;
    FetcherOptions options_;
    Conversation conversation_;
    PieceReader reader_;
    bool over_ = false;
    std::string code_;
    std::string message_;
    std::optional<double> last_gain_s_;
};

/// Over a link in real time.
void runFetch(Fetcher& fetcher, Link& link, base::Progress& progress);

}  // namespace cusp::comm
