// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// What lies between the two ends of a real link in the tests: it paces bytes like a line, delays them, and does them harm.
#pragma once

#include <cusp/base/random.hpp>
#include <cusp/comm/link/bytes.hpp>

#include <atomic>
#include <cstdint>
#include <string>
#include <thread>

namespace cusp::comm::test {

struct BridgeFaults {
    double loss = 0.0;  ///< per piece of bytes that is read at once
    double duplication = 0.0;
    double corruption = 0.0;
    double disconnect = 0.0;   ///< TCP: both ends are closed instead
    double bytes_per_s = 0.0;  ///< 0: as fast as it goes
    double delay_s = 0.0;      ///< each way
    std::size_t piece_bytes = 4096;
    /// TCP: after so many bytes to the target everything is closed, and nobody is let through any more; 0: never.
    std::size_t dies_after_bytes = 0;
};

/// Two pseudo terminals, one for each end, and a thread that carries bytes between them.
class PtyBridge {
public:
    PtyBridge(BridgeFaults faults, std::uint64_t seed);
    ~PtyBridge();
    PtyBridge(const PtyBridge&) = delete;
    PtyBridge& operator=(const PtyBridge&) = delete;
    const std::string& left() const { return paths_[0]; }
    const std::string& right() const { return paths_[1]; }

private:
    int masters_[2];
    int keepers_[2];  ///< the slaves held open, so that an end that closes is no hangup
    std::string paths_[2];
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

/// Listens on a loopback port of its own and passes every connection on to `target_port`.
class TcpBridge {
public:
    TcpBridge(std::uint16_t target_port, BridgeFaults faults, std::uint64_t seed);
    ~TcpBridge();
    TcpBridge(const TcpBridge&) = delete;
    TcpBridge& operator=(const TcpBridge&) = delete;
    std::uint16_t port() const { return port_; }

private:
    void serve(std::uint16_t target_port, BridgeFaults faults, std::uint64_t seed);

    int listener_;
    std::uint16_t port_ = 0;
    std::atomic<bool> stop_{false};
    std::thread thread_;
};

}  // namespace cusp::comm::test
