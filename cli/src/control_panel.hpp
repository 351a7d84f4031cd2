// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The operator's side of the virtual control: commands on standard input, events on standard output.
#pragma once

#include <cusp/comm/controller/control_host.hpp>
#include <cusp/comm/controller/virtual_control.hpp>
#include <cusp/comm/dnc/receiver.hpp>

#include <string>
#include <string_view>

namespace cusp::cli {

/// Whoever stands at the control. Cycle start is theirs: a sender's START has an effect only while they have enabled it.
class ControlPanel {
public:
    ControlPanel(comm::VirtualControl& control, comm::Receiver& receiver) : control_(control), receiver_(receiver) {}

    /// Reads what has been typed and does it. False after "quit".
    [[nodiscard]] bool listen(double now_s);
    /// Says what has changed since the last call.
    void tellChanges();

private:
    [[nodiscard]] bool act(const std::string& line, double now_s);
    void tellStatus() const;

    comm::VirtualControl& control_;
    comm::Receiver& receiver_;
    std::string typed_;
    bool typing_ = true;
    std::string told_;
    std::size_t alarms_told_ = 0;
};

}  // namespace cusp::cli
