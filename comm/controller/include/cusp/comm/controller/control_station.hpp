// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A virtual control that can be reached: links, receiver and control in one loop, in real time or as fast as possible.
#pragma once

#include <cusp/comm/controller/control_host.hpp>
#include <cusp/comm/controller/virtual_control.hpp>
#include <cusp/comm/dnc/run_transfer.hpp>
#include <cusp/comm/link/transports.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::comm {

/// How the control's own time goes by.
enum class Pace : std::uint8_t {
    RealTime,  ///< by the monotonic clock
    /// An active program runs as fast as the processor can. While it is drip-fed, time stands still when the FIFO is less
    /// than half full and more is to come, so that a fast clock does not starve it.
    AsFastAsPossible
};

struct StationOptions {
    ControlHostOptions host{};
    ReceiverOptions receiver{};
    ListenOptions listen{};
    /// Sessions follow from it; 0: random, as it has to be where strangers send.
    std::uint64_t boot_seed = 0;
    Pace pace = Pace::RealTime;
};

/// One thread, that calls `step` again and again; whoever sends does so from another thread or process.
class ControlStation {
public:
    /// The control must outlive the station; it can be worked by its own functions between steps.
    ControlStation(VirtualControl& control, StationOptions options);

    /// Listens on one more link. Answers where, with the port that was taken. Errors: `link.*`, `io.link-open`.
    [[nodiscard]] base::Result<std::string> listen(std::string_view url);
    /// Serves what has come, waiting at most `wait_s` for it, lets the control's time go by, and tells the receiver what
    /// became of its program. Errors: `io.link-…`, when a link has become impossible.
    [[nodiscard]] base::Result<void> step(double wait_s);
    /// RESET of the control and of what is under way to it.
    void reset();
    /// Cycle start at the control: of what a transfer has armed, so that its sender learns of it, else of the chosen program.
    [[nodiscard]] bool start();

    [[nodiscard]] VirtualControl& control() { return control_; }
    [[nodiscard]] const VirtualControl& control() const { return control_; }
    [[nodiscard]] Receiver& receiver() { return receiver_; }
    [[nodiscard]] const Receiver& receiver() const { return receiver_; }
    [[nodiscard]] ControlHost& host() { return host_; }
    /// Connected clients of all links.
    [[nodiscard]] std::size_t clients() const;

private:
    void passTime(double now_s);
    [[nodiscard]] bool waitsForFeed(double now_s);

    VirtualControl& control_;
    StationOptions options_;
    ControlHost host_;
    Receiver receiver_;
    ReceiverService service_;
    std::vector<std::unique_ptr<LinkServer>> servers_;
    double begin_s_;
    double lost_s_ = 0.0;  ///< by which the control is behind the clock for good
    bool hurries_ = false;
    bool was_connected_ = false;
    std::uint32_t seen_bytes_ = 0;
    double seen_s_ = 0.0;
};

}  // namespace cusp::comm
