// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Queries checked, handed over, and answered by libmodbus from its mapping.
#include "modbus_server.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <poll.h>
#include <utility>

namespace cusp::comm {

namespace {
constexpr int mapped_registers = 0x0400;
constexpr std::size_t area_registers = 0x0100;
constexpr std::size_t tcp_header_bytes = 7;
constexpr std::size_t most_incoming_bytes = std::size_t{64} * 1024;
/// Of one client before the others have their turn.
constexpr int most_reads = 4;
}  // namespace

base::Result<ModbusResponder> ModbusResponder::make(ModbusContext context, RequestHandler& handler) {
    ModbusResponder out(std::move(context), handler);
    out.mapping_.reset(::modbus_mapping_new(0, 0, mapped_registers, 0));
    if (out.mapping_ == nullptr) return failOpen("modbus", errno);
    // Before some exceptions libmodbus sleeps for the response timeout; nobody else may wait for that.
    ::modbus_set_response_timeout(out.context_.get(), 0, 1);
    return out;
}

void ModbusResponder::refresh(std::uint16_t address, const Bytes& bytes) {
    const Registers registers = toRegisters(bytes);
    const std::size_t room = area_registers;
    std::fill_n(mapping_->tab_registers + address, room, std::uint16_t{0});
    std::copy_n(registers.begin(), std::min(room, registers.size()), mapping_->tab_registers + address);
}

bool ModbusResponder::answer(ByteView frame, std::size_t header, std::size_t trailer) {
    const ByteView pdu = frame.subspan(header, frame.size() - header - trailer);
    const ModbusQueryResult parsed = parseModbusQuery(pdu);
    if (parsed.fault != ModbusFault::None)
        return ::modbus_reply_exception(context_.get(), frame.data(), static_cast<unsigned>(parsed.fault)) > 0;
    if (!parsed.query.written.empty()) static_cast<void>(handler_->handle(toBytes(parsed.query.written)));
    if (parsed.query.read_count > 0) {
        const bool upload = parsed.query.read_address >= upload_register;
        refresh(upload ? upload_register : status_register,
                handler_->area(upload ? ReplyArea::Upload : ReplyArea::Status));
    }
    return ::modbus_reply(context_.get(), frame.data(), static_cast<int>(frame.size()), mapping_.get()) > 0;
}

ModbusTcpServer::ModbusTcpServer(Listening listening, ListenOptions options, ModbusResponder responder)
    : listening_(std::move(listening)), options_(std::move(options)), responder_(std::move(responder)) {
    const bool v6 = listening_.host.find(':') != std::string::npos;
    name_ = fmt::format("modbus-tcp://{}{}{}:{}", v6 ? "[" : "", listening_.host, v6 ? "]" : "", listening_.port);
}

base::Result<void> ModbusTcpServer::step(double timeout_s) {
    std::vector<pollfd> waiting{{listening_.socket.get(), POLLIN, 0}};
    for (const Client& client : clients_) waiting.push_back({client.descriptor.get(), POLLIN, 0});
    const double ms = std::clamp(timeout_s, 0.0, 3600.0) * 1000.0;
    static_cast<void>(::poll(waiting.data(), waiting.size(), static_cast<int>(ms)));
    while (auto client = acceptAllowed(listening_, options_)) {
        // Those that are gone already do not keep a new one out.
        if (clients_.size() >= options_.max_clients) serveAll();
        if (clients_.size() < options_.max_clients) clients_.push_back({*std::move(client), {}, steadySeconds()});
    }
    serveAll();
    // The descriptors are the clients': libmodbus would close the one it was lent.
    ::modbus_set_socket(responder_.context(), -1);
    return {};
}

void ModbusTcpServer::serveAll() {
    for (auto client = clients_.begin(); client != clients_.end();)
        client = serve(*client) ? std::next(client) : clients_.erase(client);
}

bool ModbusTcpServer::serve(Client& client) {
    const double now_s = steadySeconds();
    for (int reads = 0; reads < most_reads; ++reads) {
        const auto bytes = readSome(client.descriptor.get());
        if (!bytes) return false;
        if (bytes->empty()) break;
        client.seen_s = now_s;
        append(client.incoming, *bytes);
    }
    std::size_t used = 0;
    ::modbus_set_socket(responder_.context(), client.descriptor.get());
    while (const auto size = modbusTcpFrameBytes(ByteView(client.incoming).subspan(used))) {
        if (*size == 0) return false;
        // A client that does not fetch its replies fills its buffer: the reply fails, and the client goes.
        if (!responder_.answer(ByteView(client.incoming).subspan(used, *size), tcp_header_bytes, 0)) return false;
        used += *size;
    }
    client.incoming.erase(client.incoming.begin(), client.incoming.begin() + static_cast<std::ptrdiff_t>(used));
    return client.incoming.size() <= most_incoming_bytes && now_s - client.seen_s <= options_.idle_s;
}

ModbusRtuServer::ModbusRtuServer(ModbusResponder responder, LinkUrl url)
    : responder_(std::move(responder)), url_(std::move(url)) {
    // How long the rest of a frame may take once it has begun.
    ::modbus_set_byte_timeout(responder_.context(), 0, 100'000);
    ::modbus_set_indication_timeout(responder_.context(), 0, 100'000);
}

base::Result<void> ModbusRtuServer::step(double timeout_s) {
    modbus_t* const context = responder_.context();
    pollfd waiting{::modbus_get_socket(context), POLLIN, 0};
    const double ms = std::clamp(timeout_s, 0.0, 3600.0) * 1000.0;
    if (::poll(&waiting, 1, static_cast<int>(ms)) <= 0) return {};
    if ((waiting.revents & (POLLHUP | POLLERR | POLLNVAL)) != 0 && (waiting.revents & POLLIN) == 0)
        return base::fail("io.link-lost", "the serial device is gone", {url_.text, 0, 0, {}});
    std::array<std::uint8_t, MODBUS_RTU_MAX_ADU_LENGTH> frame{};
    const int size = ::modbus_receive(context, frame.data());
    // 0: for another unit; negative: noise or a broken frame, of which the client learns by its timeout.
    if (size < 0) ::modbus_flush(context);
    if (size < 4) return {};
    static_cast<void>(responder_.answer(ByteView(frame).first(static_cast<std::size_t>(size)), 1, 2));
    return {};
}

}  // namespace cusp::comm
