// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One transfer in virtual time: a sender, a faulty link, a control with an operator, and what may never happen to them.
#pragma once

#include "memory_host.hpp"
#include "virtual_medium.hpp"

#include <cusp/comm/dnc/sender.hpp>

#include <memory>
#include <optional>
#include <string>

namespace cusp::comm::test {

enum class Framing { Stream, Registers, CanClassic, CanFd };

/// Everything that will go wrong in one run; all of it follows from the seed.
struct Schedule {
    std::uint64_t seed = 0;
    Framing framing = Framing::Stream;
    Faults faults;
    std::optional<double> reset_s;
    bool reset_keeps = true;
    std::optional<double> power_loss_s;
    double power_back_s = 0.0;
    TransferMode mode = TransferMode::Store;
    std::size_t program_bytes = 0;
    bool compare = false;
    bool remote_start = false;
    double line_s = 0.01;  ///< drip: the control runs a line in this time
};
[[nodiscard]] Schedule randomSchedule(Framing framing, std::uint64_t seed);

/// Lines of different lengths, none like another.
[[nodiscard]] std::string numberedProgram(std::size_t bytes, base::Random& random);

class World {
public:
    explicit World(const Schedule& schedule);

    /// Until the sender has come to an end; false when it has not within the allowed time or number of events.
    [[nodiscard]] bool run();
    /// A new sender over the same link, from now on without faults.
    [[nodiscard]] bool runAgain();
    /// What must hold whatever happened; empty when it does.
    [[nodiscard]] std::string violation() const;

    const Sender& sender() const { return *sender_; }
    const MemoryHost& host() const { return host_; }
    const std::string& program() const { return program_; }
    std::size_t events() const { return events_; }

private:
    void boot();
    void connect(const Faults& faults);
    void newSender();
    void pump();
    void operate();
    [[nodiscard]] bool drive(double limit_s);

    Schedule schedule_;
    base::Random random_;
    Timeline timeline_;
    std::string program_;
    MemoryHost host_;
    std::optional<Receiver> receiver_;
    std::vector<std::unique_ptr<Medium>> media_;  ///< old ones stay: their bytes are still under way
    std::unique_ptr<Sender> sender_;
    std::uint32_t senders_ = 0;
    double wake_s_ = -1.0;
    std::size_t events_ = 0;
    std::string executed_;  ///< of the present run
    std::string wrong_;
    int runs_ = 0;  ///< starts the control made
    bool replaced_ = false;
};

}  // namespace cusp::comm::test
