// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Blocks of an 840D program: numbers, words, and what the control knows already and need not be told again.
#pragma once

#include "fixed_number.hpp"

#include <cusp/post/control/control_definition.hpp>
#include <cusp/post/writer/nc_program.hpp>
#include <cusp/post/writer/sinumerik_writer.hpp>

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cusp::post {

/// 840D strings and comments take printable ASCII, and are cut well before the end of a block; a double quote would end a
/// string.
[[nodiscard]] std::string printableText(std::string_view text);

class BlockWriter {
public:
    /// `control` must outlive this.
    BlockWriter(TextSink out, const ControlDefinition& control, std::vector<std::string> rotary_names,
                BlockListener listener);

    // --- text ---
    void open() {
        if (control_.block_number_step > 0) {
            number_ += control_.block_number_step;
            if (number_ > control_.block_number_max) number_ = control_.block_number_step;
            buffer_ += 'N';
            appendFixed(buffer_, number_, 0);
        }
        first_word_ = buffer_.size();
    }
    void word(std::string_view text) {
        if (!buffer_.empty() && buffer_.back() != '\n') buffer_ += ' ';
        buffer_ += text;
    }
    /// An address of several letters, or one that ends in a digit, needs "=" before its value (PM12).
    void value(std::string_view address, std::int64_t fixed, int decimals) {
        word(address);
        if (address.size() > 1) buffer_ += '=';
        appendFixed(buffer_, fixed, decimals);
    }
    void close();
    /// Closes the block, or takes it back when it holds no word.
    void closeOrDrop();
    void block(std::string_view text) {
        open();
        word(text);
        close();
    }
    void comment(std::string_view text);
    void flush();

    // --- modal words: nothing when the control knows ---
    void motionCode(int code) {
        if (motion_code_ == code) return;
        motion_code_ = code;
        static constexpr std::array<std::string_view, 4> names{"G0", "G1", "G2", "G3"};
        word(names[static_cast<std::size_t>(code)]);
    }
    void linear(std::size_t axis, double mm) {
        static constexpr std::array<std::string_view, 3> names{"X", "Y", "Z"};
        const std::int64_t fixed = toFixed(mm, linear_decimals_);
        if (linear_[axis] == fixed) return;
        linear_[axis] = fixed;
        value(names[axis], fixed, linear_decimals_);
    }
    void points(const geometry::Vector3& point_mm) {
        for (std::size_t axis = 0; axis < 3; ++axis) linear(axis, point_mm[static_cast<Eigen::Index>(axis)]);
    }
    void rotary(const RotaryValues& rotary_rad);
    /// A component left out would be 0, so a direction is told whole.
    void vector(const geometry::Vector3& axis);
    void feedMode(std::string_view mode);
    void feed(const toolpath::FeedRate& rate);
    /// Under G93 every block has its own F; six digits of it hold the feed to a millionth.
    void inverseTime(double per_min);
    void speed(double rpm);
    void coordinate(std::string_view address, double mm) {
        value(address, toFixed(mm, linear_decimals_), linear_decimals_);
    }

    void forgetLinear(std::size_t axis) { linear_[axis].reset(); }
    void forgetLinear() { linear_ = {}; }
    void forgetMotionCode() { motion_code_.reset(); }
    void forgetFeed() {
        feed_mode_ = {};
        feed_.reset();
    }
    /// After anything that moves the axes in another frame.
    void forgetPosition();

    [[nodiscard]] const std::vector<std::string>& rotaryNames() const { return rotary_names_; }
    [[nodiscard]] int linearDecimals() const { return linear_decimals_; }
    [[nodiscard]] int rotaryDecimals() const { return rotary_decimals_; }
    [[nodiscard]] std::size_t size() const { return buffer_.size(); }
    [[nodiscard]] std::size_t blocks() const { return blocks_; }
    void setClLine(std::uint32_t line) { cl_line_ = line; }

private:
    TextSink out_;
    const ControlDefinition& control_;
    std::vector<std::string> rotary_names_;
    BlockListener listener_;
    int linear_decimals_ = 5;
    int rotary_decimals_ = 5;
    int vector_decimals_ = 6;

    std::string buffer_;
    std::size_t first_word_ = 0;  ///< where the words of the open block begin
    std::size_t blocks_ = 0;
    std::size_t lines_ = 0;
    std::int64_t number_ = 0;
    std::uint32_t cl_line_ = 0;

    // What the control knows, in print.
    std::array<std::optional<std::int64_t>, 3> linear_;
    std::array<std::optional<std::int64_t>, 2> rotary_;
    std::optional<std::array<std::int64_t, 3>> vector_;
    std::optional<std::int64_t> feed_;
    std::string_view feed_mode_;  ///< G93, G94, G95
    std::optional<int> motion_code_;
};

}  // namespace cusp::post
