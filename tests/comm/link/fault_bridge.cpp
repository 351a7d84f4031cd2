// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Bytes carried between two descriptors, late, paced and damaged.
#include "fault_bridge.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <deque>
#include <fcntl.h>
#include <list>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <stdexcept>
#include <sys/socket.h>
#include <termios.h>
#include <unistd.h>
#include <vector>

namespace cusp::comm::test {

namespace {

void require(bool done) {
    if (!done) throw std::runtime_error("the bridge of the tests could not be set up");
}

double clockSeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// One direction between two descriptors.
class Lane {
public:
    Lane(int from, int to, BridgeFaults faults, base::Random random)
        : from_(from), to_(to), faults_(faults), random_(random) {}

    /// Reads what there is; false when the end it reads from has closed.
    bool take() {
        // What a line has not carried yet waits with the writer: this buffer is as small as a UART's.
        if (faults_.bytes_per_s > 0.0 && free_s_ > clockSeconds() + 0.002) return true;
        std::vector<std::uint8_t> bytes(faults_.bytes_per_s > 0.0 ? std::min<std::size_t>(faults_.piece_bytes, 64)
                                                                  : faults_.piece_bytes);
        const ssize_t count = ::read(from_, bytes.data(), bytes.size());
        if (count <= 0) return count < 0 && (errno == EAGAIN || errno == EINTR);
        bytes.resize(static_cast<std::size_t>(count));
        const double now_s = clockSeconds();
        free_s_ = std::max(free_s_, now_s);
        if (faults_.bytes_per_s > 0.0) free_s_ += static_cast<double>(count) / faults_.bytes_per_s;
        if (random_.chance(faults_.disconnect)) return false;
        if (random_.chance(faults_.loss)) return true;
        const int copies = random_.chance(faults_.duplication) ? 2 : 1;
        if (random_.chance(faults_.corruption)) {
            auto& byte = bytes[random_.below(bytes.size())];
            byte = static_cast<std::uint8_t>(byte ^ (1U << random_.below(8)));
        }
        for (int i = 0; i < copies; ++i) queue_.push_back({free_s_ + faults_.delay_s, bytes});
        taken_ += static_cast<std::size_t>(count);
        return true;
    }
    /// Writes what is due; false when the end it writes to has closed.
    bool give() {
        while (!queue_.empty() && queue_.front().due_s <= clockSeconds()) {
            auto& bytes = queue_.front().bytes;
            ssize_t count = ::send(to_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
            if (count < 0 && errno == ENOTSOCK) count = ::write(to_, bytes.data(), bytes.size());
            if (count < 0) return errno == EAGAIN || errno == EINTR;
            bytes.erase(bytes.begin(), bytes.begin() + count);
            if (bytes.empty()) queue_.pop_front();
        }
        return true;
    }
    double nextDueSeconds() const { return queue_.empty() ? clockSeconds() + 0.02 : queue_.front().due_s; }
    bool busyLine() const { return free_s_ > clockSeconds() + 0.002; }
    int from() const { return from_; }
    std::size_t taken() const { return taken_; }

private:
    struct Piece {
        double due_s;
        std::vector<std::uint8_t> bytes;
    };
    int from_;
    int to_;
    BridgeFaults faults_;
    base::Random random_;
    double free_s_ = 0.0;
    std::size_t taken_ = 0;  ///< bytes, without those that were lost on purpose
    std::deque<Piece> queue_;
};

timespec until(double seconds) {
    const double left_s = std::clamp(seconds - clockSeconds(), 0.0, 0.02);
    return {0, static_cast<long>(left_s * 1e9)};
}

void setNonBlocking(int descriptor) { ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) | O_NONBLOCK); }

void makeRaw(int descriptor) {
    termios settings{};
    ::tcgetattr(descriptor, &settings);
    ::cfmakeraw(&settings);
    ::tcsetattr(descriptor, TCSANOW, &settings);
}

sockaddr_in loopback(std::uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(port);
    return address;
}

}  // namespace

PtyBridge::PtyBridge(BridgeFaults faults, std::uint64_t seed) {
    for (int end = 0; end < 2; ++end) {
        masters_[end] = ::posix_openpt(O_RDWR | O_NOCTTY);
        require(masters_[end] >= 0);
        require(::grantpt(masters_[end]) == 0);
        require(::unlockpt(masters_[end]) == 0);
        char name[128] = {};
        require(::ptsname_r(masters_[end], name, sizeof name) == 0);
        paths_[end] = name;
        keepers_[end] = ::open(name, O_RDWR | O_NOCTTY);
        makeRaw(keepers_[end]);
        setNonBlocking(masters_[end]);
    }
    thread_ = std::thread([this, faults, seed] {
        Lane lanes[2] = {{masters_[0], masters_[1], faults, base::Random(seed).split(0)},
                         {masters_[1], masters_[0], faults, base::Random(seed).split(1)}};
        while (!stop_) {
            double due_s = clockSeconds() + 0.02;
            pollfd waiting[2];
            for (int i = 0; i < 2; ++i) {
                lanes[i].give();
                due_s = std::min(due_s, lanes[i].nextDueSeconds());
                if (lanes[i].busyLine()) due_s = std::min(due_s, clockSeconds() + 0.002);
                waiting[i] = {lanes[i].from(), static_cast<short>(lanes[i].busyLine() ? 0 : POLLIN), 0};
            }
            const timespec timeout = until(due_s);
            static_cast<void>(::ppoll(waiting, 2, &timeout, nullptr));
            for (Lane& lane : lanes) lane.take();
        }
    });
}

PtyBridge::~PtyBridge() {
    stop_ = true;
    thread_.join();
    for (int end = 0; end < 2; ++end) {
        ::close(keepers_[end]);
        ::close(masters_[end]);
    }
}

TcpBridge::TcpBridge(std::uint16_t target_port, BridgeFaults faults, std::uint64_t seed)
    : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = loopback(0);
    require(::bind(listener_, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0);
    require(::listen(listener_, 32) == 0);
    socklen_t size = sizeof address;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    thread_ = std::thread([this, target_port, faults, seed] { serve(target_port, faults, seed); });
}

TcpBridge::~TcpBridge() {
    stop_ = true;
    thread_.join();
    ::close(listener_);
}

void TcpBridge::serve(std::uint16_t target_port, BridgeFaults faults, std::uint64_t seed) {
    struct Pair {
        int ends[2];
        Lane out;
        Lane back;
    };
    std::list<Pair> pairs;
    base::Random random(seed);
    const sockaddr_in target = loopback(target_port);
    std::size_t carried = 0;
    const auto dead = [&] { return faults.dies_after_bytes > 0 && carried >= faults.dies_after_bytes; };
    while (!stop_ && !dead()) {
        std::vector<pollfd> waiting{{listener_, POLLIN, 0}};
        double due_s = clockSeconds() + 0.02;
        for (Pair& pair : pairs) {
            due_s = std::min({due_s, pair.out.nextDueSeconds(), pair.back.nextDueSeconds()});
            for (const int end : pair.ends) waiting.push_back({end, POLLIN, 0});
        }
        const timespec timeout = until(due_s);
        static_cast<void>(::ppoll(waiting.data(), waiting.size(), &timeout, nullptr));
        const int client = ::accept4(listener_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC);
        if (client >= 0) {
            const int server = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
            const int on = 1;
            static_cast<void>(::connect(server, reinterpret_cast<const sockaddr*>(&target), sizeof target));
            for (const int end : {client, server}) ::setsockopt(end, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
            setNonBlocking(server);
            pairs.push_back({{client, server},
                             {client, server, faults, random.split(2 * pairs.size())},
                             {server, client, faults, random.split((2 * pairs.size()) + 1)}});
            static_cast<void>(random.next());
        }
        for (auto pair = pairs.begin(); pair != pairs.end();) {
            const std::size_t before = pair->out.taken();
            const bool open = pair->out.take() && pair->back.take() && pair->out.give() && pair->back.give();
            carried += pair->out.taken() - before;
            if (!open) {
                for (const int end : pair->ends) ::close(end);
                pair = pairs.erase(pair);
            } else {
                ++pair;
            }
        }
    }
    for (const Pair& pair : pairs) {
        for (const int end : pair.ends) ::close(end);
    }
    if (dead()) ::shutdown(listener_, SHUT_RDWR);
}

}  // namespace cusp::comm::test
