// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The virtual control as what stands behind a DNC receiver: its program memory, its FIFO, its state.
#pragma once

#include <cusp/comm/controller/virtual_control.hpp>
#include <cusp/comm/dnc/receiver.hpp>

#include <map>
#include <optional>
#include <string>

namespace cusp::comm {

struct ControlHostOptions {
    /// Not empty: every accepted program is kept there as NAME.MPF, byte for byte. The folder must exist.
    std::string store_folder{};
    std::size_t memory_bytes = std::size_t{256} << 20U;
};

/// One thread, that of the control.
class ControlHost : public ReceiverHost {
public:
    /// The control must outlive the host.
    ControlHost(VirtualControl& control, ControlHostOptions options)
        : control_(control), options_(std::move(options)) {}

    [[nodiscard]] OpenAnswer open(const ProgramHeader& header) override;
    [[nodiscard]] std::uint32_t freeBytes() const override;
    [[nodiscard]] bool accept(ByteView bytes) override;
    [[nodiscard]] Reason commit() override;
    void abandon(bool keep) override;
    [[nodiscard]] Reason arm() override;
    [[nodiscard]] Reason start() override;
    [[nodiscard]] Reason select(std::string_view name) override;
    [[nodiscard]] std::uint32_t selectedLength() const override;
    [[nodiscard]] std::size_t read(std::uint32_t offset, std::span<std::uint8_t> out) const override;
    [[nodiscard]] MachineStatus status() const override;

    /// Tells the receiver what became of the program it started. Call it after every `advance` of the control.
    void follow(Receiver& receiver);
    /// Why the store did not take the last program; empty when it did.
    [[nodiscard]] const std::string& storeProblem() const { return store_problem_; }

private:
    struct Kept {
        Digest digest{};
        std::uint32_t length = 0;
        std::string text;
    };
    VirtualControl& control_;
    ControlHostOptions options_;
    ProgramHeader header_;
    std::string text_;  ///< of the transfer under way, or the last one
    std::optional<Kept> kept_;
    std::map<std::string, std::string> memory_;
    std::string selected_;
    std::string store_problem_;
    bool started_ = false;
};

/// "P.MPF" for "P.MPF", "p.mpf" and "P".
[[nodiscard]] std::string storedName(const std::string& program);

}  // namespace cusp::comm
