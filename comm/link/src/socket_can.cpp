// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// SocketCAN: raw frames with our ISO-TP, or the kernel's.
#include "can_link.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/isotp.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace cusp::comm {

namespace {

constexpr std::int64_t default_send_id = 0x700;
constexpr std::int64_t default_receive_id = 0x701;

struct Identifiers {
    canid_t send = 0;
    canid_t receive = 0;
};

Identifiers identifiersOf(const LinkUrl& url, bool server) {
    const auto send = static_cast<canid_t>(url.number("send_id", default_send_id));
    const auto receive = static_cast<canid_t>(url.number("receive_id", default_receive_id));
    return server ? Identifiers{receive, send} : Identifiers{send, receive};
}

base::Result<sockaddr_can> addressOf(const LinkUrl& url) {
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(url.host.c_str()));
    if (address.can_ifindex == 0) return failOpen(url.text, ENODEV);
    return address;
}

base::Result<FileDescriptor> openSocket(const LinkUrl& url, int type, int protocol) {
    FileDescriptor socket(::socket(PF_CAN, type | SOCK_NONBLOCK | SOCK_CLOEXEC, protocol));
    if (!socket.open()) return failOpen(url.text, errno);
    return socket;
}

base::Result<void> bindTo(const FileDescriptor& socket, const sockaddr_can& address, const LinkUrl& url) {
    if (::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        return failOpen(url.text, errno);
    return {};
}

/// Our ISO-TP over raw frames.
class RawChannel : public CanChannel {
public:
    RawChannel(FileDescriptor socket, const LinkUrl& url, Identifiers identifiers, bool fd)
        : socket_(std::move(socket)), name_(url.text), identifiers_(identifiers), fd_(fd), endpoint_({.fd = fd}) {}

    bool ready() override { return endpoint_.ready(); }
    bool send(const Bytes& message) override { return endpoint_.send(message); }
    std::optional<Bytes> next() override { return endpoint_.next(); }
    base::Result<void> step(double timeout_s) override;

private:
    /// False: the transmit queue is full (ENOBUFS); the frame waits.
    [[nodiscard]] bool write(const CanPayload& payload) const;
    [[nodiscard]] base::Result<bool> readOne();

    FileDescriptor socket_;
    std::string name_;
    Identifiers identifiers_;
    bool fd_;
    IsoTpEndpoint endpoint_;
    std::optional<CanPayload> waiting_;
};

bool RawChannel::write(const CanPayload& payload) const {
    canfd_frame frame{};
    frame.can_id = identifiers_.send;
    frame.len = static_cast<std::uint8_t>(payload.size());
    frame.flags = fd_ ? CANFD_BRS : 0;
    std::copy(payload.begin(), payload.end(), std::begin(frame.data));
    const std::size_t size = fd_ ? CANFD_MTU : CAN_MTU;
    return ::write(socket_.get(), &frame, size) == static_cast<ssize_t>(size);
}

base::Result<bool> RawChannel::readOne() {
    canfd_frame frame{};
    const ssize_t size = ::read(socket_.get(), &frame, sizeof frame);
    if (size < 0 && (errno == EAGAIN || errno == EINTR)) return false;
    if (size < 0) return base::fail("io.link-lost", std::strerror(errno), {name_, 0, 0, {}});
    if (size != CAN_MTU && size != CANFD_MTU) return true;
    if ((frame.can_id & CAN_ERR_FLAG) != 0) {
        if ((frame.can_id & CAN_ERR_BUSOFF) != 0)
            return base::fail("io.link-lost", "the controller has gone off the bus (bus-off)", {name_, 0, 0, {}});
        return true;
    }
    endpoint_.receive(ByteView(std::begin(frame.data), std::min<std::size_t>(frame.len, sizeof frame.data)),
                      steadySeconds());
    return true;
}

base::Result<void> RawChannel::step(double timeout_s) {
    const double until_s = steadySeconds() + timeout_s;
    while (true) {
        bool moved = false;
        while (true) {
            const auto read = readOne();
            if (!read) return base::fail(read.error());
            if (!*read) break;
            moved = true;
        }
        if (!waiting_) waiting_ = endpoint_.poll(steadySeconds());
        const bool blocked = waiting_ && !write(*waiting_);
        if (waiting_ && !blocked) {
            waiting_.reset();
            moved = true;
        }
        const double now_s = steadySeconds();
        if (now_s >= until_s || (moved && !endpoint_.sending())) return {};
        if (moved && !blocked) continue;
        // A full queue tells nobody when it drains; a separation time ends by the clock.
        const double wake_s = blocked ? now_s + 0.001 : std::max(now_s, endpoint_.nextWakeSeconds());
        waitFor(socket_.get(), false, std::min(until_s, wake_s) - now_s);
    }
}

/// The kernel's ISO-TP. A write says nothing of whether the message arrived.
class KernelChannel : public CanChannel {
public:
    KernelChannel(FileDescriptor socket, const LinkUrl& url) : socket_(std::move(socket)), name_(url.text) {}

    bool ready() override {
        pollfd waiting{socket_.get(), POLLOUT, 0};
        return pending_.empty() && ::poll(&waiting, 1, 0) > 0 && (waiting.revents & POLLOUT) != 0;
    }
    bool send(const Bytes& message) override {
        if (!pending_.empty()) return false;
        pending_ = message;
        flush();
        return true;
    }
    std::optional<Bytes> next() override {
        if (received_.empty()) return std::nullopt;
        Bytes out = std::move(received_);
        received_.clear();
        return out;
    }
    base::Result<void> step(double timeout_s) override;

private:
    void flush() {
        if (pending_.empty()) return;
        const ssize_t size = ::write(socket_.get(), pending_.data(), pending_.size());
        // EAGAIN: one message is still going out. All else (no flow control came, bus error) loses this one.
        if (size >= 0 || errno != EAGAIN) pending_.clear();
    }

    FileDescriptor socket_;
    std::string name_;
    Bytes pending_;
    Bytes received_;
};

base::Result<void> KernelChannel::step(double timeout_s) {
    const double until_s = steadySeconds() + timeout_s;
    while (received_.empty()) {
        flush();
        Bytes buffer(IsoTpEndpoint::max_message_bytes + 1);
        const ssize_t size = ::read(socket_.get(), buffer.data(), buffer.size());
        if (size > 0) {
            buffer.resize(static_cast<std::size_t>(size));
            received_ = std::move(buffer);
            break;
        }
        // Timeouts of the protocol (ETIMEDOUT, ECOMM, EILSEQ …) cost a message; a missing interface ends the link.
        if (size < 0 && (errno == ENODEV || errno == ENETDOWN || errno == EBADF))
            return base::fail("io.link-lost", std::strerror(errno), {name_, 0, 0, {}});
        const double left_s = until_s - steadySeconds();
        if (left_s <= 0.0) break;
        waitFor(socket_.get(), false, pending_.empty() ? std::min(left_s, 0.02) : std::min(left_s, 0.001));
    }
    return {};
}

base::Result<std::unique_ptr<CanChannel>> openKernel(const LinkUrl& url, Identifiers identifiers, bool fd) {
    auto socket = openSocket(url, SOCK_DGRAM, CAN_ISOTP);
    if (!socket) return base::fail(std::move(socket).error());
    auto address = addressOf(url);
    if (!address) return base::fail(std::move(address).error());
    can_isotp_ll_options layer{};
    layer.mtu = fd ? CANFD_MTU : CAN_MTU;
    layer.tx_dl = fd ? CANFD_MAX_DLEN : CAN_MAX_DLEN;
    layer.tx_flags = fd ? CANFD_BRS : 0;
    if (::setsockopt(socket->get(), SOL_CAN_ISOTP, CAN_ISOTP_LL_OPTS, &layer, sizeof layer) != 0)
        return failOpen(url.text, errno);
    address->can_addr.tp.tx_id = identifiers.send;
    address->can_addr.tp.rx_id = identifiers.receive;
    if (auto bound = bindTo(*socket, *address, url); !bound) return base::fail(std::move(bound).error());
    return std::make_unique<KernelChannel>(*std::move(socket), url);
}

base::Result<std::unique_ptr<CanChannel>> openRaw(const LinkUrl& url, Identifiers identifiers, bool fd) {
    auto socket = openSocket(url, SOCK_RAW, CAN_RAW);
    if (!socket) return base::fail(std::move(socket).error());
    const auto address = addressOf(url);
    if (!address) return base::fail(address.error());
    const int on = 1;
    if (fd && ::setsockopt(socket->get(), SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) != 0)
        return failOpen(url.text, errno);
    const can_filter filter{identifiers.receive, CAN_SFF_MASK | CAN_EFF_FLAG | CAN_RTR_FLAG};
    ::setsockopt(socket->get(), SOL_CAN_RAW, CAN_RAW_FILTER, &filter, sizeof filter);
    const can_err_mask_t errors = CAN_ERR_BUSOFF;
    ::setsockopt(socket->get(), SOL_CAN_RAW, CAN_RAW_ERR_FILTER, &errors, sizeof errors);
    if (auto bound = bindTo(*socket, *address, url); !bound) return base::fail(std::move(bound).error());
    return std::make_unique<RawChannel>(*std::move(socket), url, identifiers, fd);
}

}  // namespace

base::Result<std::unique_ptr<CanChannel>> openCan(const LinkUrl& url, bool server) {
    const Identifiers identifiers = identifiersOf(url, server);
    const bool fd = url.number("fd", 0) != 0;
    const std::string transport = url.parameter("transport", "auto");
    if (transport != "own") {
        auto kernel = openKernel(url, identifiers, fd);
        if (kernel || transport == "kernel") return kernel;
    }
    return openRaw(url, identifiers, fd);
}

}  // namespace cusp::comm
