// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A virtual 840D-like control: it really runs the programs it is given, on axes with the limits of a machine file.
#pragma once

#include <cusp/base/result.hpp>
#include <cusp/dynamics/motion_planner.hpp>
#include <cusp/kinematics/machine.hpp>
#include <cusp/machine/setup_definition.hpp>
#include <cusp/post/control/control_definition.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::comm {

struct ControlOptions {
    double tick_s = 0.002;                                        ///< of the interpolator
    double preparation_s = 0.0005;                                ///< time the control takes to prepare a block
    std::size_t look_ahead_blocks = 100;                          ///< 70 to 120 on real ones
    std::size_t fifo_bytes = 30 * 1024;                           ///< reload FIFO of drip feeding
    double lift_mm = 2.0;                                         ///< along the tool axis, when the FIFO runs dry
    double tool_length_mm = 100.0;                                ///< of every tool
    geometry::Vector3 wcs_origin_mm = geometry::Vector3::Zero();  ///< of every work offset, machine frame
    /// When given, tool lengths and work offsets are its, and the two above do not count. Must outlive the control. What
    /// a program needs and the setup does not say is an alarm.
    const machine::SetupDefinition* setup = nullptr;
};

/// OPC 40502 (CncChannel), status of the channel.
enum class ChannelState : std::uint8_t { Reset, Active, Interrupted };
[[nodiscard]] std::string_view toText(ChannelState state);

struct Alarm {
    int number = 0;
    std::size_t line = 0;  ///< of the program; 0: none
    std::string text;
};

/// Numbers of alarms, those of the 840D where it has one; 700000 and up are a machine builder's.
namespace alarm {
inline constexpr int software_limit = 10720;
inline constexpr int no_feed = 10860;
inline constexpr int not_reached = 10911;  ///< the transformation does not permit this position
inline constexpr int program = 12080;
inline constexpr int fifo_empty = 700001;
inline constexpr int no_tool_length = 700002;  ///< the setup does not know the tool
inline constexpr int no_work_offset = 700003;  ///< the setup does not know the work offset
}  // namespace alarm

/// What can be seen of the control. Names follow OPC 40502 where it has one.
struct ControlStatus {
    ChannelState state = ChannelState::Reset;
    double time_s = 0.0;
    std::string program;
    std::size_t chosen = 0;  ///< counts up whenever a program is chosen
    std::size_t executing_line = 0;
    std::size_t completed_line = 0;
    std::size_t read_line = 0;
    std::size_t queued_blocks = 0;
    std::size_t least_queued_blocks = 0;  ///< while running
    double override_share = 1.0;
    dynamics::AxisVector axes{};
    dynamics::ToolPlace tool;  ///< in the frame of the work offset
    double feed_mm_per_s = 0.0;
    bool rapid = false;  ///< what is run is a rapid
    std::size_t fifo_bytes = 0;
    std::size_t fifo_capacity = 0;
    std::size_t starvations = 0;
    double contact_s = 0.0;       ///< at the last starvation, from when it began to brake until it had lifted
    std::size_t resume_line = 0;  ///< where to resume after an interruption; 0: from the start
    std::string waiting_for;      ///< "M0", "M1", "single block", "NC stop", or empty
    std::vector<Alarm> alarms;
    bool finished = false;  ///< the program has run to its end
    dynamics::PlanSummary planning;
};

/// One sample of what the axes really did.
struct ControlSample {
    double time_s = 0.0;
    dynamics::AxisVector axes{};
    std::size_t line = 0;
    dynamics::ToolPlace tool;  ///< as the control believes, in the frame of the work offset it runs in
};

/// Deterministic: time passes only by `advance`, and the same calls give the same samples. One thread.
///
/// A software hold is no emergency stop: `stop` ends motion along the path as fast as the axes' limits permit, and that is all.
class VirtualControl {
public:
    /// All references must outlive the control.
    VirtualControl(const post::MachineFile& file, const kinematics::Machine& machine, ControlOptions options);
    ~VirtualControl();
    VirtualControl(const VirtualControl&) = delete;
    VirtualControl& operator=(const VirtualControl&) = delete;

    /// Chooses a program. Only in reset.
    [[nodiscard]] bool select(std::string name, std::string text);
    /// The program that was chosen by `select`; empty while one comes through the FIFO.
    [[nodiscard]] const std::string& programText() const;
    /// Chooses a program that comes line by line through the FIFO. Only in reset.
    [[nodiscard]] bool selectFifo(std::string name);
    [[nodiscard]] std::size_t fifoFree() const;
    /// Whole lines. False when they do not fit.
    [[nodiscard]] bool feed(std::string_view lines);
    /// Nothing more comes.
    void endFeed();

    /// Cycle start: from reset the program from its beginning, else it goes on. False where there is nothing to start, or an
    /// alarm asks for a reset first.
    [[nodiscard]] bool start();
    /// NC stop: decelerates on the path.
    void stop();
    /// RESET: decelerates, then forgets the program's state; the FIFO is emptied at once, alarms go.
    void reset();
    /// 0 to 1.2. More than 1 reaches blocks that are not prepared yet.
    void setOverride(double share);
    void setSingleBlock(bool on);
    void setOptionalStop(bool on);
    /// Block search with calculation: the next start begins at `line` of the chosen program, in the state the lines
    /// before it make: the machine first goes home with the retract axis, then over the place, then down. Only in reset.
    [[nodiscard]] base::Result<void> search(std::size_t line);

    void advance(double seconds);
    /// Runs in virtual time until nothing moves and nothing is prepared any more (end, stop, alarm, empty FIFO), or so many
    /// seconds are over.
    void runToRest(double most_s);

    [[nodiscard]] const ControlStatus& status() const;
    /// Called for every sample while the channel is not in reset.
    void record(std::function<void(const ControlSample&)> sink);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace cusp::comm
