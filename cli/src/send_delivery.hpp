// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// The ways `cusp send` delivers: over a link, down a bare line, into a folder; and back. Each says its result.
#pragma once

#include "exit_code.hpp"

#include <cusp/comm/dnc/resume.hpp>
#include <cusp/comm/dnc/sender.hpp>
#include <cusp/comm/link/link_url.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cusp::cli {

struct SendFlags {
    std::string program;
    std::string to;
    std::string name;
    std::string fetch;
    std::string output;
    std::string machine;
    std::string setup;
    std::string monitor;
    std::string key_file;
    std::string preamble;
    std::string line_end = "keep";
    std::string operator_label;
    std::string control_label;
    std::string ledger;
    std::optional<std::uint32_t> resume_block;
    unsigned back_up_blocks = 3;
    double approach_mm = 10.0;
    bool drip = false;
    bool allow_slow_link = false;
    bool measure = false;
    bool compare = false;
    bool arm = false;
    bool start = false;
    bool plain = false;
    bool wait_for_xon = false;
    bool extcall = false;
    bool no_ledger = false;
    bool json = false;
};

/// "delivered", "refused", "aborted".
[[nodiscard]] std::string_view wordFor(comm::TransferEnd end);
/// Not 0.
[[nodiscard]] std::uint32_t randomClient();

[[nodiscard]] ExitCode sendOverLink(const SendFlags& flags, const comm::LinkUrl& url, const comm::Program& program,
                                    const comm::SenderOptions& options);
[[nodiscard]] ExitCode sendPlain(const SendFlags& flags, const comm::LinkUrl& url, const comm::Program& program);
[[nodiscard]] ExitCode deliverToFolder(const SendFlags& flags, const comm::LinkUrl& url, const comm::Program& program);
[[nodiscard]] ExitCode fetchProgram(const SendFlags& flags, const comm::LinkUrl& url);

}  // namespace cusp::cli
