// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The sending end of the DNC protocol, sans-I/O: it is asked for the next request, given replies, and told the time.
#pragma once

#include <cusp/comm/dnc/chunk_window.hpp>
#include <cusp/comm/dnc/conversation.hpp>
#include <cusp/comm/dnc/demand.hpp>
#include <cusp/comm/dnc/piece_reader.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace cusp::comm {

/// A program as the protocol needs it.
struct Program {
    std::string name;
    std::string text;
    std::uint32_t blocks = 0;
    std::uint32_t start_block = 0;
    bool jumps_backward = false;
};

struct SenderOptions {
    TransferMode mode = TransferMode::Store;
    /// How this sender calls itself; the control's lease is bound to it. Random, not 0.
    std::uint32_t client = 1;
    std::size_t window_bytes = 64 * 1024;
    std::size_t window_chunks = 64;
    std::uint32_t least_chunk_bytes = 32;
    /// 0: from the link's rate, so that a chunk takes about 0.15 s.
    std::uint32_t first_chunk_bytes = 0;
    double first_timeout_s = 1.0;
    double least_timeout_s = 0.02;
    double most_timeout_s = 1.5;
    /// No reply at all for so long: the peer is gone.
    double silence_s = 15.0;
    /// Replies, but nothing gained for so long: broken link or full memory. Waiting for a drip feed's FIFO is no standstill.
    double standstill_s = 60.0;
    double poll_s = 0.05;
    /// While the control is busy with another sender (it may be this one, before it was interrupted), it is asked again for
    /// so long: a little more than the usual lease.
    double busy_s = 40.0;
    /// After a reset of the control the transfer is opened again by itself so often, as long as nothing was armed.
    unsigned reopen_limit = 3;
    /// Read the program back after COMMIT and compare (store mode).
    bool compare = false;
    /// Make the program ready for the local start.
    bool arm = false;
    /// After arming, ask for the start. The operator must have enabled that at the control.
    bool start = false;
    /// Not empty: COMMIT carries `commitTag` of it.
    std::string commit_key = {};
    /// Messages of full length sent before the start to measure the link; 0: not measured.
    unsigned probes = 0;
    /// With a measured link, in drip mode: does the link bring what the program needs?
    std::optional<DemandProfile> demand = std::nullopt;
    bool refuse_slow_link = true;
};

enum class TransferEnd : std::uint8_t { Delivered, Refused, Aborted };

struct TransferOutcome {
    TransferEnd end = TransferEnd::Aborted;
    std::string code;     ///< "dnc.no-answer"; empty when delivered
    std::string message;  ///< for people, with the numbers
    std::uint32_t confirmed_bytes = 0;
    bool resumable = false;          ///< sending again goes on where it ended, or begins anew without harm
    std::uint32_t resume_block = 0;  ///< drip mode, when the control was interrupted
    bool compared = false;
    bool armed = false;
    bool started = false;
};

struct SenderStatistics {
    std::uint64_t chunks_sent = 0;
    std::uint64_t chunks_repeated = 0;
    std::uint64_t timeouts = 0;
    std::uint64_t damaged_replies = 0;
    std::uint64_t damaged_requests = 0;  ///< of which the control told
    std::uint64_t resets_seen = 0;
    std::optional<double> link_bytes_per_s;
    std::optional<RateCheck> rate_check;
};

class Sender {
public:
    enum class Phase : std::uint8_t {
        Hello,
        Probe,
        Open,
        Stream,
        Interrupted,
        Commit,
        Compare,
        Arm,
        Start,
        Cancel,
        Over
    };

    Sender(Program program, SenderOptions options, const LinkTraits& link);

    /// The next request, when one is due and the windows allow it. Call again until there is none.
    [[nodiscard]] std::optional<Request> poll(double now_s);
    void receive(ByteView reply, double now_s);
    /// Gives up when nothing was heard or gained for too long; `poll` does it too.
    void tick(double now_s) { static_cast<void>(over() || checkStandstill(now_s)); }
    /// When `poll` is to be called at the latest, unless a reply comes before.
    [[nodiscard]] double nextWakeSeconds(double now_s) const;
    /// The transport is gone; `reason` for the message.
    void linkLost(const std::string& reason);
    /// Takes the transfer back, if it can still be; what arrived is kept for a resume.
    void cancel(double now_s);

    [[nodiscard]] bool over() const { return phase_ == Phase::Over; }
    [[nodiscard]] const TransferOutcome& outcome() const { return outcome_; }
    [[nodiscard]] Phase phase() const { return phase_; }
    [[nodiscard]] std::uint32_t acknowledgedBytes() const { return window_.acknowledged(); }
    [[nodiscard]] std::uint32_t totalBytes() const { return header_.length; }
    [[nodiscard]] const SenderStatistics& statistics() const { return statistics_; }
    [[nodiscard]] const std::optional<MachineStatus>& machine() const { return machine_; }
    [[nodiscard]] ReceiverState controlState() const { return control_state_; }
    /// The control is held for another sender (`SenderOptions::busy_s`).
    [[nodiscard]] bool waitsForAnother() const { return phase_ == Phase::Open && busy_until_s_.has_value(); }
    [[nodiscard]] const ProgramHeader& header() const { return header_; }

private:
    // Phases.
    void begin(Phase phase, RequestType type, Bytes payload = {});
    [[nodiscard]] std::optional<Request> pollProbes(double now_s);
    [[nodiscard]] std::optional<Request> pollStream(double now_s);
    [[nodiscard]] std::optional<Request> nextChunk(double now_s);
    void onProbe(const Acknowledgement& reply, double now_s);
    void onOpen(const Acknowledgement& reply, double now_s);
    void onStream(const Acknowledgement& reply, double now_s);
    void onCommand(const Acknowledgement& reply, double now_s);
    void onCompare(const Acknowledgement& read, ByteView reply, double now_s);
    void onReset(const Acknowledgement& reply, double now_s);
    void afterHello();
    void afterCommit();
    void afterCompare();
    void afterArm();
    void judgeRate();
    // The stream.
    void gained(std::uint32_t bytes, const Acknowledgement& reply, double now_s);
    void lost();
    void startTimer(double now_s);
    [[nodiscard]] bool checkStandstill(double now_s);
    [[nodiscard]] std::uint64_t limit() const;
    [[nodiscard]] bool mayArmNow() const;
    [[nodiscard]] bool mayStartNow() const;
    // The end.
    void finish(TransferEnd end, std::string code, std::string message, bool resumable);
    void abort(std::string code, std::string message, bool resumable = true);
    /// As `finish`, but first the control is told, so that the next sender finds it free.
    void close(TransferEnd end, std::string code, std::string message, bool resumable);
    [[nodiscard]] std::string place() const;

    Program program_;
    SenderOptions options_;
    LinkTraits link_;
    ProgramHeader header_;
    Conversation conversation_;
    ChunkWindow window_;
    std::optional<PieceReader> reader_;
    std::optional<Exchange> exchange_;
    Phase phase_ = Phase::Hello;
    TransferOutcome outcome_;
    SenderStatistics statistics_;
    std::optional<MachineStatus> machine_;
    ReceiverState control_state_ = ReceiverState::Idle;

    std::uint32_t nonce_;
    std::uint32_t chunk_bytes_ = 0;
    std::uint32_t most_chunk_bytes_ = 0;
    unsigned good_chunks_ = 0;
    std::size_t since_reply_ = 0;
    std::uint32_t sent_to_ = 0;  ///< the end of all that was ever sent to `session`
    std::uint32_t free_bytes_ = 0;
    std::uint32_t checked_crc_ = 0;
    bool prefilled_ = false;
    bool arm_asked_ = false;
    bool start_asked_ = false;  ///< while the rest still comes, in drip mode
    unsigned reopens_ = 0;
    std::optional<double> timer_s_;
    double last_gain_s_ = 0.0;
    double last_poll_s_ = 0.0;
    std::optional<double> busy_until_s_;
    bool started_ = false;

    unsigned probes_sent_ = 0;
    unsigned probes_back_ = 0;
    double first_probe_s_ = 0.0;
    double first_probe_back_s_ = 0.0;
    double last_probe_s_ = 0.0;
    std::uint64_t probe_bytes_after_first_ = 0;
};

}  // namespace cusp::comm
