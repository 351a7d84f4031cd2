// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// A control of the tests' own behind the receiver: a program store in memory, and a FIFO whose lines it "runs".
#pragma once

#include <cusp/comm/dnc/receiver.hpp>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cusp::comm::test {

class MemoryHost : public ReceiverHost {
public:
    OpenAnswer open(const ProgramHeader& header) override {
        ++opens;
        if (refuse_with != Reason::None) return {refuse_with, 0};
        const bool same = partial_of && partial_of->digest == header.digest && partial_of->length == header.length;
        if (!same || header.mode == TransferMode::Drip) partial.clear();
        partial_of = header;
        fifo.clear();
        return {Reason::None, static_cast<std::uint32_t>(partial.size())};
    }
    std::uint32_t freeBytes() const override {
        const bool drip = partial_of && partial_of->mode == TransferMode::Drip;
        const std::size_t used = drip ? fifo.size() : partial.size();
        const std::size_t limit = drip ? fifo_bytes : store_bytes;
        return static_cast<std::uint32_t>(limit > used ? limit - used : 0);
    }
    bool accept(ByteView bytes) override {
        if (bytes.size() > freeBytes()) overfilled = true;
        partial += textOf(bytes);
        if (partial_of->mode == TransferMode::Drip) {
            fifo += textOf(bytes);
            if (!textOf(bytes).ends_with('\n') && partial.size() != partial_of->length) broken_line = true;
        }
        return storage_works;
    }
    Reason commit() override {
        programs[partial_of->name] = partial;
        ++commits;
        return Reason::None;
    }
    void abandon(bool keep) override {
        ++abandons;
        if (!keep) partial.clear();
    }
    Reason arm() override { return Reason::None; }
    Reason start() override {
        ++starts;
        return Reason::None;
    }
    Reason select(std::string_view name) override {
        if (!name.empty() && !programs.contains(std::string(name))) return Reason::NotFound;
        selected = name;
        return Reason::None;
    }
    std::uint32_t selectedLength() const override { return static_cast<std::uint32_t>(selectedText().size()); }
    std::size_t read(std::uint32_t offset, std::span<std::uint8_t> out) const override {
        const std::string& text = selectedText();
        if (offset >= text.size()) return 0;
        const std::size_t count = std::min(out.size(), text.size() - offset);
        std::copy_n(text.begin() + offset, count, out.begin());
        return count;
    }
    MachineStatus status() const override { return machine; }

    /// Takes the next whole line out of the FIFO; nothing when there is none.
    std::optional<std::string> runLine() {
        const auto end = fifo.find('\n');
        const bool last_line = end == std::string::npos && !fifo.empty() && partial.size() == partial_of->length;
        if (end == std::string::npos && !last_line) return std::nullopt;
        std::string line = fifo.substr(0, last_line ? fifo.size() : end + 1);
        fifo.erase(0, line.size());
        executed += line;
        return line;
    }

    std::map<std::string, std::string> programs;
    std::optional<ProgramHeader> partial_of;
    std::string partial;   ///< all that was accepted of the present transfer
    std::string fifo;      ///< drip mode: accepted and not yet run
    std::string executed;  ///< drip mode
    std::string selected;
    MachineStatus machine;
    Reason refuse_with = Reason::None;
    std::size_t store_bytes = 1U << 20U;
    std::size_t fifo_bytes = 30 * 1024;
    bool storage_works = true;
    bool overfilled = false;
    bool broken_line = false;
    int opens = 0;
    int commits = 0;
    int abandons = 0;
    int starts = 0;

private:
    const std::string& selectedText() const {
        const auto found = programs.find(selected);
        return selected.empty() || found == programs.end() ? partial : found->second;
    }
};

}  // namespace cusp::comm::test
