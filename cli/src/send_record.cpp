// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Where the ledger lies, and what is written into it.
#include "send_record.hpp"

#include "console.hpp"

#include <cusp/base/hash.hpp>

#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <random>

namespace cusp::cli {

namespace {

/// The XDG base directory specification's place for what must outlive a program and is no configuration.
std::string stateFolder() {
    if (const char* state = std::getenv("XDG_STATE_HOME"); state != nullptr && *state == '/') return state;
    const char* home = std::getenv("HOME");
    return home == nullptr ? "" : std::string(home) + "/.local/state";
}

std::string randomTransfer() {
    std::random_device device;
    return fmt::format("{:08x}{:08x}", device(), device());
}

}  // namespace

std::string nowUtc() { return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr))); }

base::Result<SendRecord> SendRecord::begin(const SendFlags& flags, const comm::Program& program) {
    SendRecord out;
    if (flags.no_ledger) return out;
    out.path_ = flags.ledger;
    if (out.path_.empty()) {
        const std::filesystem::path folder = std::filesystem::path(stateFolder()) / "cusp";
        std::error_code ignored;
        std::filesystem::create_directories(folder, ignored);
        out.path_ = (folder / "transfers.sqlite").string();
    }
    auto ledger = comm::Ledger::open(out.path_);
    if (!ledger) return base::fail(std::move(ledger).error());
    out.ledger_ = *std::move(ledger);
    out.entry_ = {.number = 0,
                  .time_utc = nowUtc(),
                  .transfer = randomTransfer(),
                  .event = "begun",
                  .program = program.name,
                  .digest = base::sha256Hex(program.text),
                  .bytes = program.text.size(),
                  .machine = flags.control_label.empty() ? flags.machine : flags.control_label,
                  .operator_label = flags.operator_label,
                  .link = flags.to,
                  .detail = flags.drip ? "drip" : "",
                  .chain = ""};
    if (auto written = out.ledger_->append(out.entry_); !written) return base::fail(std::move(written).error());
    return out;
}

void SendRecord::end(const std::string& event, const std::string& detail) {
    if (!ledger_) return;
    entry_.time_utc = nowUtc();
    entry_.event = event;
    entry_.detail = detail;
    if (auto written = ledger_->append(entry_); !written) tell(written.error());
}

}  // namespace cusp::cli
