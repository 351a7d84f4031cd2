// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The text of a program on its way to the reader: from program memory, or through the reload FIFO.
#pragma once

#include <cstddef>
#include <istream>
#include <memory>
#include <streambuf>
#include <string>
#include <string_view>

namespace cusp::comm {

/// Gives out one line, then is at its end until the next. Cannot be read twice, as a FIFO cannot.
class LineBuffer : public std::streambuf {
public:
    void set(std::string line) {
        line_ = std::move(line);
        setg(line_.data(), line_.data(), line_.data() + line_.size());
    }

private:
    std::string line_;
};

class ProgramFeed {
public:
    /// Program memory.
    void open(std::string text);
    /// The FIFO.
    void openFifo(std::size_t capacity);

    [[nodiscard]] bool isFifo() const { return fifo_open_; }
    [[nodiscard]] std::size_t free() const { return fifo_open_ ? capacity_ - fifo_.size() : 0; }
    [[nodiscard]] std::size_t filled() const { return fifo_.size(); }
    [[nodiscard]] bool put(std::string_view lines);
    void end() { ended_ = true; }
    [[nodiscard]] bool ended() const { return ended_; }
    void empty() { fifo_.clear(); }

    /// What the reader reads from.
    [[nodiscard]] std::istream& stream();
    /// Makes the next line readable. False when the FIFO has no whole one: wait, or, after `end`, there is none.
    [[nodiscard]] bool offerLine();

private:
    std::unique_ptr<std::istream> memory_;
    LineBuffer line_;
    std::unique_ptr<std::istream> lines_;
    std::string fifo_;
    std::size_t capacity_ = 0;
    bool fifo_open_ = false;
    bool ended_ = false;
};

}  // namespace cusp::comm
