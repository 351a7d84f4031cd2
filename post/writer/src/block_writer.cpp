// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What of a block is not on the fast way of a move.
#include "block_writer.hpp"

#include <cusp/base/units.hpp>

#include <algorithm>
#include <cmath>

namespace cusp::post {

using toolpath::FeedRate;

namespace {

constexpr std::size_t flush_bytes = 1U << 16U;
// An 840D block holds 512 characters; comments and messages are cut well before.
constexpr std::size_t text_limit = 120;
// Six digits of a feed or speed hold it to a millionth.
constexpr int digits_kept = 6;

/// As many decimals as asked for, or as many as a small value needs not to be rounded away.
int decimalsFor(double value, int asked) {
    constexpr double enough = 100.0;  // units of the last decimal: half of one is 0.5 %
    int decimals = asked;
    while (decimals < digits_kept && value * powers_of_ten[static_cast<std::size_t>(decimals)] < enough) ++decimals;
    return decimals;
}

}  // namespace

std::string printableText(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (out.size() == text_limit) break;
        const bool plain = c >= ' ' && c <= '~' && c != '"';
        out.push_back(plain ? c : '_');
    }
    return out;
}

BlockWriter::BlockWriter(TextSink out, const ControlDefinition& control, std::vector<std::string> rotary_names,
                         BlockListener listener)
    : out_(std::move(out)),
      control_(control),
      rotary_names_(std::move(rotary_names)),
      listener_(std::move(listener)),
      linear_decimals_(static_cast<int>(control.format.linear_decimals)),
      rotary_decimals_(static_cast<int>(control.format.rotary_decimals)),
      vector_decimals_(static_cast<int>(control.format.vector_decimals)) {}

void BlockWriter::close() {
    buffer_ += '\n';
    ++blocks_;
    ++lines_;
    if (listener_) listener_({control_.block_number_step > 0 ? number_ : 0, lines_, cl_line_});
    if (buffer_.size() >= flush_bytes) flush();
}

void BlockWriter::closeOrDrop() {
    if (buffer_.size() > first_word_) return close();
    const std::size_t line = buffer_.rfind('\n');
    buffer_.erase(line == std::string::npos ? 0 : line + 1);
    // The next block takes the number.
    number_ -= control_.block_number_step;
}

void BlockWriter::comment(std::string_view text) {
    buffer_ += "; " + printableText(text) + '\n';
    ++lines_;
}

void BlockWriter::flush() {
    out_(buffer_);
    buffer_.clear();
}

void BlockWriter::rotary(const RotaryValues& rotary_rad) {
    for (std::size_t i = 0; i < rotary_names_.size(); ++i) {
        const std::int64_t fixed = toFixed(base::degFromRad(rotary_rad[i]), rotary_decimals_);
        if (rotary_[i] == fixed) continue;
        rotary_[i] = fixed;
        value(rotary_names_[i], fixed, rotary_decimals_);
    }
}

void BlockWriter::vector(const geometry::Vector3& axis) {
    const std::array<std::int64_t, 3> fixed{toFixed(axis.x(), vector_decimals_), toFixed(axis.y(), vector_decimals_),
                                            toFixed(axis.z(), vector_decimals_)};
    if (vector_ == fixed) return;
    vector_ = fixed;
    static constexpr std::array<std::string_view, 3> names{"A3", "B3", "C3"};
    for (std::size_t i = 0; i < fixed.size(); ++i) value(names[i], fixed[i], vector_decimals_);
}

/// Another kind of feed makes the old F meaningless.
void BlockWriter::feedMode(std::string_view mode) {
    if (feed_mode_ == mode) return;
    feed_mode_ = mode;
    feed_.reset();
    word(mode);
}

void BlockWriter::feed(const FeedRate& rate) {
    const double written = rate.unit == FeedRate::Unit::MmPerRev ? rate.value : base::mmPerMinFromMmPerS(rate.value);
    const int decimals = decimalsFor(written, static_cast<int>(control_.format.feed_decimals));
    // Compared at the finest, so that two feeds that print the same are the same.
    const std::int64_t finest =
        toFixed(written, decimals) * static_cast<std::int64_t>(powers_of_ten[static_cast<std::size_t>(9 - decimals)]);
    if (feed_ == finest) return;
    feed_ = finest;
    value("F", toFixed(written, decimals), decimals);
}

void BlockWriter::inverseTime(double per_min) {
    const int whole = static_cast<int>(std::ceil(std::log10(per_min)));
    const int decimals = std::clamp(digits_kept - whole, 0, 9);
    feed_.reset();
    value("F", toFixed(per_min, decimals), decimals);
}

void BlockWriter::speed(double rpm) {
    const int decimals = decimalsFor(rpm, static_cast<int>(control_.format.speed_decimals));
    value("S", toFixed(rpm, decimals), decimals);
}

void BlockWriter::forgetPosition() {
    linear_ = {};
    rotary_ = {};
    vector_.reset();
    motion_code_.reset();
}

}  // namespace cusp::post
