// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The control's end of the DNC protocol, sans-I/O: messages and time in, replies out. A control plugs in where its
// programs go.
#pragma once

#include <cusp/comm/dnc/message.hpp>
#include <cusp/comm/link/link.hpp>

#include <cusp/base/hash.hpp>
#include <cusp/base/random.hpp>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

namespace cusp::comm {

/// What `ReceiverHost::open` answers.
struct OpenAnswer {
    Reason reason = Reason::None;
    /// Bytes of this very program (same digest and length) kept from a transfer that broke off; 0 in drip mode.
    std::uint32_t kept_bytes = 0;
};

/// The control behind the receiver: a program store, or the FIFO of a drip feed. Called from within the receiver's
/// functions; must not call back into it.
class ReceiverHost {
public:
    ReceiverHost() = default;
    ReceiverHost(const ReceiverHost&) = delete;
    ReceiverHost& operator=(const ReceiverHost&) = delete;
    ReceiverHost(ReceiverHost&&) = delete;
    ReceiverHost& operator=(ReceiverHost&&) = delete;
    virtual ~ReceiverHost() = default;

    /// A program is announced. Any reason but None refuses it. An earlier one that was not committed is over.
    [[nodiscard]] virtual OpenAnswer open(const ProgramHeader& header) = 0;
    /// How much `accept` takes just now. In store mode the free memory, in drip mode that of the FIFO.
    [[nodiscard]] virtual std::uint32_t freeBytes() const = 0;
    /// The next bytes, in order, each exactly once; never more than `freeBytes`. In drip mode whole lines only. False: they
    /// could not be stored, the transfer fails.
    [[nodiscard]] virtual bool accept(ByteView bytes) = 0;
    /// Everything has arrived and is what was announced: the program appears under its name.
    [[nodiscard]] virtual Reason commit() = 0;
    /// The transfer ended without commit. `keep`: what arrived may serve to resume; otherwise it is known to be wrong.
    virtual void abandon(bool keep) = 0;
    /// Makes the program ready to be started at the control itself.
    [[nodiscard]] virtual Reason arm() = 0;
    /// Starts it. Called once for each start that was let through.
    [[nodiscard]] virtual Reason start() = 0;
    /// Chooses the program that `read` reads, before every read; an empty name is the one of the present transfer.
    [[nodiscard]] virtual Reason select(std::string_view name) = 0;
    [[nodiscard]] virtual std::uint32_t selectedLength() const = 0;
    /// Fills `out` with the bytes of the selected program from `offset` on; returns how many there were.
    [[nodiscard]] virtual std::size_t read(std::uint32_t offset, std::span<std::uint8_t> out) const = 0;
    [[nodiscard]] virtual MachineStatus status() const = 0;
};

struct ReceiverOptions {
    std::uint32_t max_program_bytes = 256U << 20U;
    /// Chunks that came before their turn (parallel connections reorder) are held up to so much; 0 of them is allowed.
    std::size_t reassembly_bytes = 64 * 1024;
    std::size_t reassembly_chunks = 64;
    /// Drip mode: ARM is taken once so many bytes have come (or the whole program).
    std::uint32_t prefill_bytes = 8 * 1024;
    /// Drip mode: 840D blocks have at most 512 characters; a longer line is no program.
    std::size_t max_line_bytes = 1024;
    /// A sender that is silent so long loses its right to write, and what it sent is kept for a resume.
    double lease_s = 30.0;
    /// ARM falls back so long after it was given.
    double armed_s = 600.0;
    /// Longest time one `enableStart` can give.
    double max_enable_s = 60.0;
    /// Not 0: what comes faster, averaged over a second, has no effect.
    double max_bytes_per_s = 0.0;
    /// Not empty: COMMIT must carry `commitTag` of it; drip mode, which runs before COMMIT, is refused.
    std::string commit_key = {};
};

/// Answers one message after another. Owns the session, the order of bytes, and the gate before the start:
/// OPEN, chunks, COMMIT, VERIFIED, ARM, local start. One object per control; not for several threads.
class Receiver {
public:
    /// `boot_seed` has to differ at every boot (time, random device): session numbers follow from it.
    Receiver(ReceiverOptions options, ReceiverHost& host, std::uint64_t boot_seed);

    /// One message of any origin. Empty when it asked for no reply and gave no cause for one.
    [[nodiscard]] Bytes handle(ByteView request, double now_s);
    /// What a reader of registers sees: the reply to the last message, or its upload piece.
    [[nodiscard]] Bytes area(ReplyArea area) const;
    /// Lets leases, arming and enables run out. Call it now and then; `handle` does it too.
    void tick(double now_s);

    /// RESET of the control: everything under way is over, and every message sent before is without effect.
    /// `keep`: the store may keep what arrived.
    void reset(bool keep);
    /// The operator at the control permits one remote start within the next `seconds`.
    void enableStart(double now_s, double seconds);
    void revokeStart() { start_enabled_until_s_ = 0.0; }
    /// Cycle start at the control itself. WrongState unless ARM was given and holds.
    [[nodiscard]] Reason startLocally(double now_s);
    /// The control has run the program to its end.
    void programFinished();
    /// The control stopped it for good (starvation, alarm, operator): what still comes of it is refused.
    void programInterrupted();

    [[nodiscard]] ReceiverState state() const { return state_; }
    [[nodiscard]] std::uint32_t session() const { return session_; }
    /// Of the present or last transfer.
    [[nodiscard]] const ProgramHeader& program() const { return program_; }
    /// All bytes of a drip-fed program have come and are the announced ones.
    [[nodiscard]] bool committed() const { return committed_; }
    [[nodiscard]] std::uint32_t acceptedBytes() const { return expected_; }

private:
    [[nodiscard]] Reason act(const RequestMessage& message, double now_s);
    [[nodiscard]] Reason command(const RequestMessage& message, double now_s);
    [[nodiscard]] Reason open(const RequestMessage& message, double now_s);
    [[nodiscard]] Reason admit(const ProgramHeader& header, double now_s) const;
    [[nodiscard]] Reason chunk(std::uint32_t offset, ByteView bytes);
    [[nodiscard]] Reason hold(std::uint32_t offset, ByteView bytes);
    [[nodiscard]] Reason deliver(ByteView bytes);
    [[nodiscard]] Reason deliverLines(ByteView bytes);
    [[nodiscard]] Reason releaseHeld();
    [[nodiscard]] Reason commit(const RequestMessage& message);
    [[nodiscard]] Reason arm(double now_s);
    [[nodiscard]] Reason startRemotely(double now_s);
    [[nodiscard]] Reason abort();
    [[nodiscard]] Reason readPiece(const RequestMessage& message);
    [[nodiscard]] bool rebuild(std::uint32_t kept_bytes);
    [[nodiscard]] Reason fail(Reason reason);
    void closeTransfer();
    void newSession();
    [[nodiscard]] bool transferOpen() const { return open_ && !committed_; }
    [[nodiscard]] bool prefilled() const;
    [[nodiscard]] std::uint32_t freeBytes() const;
    [[nodiscard]] bool withinRate(std::size_t bytes, double now_s);
    [[nodiscard]] Acknowledgement acknowledgement() const;

    ReceiverOptions options_;
    ReceiverHost& host_;
    base::Random random_;

    ReceiverState state_ = ReceiverState::Idle;
    std::uint32_t session_ = 0;
    std::uint32_t opened_from_session_ =
        0;  ///< with `open_nonce_`: the OPEN that began `session_`, when it comes again
    std::uint32_t open_nonce_ = 0;
    std::uint32_t last_nonce_ = 0;
    Reason last_result_ = Reason::None;
    Reason last_reason_ = Reason::None;
    Reason failure_ = Reason::None;
    std::uint16_t last_tag_ = 0;

    ProgramHeader program_;
    bool open_ = false;
    bool committed_ = false;
    std::uint32_t expected_ = 0;
    std::uint32_t running_crc_ = 0;
    base::Sha256 running_digest_;
    Bytes partial_line_;
    std::map<std::uint32_t, Bytes> held_;  ///< by offset
    std::size_t held_bytes_ = 0;
    Bytes upload_;

    double now_s_ = 0.0;
    double lease_until_s_ = 0.0;
    double armed_until_s_ = 0.0;
    double start_enabled_until_s_ = 0.0;
    double rate_credit_bytes_ = 0.0;
    double rate_seen_s_ = 0.0;
};

}  // namespace cusp::comm
