// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// From a URL to the transport it names.
#include <cusp/comm/link/transports.hpp>

#include "can_link.hpp"
#include "modbus_server.hpp"
#include "stream_link.hpp"

#include <cerrno>

namespace cusp::comm {

namespace {

constexpr const char* file_is_no_link = "is a folder to deliver to, no link";

double serialBytesPerSecond(const LinkUrl& url) {
    const double bits = url.parameter("parity", "N") == "N" ? 10.0 : 11.0;
    return static_cast<double>(url.number("baud", 115200)) / bits;
}

base::Result<std::unique_ptr<LinkServer>> serveModbus(const LinkUrl& url, RequestHandler& handler,
                                                      const ListenOptions& options) {
    auto context = makeModbus(url);
    if (!context) return base::fail(std::move(context).error());
    if (url.kind == LinkKind::ModbusRtu && !connectModbus(context->get())) return failOpen(url.text, errno);
    auto responder = ModbusResponder::make(*std::move(context), handler);
    if (!responder) return base::fail(std::move(responder).error());
    if (url.kind == LinkKind::ModbusRtu) return std::make_unique<ModbusRtuServer>(*std::move(responder), url);
    auto listening = listenTcp(url, options);
    if (!listening) return base::fail(std::move(listening).error());
    return std::make_unique<ModbusTcpServer>(*std::move(listening), options, *std::move(responder));
}

}  // namespace

base::Result<std::unique_ptr<Link>> openLink(const LinkUrl& url) {
    switch (url.kind) {
        case LinkKind::Tcp:
        case LinkKind::Serial: {
            const bool tcp = url.kind == LinkKind::Tcp;
            auto descriptor = tcp ? connectTcp(url) : openSerial(url);
            if (!descriptor) return base::fail(std::move(descriptor).error());
            return std::make_unique<StreamLink>(*std::move(descriptor), url, tcp ? 0.0 : serialBytesPerSecond(url));
        }
        case LinkKind::ModbusTcp:
        case LinkKind::ModbusRtu: return ModbusLink::open(url);
        case LinkKind::Can: {
            auto channel = openCan(url, false);
            if (!channel) return base::fail(std::move(channel).error());
            return std::make_unique<CanLink>(*std::move(channel), url);
        }
        case LinkKind::File: break;
    }
    return base::fail("link.url", file_is_no_link, {url.text, 0, 0, {}});
}

base::Result<std::unique_ptr<LinkServer>> openServer(const LinkUrl& url, RequestHandler& handler,
                                                     const ListenOptions& options) {
    switch (url.kind) {
        case LinkKind::Tcp: {
            auto listening = listenTcp(url, options);
            if (!listening) return base::fail(std::move(listening).error());
            return std::make_unique<StreamServer>(*std::move(listening), options, handler);
        }
        case LinkKind::Serial: {
            auto device = openSerial(url);
            if (!device) return base::fail(std::move(device).error());
            return std::make_unique<StreamServer>(*std::move(device), url, handler);
        }
        case LinkKind::ModbusTcp:
        case LinkKind::ModbusRtu: return serveModbus(url, handler, options);
        case LinkKind::Can: {
            auto channel = openCan(url, true);
            if (!channel) return base::fail(std::move(channel).error());
            return std::make_unique<CanServer>(*std::move(channel), url, handler);
        }
        case LinkKind::File: break;
    }
    return base::fail("link.url", file_is_no_link, {url.text, 0, 0, {}});
}

}  // namespace cusp::comm
