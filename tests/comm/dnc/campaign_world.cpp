// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Schedules from seeds, and the world they happen to.
#include "campaign_world.hpp"

#include <algorithm>
#include <cmath>

namespace cusp::comm::test {

namespace {
constexpr double operator_step_s = 0.02;
constexpr double allowed_s = 2000.0;
constexpr std::size_t allowed_events = 2'000'000;
}  // namespace

std::string numberedProgram(std::size_t bytes, base::Random& random) {
    std::string out;
    for (int line = 10; out.size() < bytes; line += 10) {
        out += "N" + std::to_string(line) + " G1 X" + std::to_string(random.integer(-99999, 99999));
        if (random.chance(0.5)) out += " Y" + std::to_string(random.integer(-999, 999)) + " A3=0.1 C3=1";
        out += '\n';
    }
    if (random.chance(0.2)) out.pop_back();
    return out;
}

Schedule randomSchedule(Framing framing, std::uint64_t seed) {
    base::Random random = base::Random(seed).split(static_cast<std::uint64_t>(framing));
    Schedule out;
    out.seed = seed;
    out.framing = framing;
    // Rates count per unit; a message of many CAN frames is hit more often than one transaction.
    const bool can = framing == Framing::CanClassic || framing == Framing::CanFd;
    const double scale = can ? 0.02 : framing == Framing::Stream ? 0.05 : 0.2;
    const auto rate = [&] { return random.chance(0.5) ? random.uniform(0.0, scale) : 0.0; };
    out.faults.loss = rate();
    out.faults.duplication = rate();
    out.faults.corruption = rate();
    out.faults.reordering = rate();
    out.faults.jitter_s = random.chance(0.3) ? random.uniform(0.0, 0.01) : 0.0;
    const auto window = [&](double most_s) {
        const double from_s = random.uniform(0.0, 1.5);
        return Window{from_s, from_s + random.uniform(0.05, random.chance(0.2) ? 40.0 : most_s)};
    };
    if (random.chance(0.3)) out.faults.stall = window(3.0);
    if (random.chance(0.25)) out.faults.half_open = window(5.0);
    out.faults.half_open_direction = random.chance(0.5) ? Direction::ToControl : Direction::ToSender;
    if (random.chance(0.25)) out.reset_s = random.uniform(0.0, 1.5);
    out.reset_keeps = random.chance(0.5);
    if (random.chance(0.2)) {
        out.power_loss_s = random.uniform(0.0, 1.5);
        out.power_back_s = *out.power_loss_s + random.uniform(0.05, random.chance(0.2) ? 40.0 : 5.0);
    }
    out.mode = random.chance(0.35) ? TransferMode::Drip : TransferMode::Store;
    out.program_bytes = static_cast<std::size_t>(random.integer(20, random.chance(0.1) ? 12000 : 3000));
    out.compare = random.chance(0.3);
    out.remote_start = random.chance(0.3);
    out.line_s = random.uniform(0.001, 0.02);
    return out;
}

World::World(const Schedule& schedule)
    : schedule_(schedule),
      random_(base::Random(schedule.seed).split(100 + static_cast<std::uint64_t>(schedule.framing))),
      program_(numberedProgram(schedule.program_bytes, random_)) {
    host_.fifo_bytes = 1500;
    boot();
    connect(schedule_.faults);
    newSender();
    if (schedule_.reset_s) {
        timeline_.at(*schedule_.reset_s, [this] {
            if (receiver_) receiver_->reset(schedule_.reset_keeps);
            host_.fifo.clear();
        });
    }
    if (schedule_.power_loss_s) {
        timeline_.at(*schedule_.power_loss_s, [this] {
            receiver_.reset();
            host_.fifo.clear();
            // Of what was not committed, the disk has kept a part.
            host_.partial.resize(random_.below(host_.partial.size() + 1));
        });
        timeline_.at(schedule_.power_back_s, [this] { boot(); });
    }
    operate();
}

void World::boot() {
    ReceiverOptions options;
    options.prefill_bytes = 600;
    options.lease_s = 10.0;
    options.reassembly_chunks = random_.below(17);
    receiver_.emplace(options, host_, random_.next());
}

void World::connect(const Faults& faults) {
    const base::Random random = random_.split(media_.size());
    std::unique_ptr<Medium> medium;
    switch (schedule_.framing) {
        case Framing::Stream: medium = std::make_unique<StreamMedium>(timeline_, faults, random, StreamRates{}); break;
        case Framing::Registers: {
            RegisterRates rates;
            rates.exchanges = random_.chance(0.5);
            if (rates.exchanges) rates.connections = 1 + random_.below(8);
            if (rates.exchanges) rates.latency_s = random_.uniform(0.0, 0.02);
            medium = std::make_unique<RegisterMedium>(timeline_, faults, random, rates);
            break;
        }
        default: {
            CanRates rates;
            rates.fd = schedule_.framing == Framing::CanFd;
            medium = std::make_unique<CanMedium>(timeline_, faults, random, rates);
        }
    }
    const auto* const present = medium.get();
    medium->peer = [this](ByteView request) {
        return receiver_ ? receiver_->handle(request, timeline_.nowSeconds()) : Bytes();
    };
    medium->peer_area = [this](ReplyArea area) { return receiver_ ? receiver_->area(area) : Bytes(); };
    medium->on_reply = [this, present](ByteView reply) {
        if (media_.back().get() != present) return;
        sender_->receive(reply, timeline_.nowSeconds());
        pump();
    };
    medium->on_ready = [this, present] {
        if (media_.back().get() == present) pump();
    };
    media_.push_back(std::move(medium));
}

void World::newSender() {
    SenderOptions options;
    options.mode = schedule_.mode;
    options.client = 1000 + ++senders_;
    options.first_chunk_bytes = static_cast<std::uint32_t>(random_.integer(40, 400));
    options.compare = schedule_.compare;
    options.arm = true;
    options.start = schedule_.mode == TransferMode::Store && schedule_.remote_start;
    sender_ = std::make_unique<Sender>(Program{.name = "P.MPF", .text = program_}, options, media_.back()->traits());
}

void World::pump() {
    Medium& medium = *media_.back();
    while (!sender_->over() && medium.ready()) {
        const auto request = sender_->poll(timeline_.nowSeconds());
        if (!request) break;
        medium.send(*request);
    }
    const double next_s = sender_->nextWakeSeconds(timeline_.nowSeconds());
    if (sender_->over() || (wake_s_ > timeline_.nowSeconds() && wake_s_ <= next_s)) return;
    wake_s_ = next_s;
    timeline_.at(next_s, [this] { pump(); });
}

void World::operate() {
    const double now_s = timeline_.nowSeconds();
    if (receiver_) {
        receiver_->tick(now_s);
        // The operator starts what is armed, or lets the sender do it.
        if (schedule_.remote_start && schedule_.mode == TransferMode::Store) {
            receiver_->enableStart(now_s, 5.0);
        } else if (receiver_->state() == ReceiverState::Armed && random_.chance(0.1)) {
            if (receiver_->startLocally(now_s) == Reason::None) executed_.clear();
        }
        if (receiver_->state() == ReceiverState::Running && schedule_.mode == TransferMode::Drip) {
            const auto lines = static_cast<int>(std::ceil(operator_step_s / schedule_.line_s));
            for (int run = 0; run < lines; ++run) {
                const auto line = host_.runLine();
                if (line) {
                    executed_ += *line;
                } else if (receiver_->committed()) {
                    if (executed_ != program_) wrong_ = "a drip-fed program ended without having run whole";
                    receiver_->programFinished();
                    break;
                } else if (receiver_->acceptedBytes() == program_.size()) {
                    break;  // a last line without end comes with the commit
                } else {
                    // Hungry: a real control has lifted the tool by now.
                    ++host_.machine.starvations;
                    host_.machine.resume_block = 10;
                    receiver_->programInterrupted();
                    host_.fifo.clear();
                    break;
                }
            }
            if (!program_.starts_with(executed_)) wrong_ = "lines were run that are not the program's, or twice";
        }
    }
    timeline_.after(operator_step_s, [this] { operate(); });
}

bool World::drive(double limit_s) {
    pump();
    while (!sender_->over()) {
        if (++events_ > allowed_events || timeline_.nowSeconds() > limit_s || !timeline_.step()) return false;
    }
    return true;
}

bool World::run() {
    if (!drive(allowed_s)) return false;
    // Whoever was delivered drip-fed goes on running; and what is still under way may yet arrive.
    const double settle_s = timeline_.nowSeconds() + 20.0;
    while (timeline_.nowSeconds() < settle_s && timeline_.step()) {
    }
    return true;
}

bool World::runAgain() {
    // The operator has looked, and presses RESET on what did not end well.
    if (!receiver_) boot();
    receiver_->reset(true);
    receiver_->enableStart(timeline_.nowSeconds(), 5.0);
    host_.fifo.clear();
    executed_.clear();
    host_.starts = 0;
    schedule_.line_s = operator_step_s;  // slow enough for the slowest of the links
    connect(Faults{});
    newSender();
    return drive(timeline_.nowSeconds() + allowed_s);
}

std::string World::violation() const {
    if (!wrong_.empty()) return wrong_;
    if (host_.overfilled) return "more was handed over than there was room for";
    if (host_.broken_line) return "part of a line was handed to the interpreter";
    const auto stored = host_.programs.find("P.MPF");
    const bool has = stored != host_.programs.end();
    if (has && stored->second != program_) return "the stored program is not the one that was sent";
    const TransferOutcome& outcome = sender_->outcome();
    if (host_.starts > 1) return "the program was started twice";
    if (outcome.end == TransferEnd::Delivered) {
        if (!has) return "called delivered, and is not there";
        if (outcome.started && host_.starts != 1) return "called started, and is not";
        return "";
    }
    if (outcome.code.empty() || outcome.message.empty()) return "an end without explanation";
    return "";
}

}  // namespace cusp::comm::test
