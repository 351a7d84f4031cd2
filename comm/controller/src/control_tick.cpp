// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// One tick: prepare, plan, move, and what happens at rest.
#include "control_state.hpp"

namespace cusp::comm {

namespace {

/// Planned motion that is always ahead: more would only delay what the override does.
constexpr double ahead_s = 0.5;
/// So late a plan is made with what there is.
constexpr double urgent_s = 0.05;
/// The tool has left the surface.
constexpr double lifted_mm = 0.01;

}  // namespace

bool VirtualControl::State::idle() const {
    if (resetting || stopping) return false;
    if (status.state != ChannelState::Active) return clock.atRest();
    return false;
}

double VirtualControl::State::wantedRate() const {
    const double planned = blocks_.empty() ? 1.0 : blocks_.front().planned_override;
    return std::min(1.0, status.override_share / planned);
}

void VirtualControl::State::tick() {
    status.time_s += options.tick_s;
    if (status.state == ChannelState::Active && !stopping && !resetting) {
        if (status.time_s >= dwell_until_s_) prepare();
        plan();
        clock.setRate(wantedRate());
    }
    move();
    follow();
    if (resetting && clock.atRest()) return finishReset();
    if (stopping && clock.atRest()) {
        stopping = false;
        interrupt("NC stop");
    }
    if (status.state != ChannelState::Active || !clock.empty() || planner_->waiting() > 0) return;
    if (status.time_s < dwell_until_s_) return;
    if (barrier_) {
        const Barrier passed = *barrier_;
        barrier_.reset();
        pass(passed);
    } else if (dry())
        starve();
}

void VirtualControl::State::plan() {
    if (clock.ramping()) return;
    while (planner_->ready() && clock.committed_s() < ahead_s) takePlan();
    if (planner_->ready() || !added_since_plan_) return;
    const bool late = clock.empty() ? dry() : clock.committed_s() < urgent_s;
    if (late) takePlan();
}

void VirtualControl::State::takePlan() {
    clock.take(planner_->plan());
    added_since_plan_ = false;
}

void VirtualControl::State::move() {
    const geometry::Vector3 before = status.tool.tip_mm;
    clock.step();
    if (clock.enteredRest()) {
        planner_->takeRest();
        if (feed.isFifo() && !in_contact_) {
            in_contact_ = true;
            contact_from_s_ = status.time_s;
        }
    }
    status.axes = clock.axes();
    status.tool = toolPath().placeOf(status.axes);
    status.feed_mm_per_s = (status.tool.tip_mm - before).norm() / options.tick_s;
}

void VirtualControl::State::follow() {
    const dynamics::MotionPiece* piece = clock.piece();
    while (!blocks_.empty() && (piece == nullptr ? planner_->waiting() == 0 : blocks_.front().id < piece->block)) {
        status.completed_line = blocks_.front().line;
        blocks_.pop_front();
    }
    if (piece != nullptr && !blocks_.empty()) {
        status.executing_line = blocks_.front().line;
        status.rapid = blocks_.front().rapid;
    }
    status.queued_blocks = blocks_.size();
    if (status.state == ChannelState::Active && !read_out_)
        status.least_queued_blocks = std::min(status.least_queued_blocks, status.queued_blocks);
    status.fifo_bytes = feed.filled();
    status.fifo_capacity = feed.isFifo() ? options.fifo_bytes : 0;
    status.planning = planner_->summary();
    if (sink && status.state != ChannelState::Reset)
        sink({status.time_s, status.axes, status.executing_line, status.tool});
    const bool lifting = barrier_ && barrier_->kind == Barrier::Kind::Starved;
    if (lifting && in_contact_ && (status.tool.tip_mm - contact_tip_mm_).norm() > lifted_mm) {
        in_contact_ = false;
        status.contact_s = status.time_s - contact_from_s_;
    } else if (!lifting && in_contact_ && !clock.empty() && clock.committed_s() > urgent_s)
        in_contact_ = false;  // the next blocks came in time
}

void VirtualControl::State::interrupt(std::string why) {
    status.state = ChannelState::Interrupted;
    status.waiting_for = std::move(why);
    clock.setRate(0.0);
}

void VirtualControl::State::pass(const Barrier& barrier) {
    switch (barrier.kind) {
        case Barrier::Kind::Event: return passEvent(barrier.event);
        case Barrier::Kind::SingleBlock: return interrupt("single block");
        case Barrier::Kind::Alarm:
            status.alarms.push_back(barrier.alarm);
            status.resume_line = status.completed_line + 1;
            needs_reset_ = true;
            return interrupt("");
        case Barrier::Kind::Starved:
            if (in_contact_) status.contact_s = status.time_s - contact_from_s_;
            in_contact_ = false;
            status.alarms.push_back({alarm::fifo_empty, status.resume_line - 1,
                                     "the reload FIFO is empty: the program came too slowly; the tool has lifted"});
            needs_reset_ = true;
            return interrupt("");
    }
}

void VirtualControl::State::passEvent(const RestEvent& event) {
    status.completed_line = std::max(status.completed_line, event.line);
    switch (event.kind) {
        case RestEvent::Kind::Dwell: dwell_until_s_ = status.time_s + event.seconds; return;
        case RestEvent::Kind::Stop: return interrupt("M0");
        case RestEvent::Kind::OptionalStop:
            if (optional_stop) interrupt("M1");
            return;
        case RestEvent::Kind::Placement:
            // The same axes are another tip with another tool: that is no motion.
            placement = event.placement;
            status.tool = toolPath().placeOf(status.axes);
            return;
        case RestEvent::Kind::End:
            run_.reset();
            newPlanner();
            status.state = ChannelState::Reset;
            status.finished = true;
            if (feed.isFifo()) chosen_ = false;
            return;
    }
}

/// The FIFO has run dry and everything known is done: a hold in contact is a dwell that marks the part, so the tool lifts.
void VirtualControl::State::starve() {
    ++status.starvations;
    status.resume_line = status.completed_line + 1;
    contact_tip_mm_ = status.tool.tip_mm;
    if (!in_contact_) contact_from_s_ = status.time_s;
    in_contact_ = true;
    const dynamics::ToolPosition from{status.tool.tip_mm, {status.axes[3], status.axes[4]}};
    dynamics::ToolPosition to = from;
    to.tip_mm += options.lift_mm * status.tool.axis;
    auto block = toolPath().line(from, to);
    const bool reachable = block && std::all_of(block->points.begin(), block->points.end(), [&](const auto& point) {
                               for (std::size_t i = 0; i < 3; ++i)
                                   if (machine.linearRange(i).excess(point.axes[i]) > 0.0) return false;
                               return true;
                           });
    const std::size_t completed = status.completed_line;
    if (reachable) addBlock(*std::move(block), completed);
    planner_->stop();
    barrier_ = Barrier{Barrier::Kind::Starved, {}, {}};
}

}  // namespace cusp::comm
