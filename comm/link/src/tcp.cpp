// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// TCP sockets: connecting, listening on loopback unless told otherwise, and who may come in.
#include "file_descriptor.hpp"

#include <algorithm>
#include <arpa/inet.h>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <memory>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <cusp/base/number_text.hpp>

namespace cusp::comm {

namespace {

constexpr int connect_timeout_ms = 5000;

struct FreeAddresses {
    void operator()(addrinfo* addresses) const { ::freeaddrinfo(addresses); }
};
using Addresses = std::unique_ptr<addrinfo, FreeAddresses>;

base::Result<Addresses> resolve(const LinkUrl& url, bool passive) {
    addrinfo hints{};
    hints.ai_family = AF_UNSPEC;
    hints.ai_socktype = SOCK_STREAM;
    hints.ai_flags = AI_NUMERICSERV | (passive ? AI_PASSIVE : 0);
    addrinfo* found = nullptr;
    const int error = ::getaddrinfo(url.host.c_str(), std::to_string(url.port).c_str(), &hints, &found);
    if (error != 0)
        return base::fail("io.link-open", fmt::format("cannot open: {}", ::gai_strerror(error)), {url.text, 0, 0, {}});
    return Addresses(found);
}

void withoutDelay(int descriptor) {
    const int on = 1;
    ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

/// The address as 16 bytes, IPv4 mapped into IPv6.
using Address = std::array<std::uint8_t, 16>;

Address mapped(const in_addr& v4) {
    Address out{};
    out[10] = 0xFF;
    out[11] = 0xFF;
    std::memcpy(out.data() + 12, &v4, 4);
    return out;
}

Address addressOf(const sockaddr_storage& peer) {
    if (peer.ss_family == AF_INET) {
        sockaddr_in v4{};
        std::memcpy(&v4, &peer, sizeof v4);
        return mapped(v4.sin_addr);
    }
    sockaddr_in6 v6{};
    std::memcpy(&v6, &peer, sizeof v6);
    Address out{};
    std::memcpy(out.data(), &v6.sin6_addr, out.size());
    return out;
}

bool isLoopback(const Address& address) {
    Address v6{};
    v6[15] = 1;
    return address == v6 || (address[10] == 0xFF && address[11] == 0xFF && address[12] == 127);
}

struct AddressRange {
    Address address{};
    int bits = 128;
};

std::optional<AddressRange> parseRange(const std::string& text) {
    const std::size_t slash = text.find('/');
    const std::string host = text.substr(0, slash);
    AddressRange out;
    in_addr v4{};
    in6_addr v6{};
    int least_bits = 0;
    if (::inet_pton(AF_INET, host.c_str(), &v4) == 1) {
        out.address = mapped(v4);
        least_bits = 96;
    } else if (::inet_pton(AF_INET6, host.c_str(), &v6) == 1) {
        std::memcpy(out.address.data(), &v6, out.address.size());
    } else {
        return std::nullopt;
    }
    if (slash == std::string::npos) return out;
    const auto bits = base::parseInteger(std::string_view(text).substr(slash + 1));
    if (!bits || *bits < 0 || *bits > 128 - least_bits) return std::nullopt;
    out.bits = least_bits + static_cast<int>(*bits);
    return out;
}

bool holds(const AddressRange& range, const Address& address) {
    for (int bit = 0; bit < range.bits; ++bit) {
        const auto byte = static_cast<std::size_t>(bit / 8);
        const unsigned mask = 0x80U >> static_cast<unsigned>(bit % 8);
        if (((range.address[byte] ^ address[byte]) & mask) != 0) return false;
    }
    return true;
}

bool mayEnter(const Address& address, const ListenOptions& options) {
    if (isLoopback(address)) return true;
    return options.beyond_loopback && std::ranges::any_of(options.allowed, [&](const std::string& text) {
               const auto range = parseRange(text);
               return range && holds(*range, address);
           });
}

}  // namespace

base::Result<FileDescriptor> connectTcp(const LinkUrl& url) {
    auto addresses = resolve(url, false);
    if (!addresses) return base::fail(std::move(addresses).error());
    int error = EHOSTUNREACH;
    for (const addrinfo* address = addresses->get(); address != nullptr; address = address->ai_next) {
        FileDescriptor socket(::socket(address->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
        if (!socket.open()) continue;
        error = 0;
        if (::connect(socket.get(), address->ai_addr, address->ai_addrlen) != 0) {
            error = errno;
            pollfd waiting{socket.get(), POLLOUT, 0};
            if (error == EINPROGRESS) {
                socklen_t size = sizeof error;
                error = ETIMEDOUT;
                if (::poll(&waiting, 1, connect_timeout_ms) > 0)
                    ::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &error, &size);
            }
        }
        if (error != 0) continue;
        withoutDelay(socket.get());
        return socket;
    }
    return failOpen(url.text, error);
}

base::Result<void> checkAllowed(const ListenOptions& options) {
    for (const std::string& text : options.allowed) {
        if (!parseRange(text))
            return base::fail("link.allow", fmt::format("'{}' is no address: 192.168.0.17 or 192.168.0.0/24", text));
    }
    return {};
}

bool mayConnect(const std::string& numeric_address, const ListenOptions& options) {
    const auto address = parseRange(numeric_address);
    return address && address->bits == 128 && mayEnter(address->address, options);
}

namespace {

base::Result<Addresses> resolveListening(const LinkUrl& url, const ListenOptions& options) {
    if (auto checked = checkAllowed(options); !checked) return base::fail(std::move(checked).error());
    auto addresses = resolve(url, true);
    if (!addresses) return addresses;
    sockaddr_storage first{};
    std::memcpy(&first, (*addresses)->ai_addr, (*addresses)->ai_addrlen);
    if (!options.beyond_loopback && !isLoopback(addressOf(first)))
        return base::fail(
            "link.not-loopback",
            "is no loopback address; listening beyond this machine has to be asked for, with a list of who may connect",
            {url.text, 0, 0, {}});
    return addresses;
}

}  // namespace

base::Result<void> checkListening(const LinkUrl& url, const ListenOptions& options) {
    auto addresses = resolveListening(url, options);
    if (!addresses) return base::fail(std::move(addresses).error());
    return {};
}

base::Result<Listening> listenTcp(const LinkUrl& url, const ListenOptions& options) {
    auto addresses = resolveListening(url, options);
    if (!addresses) return base::fail(std::move(addresses).error());
    const addrinfo* address = addresses->get();
    sockaddr_storage bound{};
    Listening out;
    out.socket = FileDescriptor(::socket(address->ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
    if (!out.socket.open()) return failOpen(url.text, errno);
    const int on = 1;
    ::setsockopt(out.socket.get(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (::bind(out.socket.get(), address->ai_addr, address->ai_addrlen) != 0 ||
        ::listen(out.socket.get(), SOMAXCONN) != 0)
        return failOpen(url.text, errno);
    socklen_t size = sizeof bound;
    ::getsockname(out.socket.get(), reinterpret_cast<sockaddr*>(&bound), &size);
    std::array<char, NI_MAXHOST> host{};
    std::array<char, NI_MAXSERV> port{};
    ::getnameinfo(reinterpret_cast<const sockaddr*>(&bound), size, host.data(), host.size(), port.data(), port.size(),
                  NI_NUMERICHOST | NI_NUMERICSERV);
    out.host = host.data();
    out.port = static_cast<std::uint16_t>(base::parseInteger(port.data()).value_or(0));
    return out;
}

std::optional<FileDescriptor> acceptAllowed(const Listening& listening, const ListenOptions& options) {
    while (true) {
        sockaddr_storage peer{};
        socklen_t size = sizeof peer;
        FileDescriptor client(
            ::accept4(listening.socket.get(), reinterpret_cast<sockaddr*>(&peer), &size, SOCK_NONBLOCK | SOCK_CLOEXEC));
        if (!client.open()) return std::nullopt;
        if (!mayEnter(addressOf(peer), options)) continue;
        withoutDelay(client.get());
        return client;
    }
}

}  // namespace cusp::comm
