// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Streams, registers and frames in virtual time.
#include "virtual_medium.hpp"

#include <algorithm>
#include <utility>

namespace cusp::comm::test {

void Medium::carry(Direction direction, double arrival_s, Bytes unit, const std::function<void(Bytes)>& arrive) {
    if (faults_.half_open.holds(timeline_.nowSeconds()) && faults_.half_open_direction == direction) return;
    if (random_.chance(faults_.loss)) return;
    const int copies = random_.chance(faults_.duplication) ? 2 : 1;
    for (int copy = 0; copy < copies; ++copy) {
        Bytes bytes = unit;
        if (random_.chance(faults_.corruption) && !bytes.empty()) {
            const std::int64_t flips = random_.integer(1, 4);
            for (std::int64_t i = 0; i < flips; ++i) {
                auto& byte = bytes[random_.below(bytes.size())];
                byte = static_cast<std::uint8_t>(byte ^ (1U << random_.below(8)));
            }
        }
        double& in_order_s = last_arrival_s_[direction == Direction::ToControl ? 0 : 1];
        double when_s = arrival_s + random_.uniform(0.0, faults_.jitter_s);
        if (copy > 0 || random_.chance(faults_.reordering)) {
            when_s += random_.uniform(0.0, faults_.held_back_s);
        } else if (faults_.jitter_s > 0.0) {
            in_order_s = std::max(in_order_s, when_s);
            when_s = in_order_s;
        }
        if (faults_.stall.holds(when_s)) when_s = faults_.stall.to_s;
        timeline_.at(when_s, [arrive, bytes = std::move(bytes)] { arrive(bytes); });
    }
}

LinkTraits StreamMedium::traits() const {
    LinkTraits out;
    out.max_request_bytes = 4096 + 18;
    out.max_reply_bytes = 4096;
    out.useful_in_flight = 16;
    out.nominal_bytes_per_s = rates_.bytes_per_s;
    return out;
}

bool StreamMedium::ready() const {
    const double waiting_s = line_free_s_[0] - timeline_.nowSeconds();
    return waiting_s * rates_.bytes_per_s < static_cast<double>(rates_.buffer_bytes);
}

void StreamMedium::transmit(Direction direction, ByteView message) {
    const Bytes framed = frameForStream(message);
    double& free_s = line_free_s_[direction == Direction::ToControl ? 0 : 1];
    free_s = std::max(free_s, timeline_.nowSeconds());
    for (std::size_t at = 0; at < framed.size(); at += rates_.segment_bytes) {
        const std::size_t size = std::min(rates_.segment_bytes, framed.size() - at);
        free_s += static_cast<double>(size) / rates_.bytes_per_s;
        const auto begin = framed.begin() + static_cast<std::ptrdiff_t>(at);
        carry(direction, free_s + rates_.latency_s, Bytes(begin, begin + static_cast<std::ptrdiff_t>(size)),
              [this, direction](const Bytes& bytes) { arrive(direction, bytes); });
    }
    const double drained_s = free_s - (static_cast<double>(rates_.buffer_bytes - 1) / rates_.bytes_per_s);
    if (direction == Direction::ToControl)
        timeline_.at(std::max(drained_s, timeline_.nowSeconds()), [this] { on_ready(); });
}

void StreamMedium::arrive(Direction direction, ByteView bytes) {
    StreamDeframer& end = direction == Direction::ToControl ? control_end_ : sender_end_;
    end.push(bytes);
    while (const auto message = end.next()) {
        if (direction == Direction::ToSender) {
            on_reply(*message);
        } else if (const Bytes reply = peer(*message); !reply.empty()) {
            transmit(Direction::ToSender, reply);
        }
    }
}

LinkTraits RegisterMedium::traits() const {
    LinkTraits out;
    out.max_request_bytes = 2 * (rates_.exchanges ? most_exchanged_written : most_written_registers);
    out.max_reply_bytes = 2 * most_read_registers;
    out.useful_in_flight = rates_.connections;
    out.reply_every = rates_.exchanges ? 1 : rates_.reply_every;
    return out;
}

double RegisterMedium::transactionSeconds(std::size_t request_bytes, std::size_t reply_bytes) const {
    return (static_cast<double>(request_bytes + reply_bytes) / rates_.bytes_per_s) + (2.0 * rates_.silence_s) +
           (2.0 * rates_.latency_s);
}

void RegisterMedium::transact(const Registers& written, ReplyArea area, std::size_t read_registers,
                              const std::function<void(const Registers*)>& done) {
    // Address, function, ranges, counts, data, CRC (Modbus application protocol V1.1b3, 6.3, 6.12, 6.17).
    const bool both = !written.empty() && read_registers > 0;
    const std::size_t request_bytes = both ? 13 + (2 * written.size()) : written.empty() ? 8 : 9 + (2 * written.size());
    const std::size_t reply_bytes = read_registers > 0 ? 5 + (2 * read_registers) : 8;
    const double half_s = transactionSeconds(request_bytes, reply_bytes) / 2.0;
    // The client waits for one reply; whatever comes after its timeout, or twice, is not looked at.
    auto open = std::make_shared<bool>(true);
    timeline_.after((2.0 * half_s) + rates_.reply_timeout_s, [open, done] {
        if (std::exchange(*open, false)) done(nullptr);
    });
    carry(Direction::ToControl, timeline_.nowSeconds() + half_s, toBytes(written), [=, this](const Bytes& bytes) {
        if (!bytes.empty()) static_cast<void>(peer(bytes));
        Bytes image = read_registers > 0 ? peer_area(area) : Bytes(2);
        if (image.empty()) return;
        image.resize(2 * std::max<std::size_t>(1, read_registers));
        carry(Direction::ToSender, timeline_.nowSeconds() + half_s, image, [open, done](const Bytes& read) {
            const Registers registers = toRegisters(read);
            if (std::exchange(*open, false)) done(&registers);
        });
    });
}

void RegisterMedium::send(const Request& request) {
    ++busy_;
    const Registers written = toRegisters(request.bytes);
    const std::size_t wanted = request.reply_wanted ? (request.reply_bytes + 1) / 2 : 0;
    const auto finish = [this, wanted](const Registers* read) {
        --busy_;
        if (read != nullptr && wanted > 0) on_reply(toBytes(*read));
        on_ready();
    };
    if (rates_.exchanges || wanted == 0) return transact(written, request.area, wanted, finish);
    transact(written, request.area, 0, [this, finish, wanted, area = request.area](const Registers* confirmed) {
        if (confirmed == nullptr) return finish(nullptr);
        transact({}, area, wanted, finish);
    });
}

CanMedium::CanMedium(Timeline& timeline, Faults faults, base::Random random, CanRates rates)
    : Medium(timeline, faults, random), rates_(rates), sender_({.fd = rates.fd}), control_({.fd = rates.fd}) {}

LinkTraits CanMedium::traits() const {
    LinkTraits out;
    out.max_request_bytes = IsoTpEndpoint::max_message_bytes;
    out.max_reply_bytes = IsoTpEndpoint::max_message_bytes;
    out.useful_in_flight = 4;
    out.reply_every = 2;
    out.nominal_bytes_per_s = rates_.fd ? 400e3 : 60e3;
    return out;
}

double CanMedium::frameSeconds(std::size_t payload_bytes) const {
    // Classic: start 1, identifier and control 18, CRC 15, delimiters and ACK 3, end 7, gap 3 (ISO 11898-1).
    if (!rates_.fd) return (47.0 + (8.0 * static_cast<double>(payload_bytes))) / rates_.nominal_bits_per_s;
    // FD with rate switch: 30 bits slow, the rest fast: ESI, DLC 5, data, stuff count 4, CRC 21 with its 7 fixed bits.
    const double fast_bits = 5.0 + (8.0 * static_cast<double>(payload_bytes)) + 4.0 + 21.0 + 7.0;
    return (30.0 / rates_.nominal_bits_per_s) + (fast_bits / rates_.data_bits_per_s);
}

void CanMedium::send(const Request& request) {
    static_cast<void>(sender_.send(request.bytes));
    pump();
}

void CanMedium::pump() {
    if (bus_busy_) return;
    const double now_s = timeline_.nowSeconds();
    IsoTpEndpoint* const order[2] = {control_last_ ? &sender_ : &control_, control_last_ ? &control_ : &sender_};
    for (IsoTpEndpoint* end : order) {
        auto frame = end->poll(now_s);
        if (!frame) continue;
        const Direction direction = end == &sender_ ? Direction::ToControl : Direction::ToSender;
        control_last_ = end == &control_;
        bus_busy_ = true;
        const double end_s = now_s + frameSeconds(frame->size());
        busy_s_ += end_s - now_s;
        carry(direction, end_s, *std::move(frame), [this, direction](const Bytes& bytes) { arrive(direction, bytes); });
        timeline_.at(end_s, [this] {
            bus_busy_ = false;
            on_ready();
            pump();
        });
        return;
    }
    const double next_s = std::min(sender_.nextWakeSeconds(), control_.nextWakeSeconds());
    // One alarm clock: not a new one for each look at it.
    if (next_s < 1e9 && (wake_s_ <= now_s || next_s < wake_s_)) {
        wake_s_ = std::max(next_s, now_s + 1e-5);
        timeline_.at(wake_s_, [this] { pump(); });
    }
}

void CanMedium::arrive(Direction direction, const Bytes& frame) {
    IsoTpEndpoint& end = direction == Direction::ToControl ? control_ : sender_;
    end.receive(frame, timeline_.nowSeconds());
    while (const auto message = end.next()) {
        if (direction == Direction::ToSender) {
            on_reply(*message);
        } else if (Bytes reply = peer(*message); !reply.empty()) {
            static_cast<void>(control_.send(std::move(reply)));
        }
    }
    pump();
}

}  // namespace cusp::comm::test
