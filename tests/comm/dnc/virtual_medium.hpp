// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Links in virtual time that lose, double, reorder, corrupt, delay and stall: the framings are the real ones.
#pragma once

#include <cusp/base/random.hpp>
#include <cusp/comm/link/iso_tp.hpp>
#include <cusp/comm/link/link.hpp>
#include <cusp/comm/link/registers.hpp>
#include <cusp/comm/link/stream_framing.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <queue>
#include <vector>

namespace cusp::comm::test {

/// What happens when, and nothing else is time.
class Timeline {
public:
    void at(double time_s, std::function<void()> what) { queue_.push({time_s, order_++, std::move(what)}); }
    void after(double delay_s, std::function<void()> what) { at(now_s_ + delay_s, std::move(what)); }
    /// Runs the next event; false when there is none.
    bool step() {
        if (queue_.empty()) return false;
        Event event = queue_.top();
        queue_.pop();
        now_s_ = event.time_s;
        event.what();
        return true;
    }
    [[nodiscard]] double nowSeconds() const { return now_s_; }

private:
    struct Event {
        double time_s;
        std::uint64_t order;
        std::function<void()> what;
        bool operator<(const Event& other) const {
            return time_s != other.time_s ? time_s > other.time_s : order > other.order;
        }
    };
    std::priority_queue<Event> queue_;
    std::uint64_t order_ = 0;
    double now_s_ = 0.0;
};

enum class Direction { ToControl, ToSender };

struct Window {
    double from_s = 0.0;
    double to_s = 0.0;
    [[nodiscard]] bool holds(double time_s) const { return time_s >= from_s && time_s < to_s; }
};

/// Per unit that travels (a segment of bytes, a transaction, a frame).
struct Faults {
    double loss = 0.0;
    double duplication = 0.0;
    double corruption = 0.0;
    double reordering = 0.0;  ///< held back by up to `held_back_s`
    double held_back_s = 0.05;
    double jitter_s = 0.0;  ///< of the delay; what is delayed keeps its order
    Window stall;           ///< nothing arrives; it comes afterwards
    Window half_open;       ///< one direction loses everything
    Direction half_open_direction = Direction::ToControl;
};

/// The sender's end of a virtual link; `peer` is the control's.
class Medium {
public:
    Medium(Timeline& timeline, Faults faults, base::Random random)
        : timeline_(timeline), faults_(faults), random_(random) {}
    Medium(const Medium&) = delete;
    Medium& operator=(const Medium&) = delete;
    virtual ~Medium() = default;

    [[nodiscard]] virtual LinkTraits traits() const = 0;
    [[nodiscard]] virtual bool ready() const = 0;
    virtual void send(const Request& request) = 0;

    std::function<void(ByteView)> on_reply;
    std::function<void()> on_ready;             ///< `ready` may have become true
    std::function<Bytes(ByteView)> peer;        ///< empty: no reply
    std::function<Bytes(ReplyArea)> peer_area;  ///< empty: the control is off

protected:
    /// Calls `arrive` for each copy of `unit` that gets through, when it does, as it then is.
    void carry(Direction direction, double arrival_s, Bytes unit, const std::function<void(Bytes)>& arrive);

    Timeline& timeline_;
    Faults faults_;
    base::Random random_;

private:
    double last_arrival_s_[2] = {0.0, 0.0};
};

struct StreamRates {
    double bytes_per_s = 11520.0;
    double latency_s = 0.001;
    std::size_t segment_bytes = 64;
    std::size_t buffer_bytes = 512;  ///< the system's: `ready` while less is waiting
};

/// TCP or serial: framed messages in segments of bytes, both directions at the same time.
class StreamMedium : public Medium {
public:
    StreamMedium(Timeline& timeline, Faults faults, base::Random random, StreamRates rates)
        : Medium(timeline, faults, random), rates_(rates) {}
    LinkTraits traits() const override;
    bool ready() const override;
    void send(const Request& request) override { transmit(Direction::ToControl, request.bytes); }

private:
    void transmit(Direction direction, ByteView message);
    void arrive(Direction direction, ByteView bytes);

    StreamRates rates_;
    double line_free_s_[2] = {0.0, 0.0};
    StreamDeframer control_end_{16 * 1024};
    StreamDeframer sender_end_{16 * 1024};
};

struct RegisterRates {
    double bytes_per_s = 10473.0;  ///< 115200 baud, 11 bits a character
    double silence_s = 0.00175;    ///< between frames (Modbus over serial line V1.02, 2.5.1.1)
    double latency_s = 0.0;        ///< one way
    double reply_timeout_s = 0.5;
    std::size_t connections = 1;
    bool exchanges = false;  ///< function 23 (write and read at once) instead of 16 and 3
    std::size_t reply_every = 8;
};

/// Modbus: transactions, one at a time on each connection.
class RegisterMedium : public Medium {
public:
    RegisterMedium(Timeline& timeline, Faults faults, base::Random random, RegisterRates rates)
        : Medium(timeline, faults, random), rates_(rates) {}
    LinkTraits traits() const override;
    bool ready() const override { return busy_ < rates_.connections; }
    void send(const Request& request) override;

    /// What one transaction takes on the wire, both frames and both silences.
    [[nodiscard]] double transactionSeconds(std::size_t request_bytes, std::size_t reply_bytes) const;

private:
    void transact(const Registers& written, ReplyArea area, std::size_t read_registers,
                  const std::function<void(const Registers*)>& done);

    RegisterRates rates_;
    std::size_t busy_ = 0;
};

struct CanRates {
    double nominal_bits_per_s = 1e6;
    double data_bits_per_s = 5e6;  ///< of the data phase of FD
    bool fd = false;
};

/// One bus, both ends on it: frames one after another, those of the sender and of the control by turns.
class CanMedium : public Medium {
public:
    CanMedium(Timeline& timeline, Faults faults, base::Random random, CanRates rates);
    LinkTraits traits() const override;
    bool ready() const override { return sender_.ready(); }
    void send(const Request& request) override;

    /// Bits of a data frame with 11-bit identifier and its gap, without stuff bits.
    [[nodiscard]] double frameSeconds(std::size_t payload_bytes) const;
    [[nodiscard]] double busySeconds() const { return busy_s_; }

private:
    void pump();
    void arrive(Direction direction, const Bytes& frame);

    CanRates rates_;
    IsoTpEndpoint sender_;
    IsoTpEndpoint control_;
    bool bus_busy_ = false;
    bool control_last_ = true;
    double wake_s_ = -1.0;
    double busy_s_ = 0.0;
};

}  // namespace cusp::comm::test
