// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Bytes of programs into memory, folder and FIFO; the control's state in the protocol's numbers.
#include <cusp/comm/controller/control_host.hpp>

#include <cusp/base/atomic_file.hpp>
#include <cusp/base/diagnostics.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cusp::comm {

namespace {

/// The protocol's units: 0.1 µm and 1e-4 degree.
constexpr double units_per_mm = 1e4;
constexpr double units_per_rad = 1e4 * 180.0 / std::numbers::pi;

template <class Number>
Number clamped(double value) {
    return static_cast<Number>(std::clamp(value, static_cast<double>(std::numeric_limits<Number>::min()),
                                          static_cast<double>(std::numeric_limits<Number>::max())));
}

}  // namespace

std::string storedName(const std::string& program) {
    const std::size_t dot = program.rfind('.');
    std::string extension = dot == std::string::npos ? std::string() : program.substr(dot);
    for (char& letter : extension)
        if (letter >= 'a' && letter <= 'z') letter = static_cast<char>(letter - 'a' + 'A');
    return extension == ".MPF" ? program.substr(0, dot) + ".MPF" : program + ".MPF";
}

OpenAnswer ControlHost::open(const ProgramHeader& header) {
    const bool drip = header.mode == TransferMode::Drip;
    if (drip && !control_.selectFifo(header.name)) return {Reason::Busy, 0};
    header_ = header;
    text_.clear();
    started_ = false;
    if (!drip && kept_ && kept_->digest == header.digest && kept_->length == header.length) text_ = kept_->text;
    kept_.reset();
    return {Reason::None, static_cast<std::uint32_t>(text_.size())};
}

std::uint32_t ControlHost::freeBytes() const {
    const std::size_t room = options_.memory_bytes - std::min(options_.memory_bytes, text_.size());
    const bool drip = header_.mode == TransferMode::Drip;
    return clamped<std::uint32_t>(static_cast<double>(drip ? control_.fifoFree() : room));
}

bool ControlHost::accept(ByteView bytes) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());  // NOLINT: bytes are text
    if (header_.mode == TransferMode::Drip && !control_.feed(text)) return false;
    text_ += text;
    return true;
}

Reason ControlHost::commit() {
    if (header_.mode == TransferMode::Drip) control_.endFeed();
    store_problem_.clear();
    if (!options_.store_folder.empty()) {
        const auto done = base::writeWholeFile(options_.store_folder + "/" + storedName(header_.name), text_);
        if (!done) {
            store_problem_ = base::toText(done.error());
            return Reason::Storage;
        }
    }
    if (header_.mode == TransferMode::Store) memory_[header_.name] = text_;
    return Reason::None;
}

void ControlHost::abandon(bool keep) {
    if (header_.mode == TransferMode::Drip) return control_.endFeed();
    if (keep) kept_ = Kept{header_.digest, header_.length, text_};
}

Reason ControlHost::arm() {
    if (header_.mode == TransferMode::Drip) return Reason::None;
    return control_.select(header_.name, text_) ? Reason::None : Reason::Busy;
}

Reason ControlHost::start() {
    if (!control_.start()) return Reason::Refused;
    started_ = true;
    return Reason::None;
}

Reason ControlHost::select(std::string_view name) {
    if (name.empty()) {
        selected_ = text_;
        return Reason::None;
    }
    const auto found = memory_.find(std::string(name));
    if (found == memory_.end()) return Reason::NotFound;
    selected_ = found->second;
    return Reason::None;
}

std::uint32_t ControlHost::selectedLength() const { return static_cast<std::uint32_t>(selected_.size()); }

std::size_t ControlHost::read(std::uint32_t offset, std::span<std::uint8_t> out) const {
    if (offset >= selected_.size()) return 0;
    const std::size_t count = std::min(out.size(), selected_.size() - offset);
    std::copy_n(selected_.begin() + static_cast<std::ptrdiff_t>(offset), count, out.begin());
    return count;
}

MachineStatus ControlHost::status() const {
    const ControlStatus& now = control_.status();
    MachineStatus out;
    if (!now.alarms.empty()) out.alarm = static_cast<std::uint32_t>(now.alarms.back().number);
    out.executing_block = clamped<std::uint32_t>(static_cast<double>(now.executing_line));
    out.completed_block = clamped<std::uint32_t>(static_cast<double>(now.completed_line));
    out.queued_blocks = clamped<std::uint16_t>(static_cast<double>(now.queued_blocks));
    out.least_queued_blocks = clamped<std::uint16_t>(static_cast<double>(now.least_queued_blocks));
    out.starvations = clamped<std::uint16_t>(static_cast<double>(now.starvations));
    out.override_permille = clamped<std::uint16_t>(std::round(now.override_share * 1000.0));
    out.heartbeat = static_cast<std::uint16_t>(static_cast<std::uint64_t>(now.time_s * 10.0) & 0xFFFFU);
    out.axis_count = static_cast<std::uint16_t>(now.axes.size());
    for (std::size_t i = 0; i < now.axes.size(); ++i)
        out.axes[i] = clamped<std::int32_t>(std::round(now.axes[i] * (i < 3 ? units_per_mm : units_per_rad)));
    out.resume_block = clamped<std::uint32_t>(static_cast<double>(now.resume_line));
    out.contact_ms = clamped<std::uint32_t>(std::round(now.contact_s * 1000.0));
    return out;
}

void ControlHost::follow(Receiver& receiver) {
    if (!started_) return;
    const ControlStatus& now = control_.status();
    if (now.finished) {
        started_ = false;
        receiver.programFinished();
    } else if (now.state == ChannelState::Reset || !now.alarms.empty()) {
        started_ = false;
        receiver.programInterrupted();
    }
}

}  // namespace cusp::comm
