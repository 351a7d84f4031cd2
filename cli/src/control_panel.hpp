// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The operator's side of the virtual control: commands on standard input, events on standard output.
#pragma once

#include <cusp/comm/controller/control_station.hpp>

#include <string>
#include <string_view>

namespace cusp::cli {

/// Whoever stands at the control. Cycle start is theirs: a sender's START has an effect only while they have enabled it.
class ControlPanel {
public:
    explicit ControlPanel(comm::ControlStation& station)
        : station_(station), control_(station.control()), receiver_(station.receiver()) {}

    /// Reads what has been typed and does it. False after "quit".
    [[nodiscard]] bool listen(double now_s);
    /// Says what has changed since the last call.
    void tellChanges();

private:
    [[nodiscard]] bool act(const std::string& line, double now_s);
    void tellStatus() const;

    comm::ControlStation& station_;
    comm::VirtualControl& control_;
    comm::Receiver& receiver_;
    std::string typed_;
    bool typing_ = true;
    std::string told_;
    std::size_t alarms_told_ = 0;
};

}  // namespace cusp::cli
