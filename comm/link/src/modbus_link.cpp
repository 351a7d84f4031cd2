// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Transactions of libmodbus in threads of their own: function 23 over TCP, 16 and 3 over a serial line.
#include "modbus_link.hpp"

#include <cerrno>
#include <chrono>
#include <sys/select.h>

namespace cusp::comm {

namespace {
constexpr unsigned reconnect_tries = 5;
constexpr int default_timeout_ms = 500;
/// On a serial line a reply takes the line's time away from the next request.
constexpr std::size_t serial_reply_every = 8;
}  // namespace

void FreeModbus::operator()(modbus_t* context) const {
    ::modbus_close(context);
    ::modbus_free(context);
}

base::Result<ModbusContext> makeModbus(const LinkUrl& url) {
    ModbusContext context;
    if (url.kind == LinkKind::ModbusTcp) {
        context.reset(::modbus_new_tcp_pi(url.host.c_str(), std::to_string(url.port).c_str()));
    } else {
        // The standard's own default is even parity (Modbus over serial line V1.02, 2.5.1).
        const char parity = url.parameter("parity", "E")[0];
        context.reset(::modbus_new_rtu(url.path.c_str(), static_cast<int>(url.number("baud", 115200)), parity, 8, 1));
    }
    if (context == nullptr) return failOpen(url.text, errno);
    ::modbus_set_slave(context.get(), static_cast<int>(url.number("unit", 1)));
    const auto timeout_ms = static_cast<std::uint32_t>(url.number("timeout_ms", default_timeout_ms));
    ::modbus_set_response_timeout(context.get(), timeout_ms / 1000, (timeout_ms % 1000) * 1000);
    return context;
}

bool connectModbus(modbus_t* context) {
    if (::modbus_connect(context) != 0) return false;
    if (::modbus_get_socket(context) < FD_SETSIZE) return true;
    ::modbus_close(context);
    errno = EMFILE;
    return false;
}

base::Result<std::unique_ptr<ModbusLink>> ModbusLink::open(const LinkUrl& url) {
    std::unique_ptr<ModbusLink> link(new ModbusLink(url));
    const std::int64_t connections = url.kind == LinkKind::ModbusTcp ? url.number("connections", 8) : 1;
    for (std::int64_t i = 0; i < connections; ++i) {
        auto context = makeModbus(url);
        if (!context) return base::fail(std::move(context).error());
        if (!connectModbus(context->get())) return failOpen(url.text, errno);
        link->contexts_.push_back(*std::move(context));
    }
    for (const ModbusContext& context : link->contexts_)
        link->workers_.emplace_back([raw = link.get(), one = context.get()] { raw->work(one); });
    return link;
}

ModbusLink::~ModbusLink() {
    {
        const std::scoped_lock lock(mutex_);
        closing_ = true;
    }
    work_there_.notify_all();
    for (std::thread& worker : workers_) worker.join();
}

LinkTraits ModbusLink::traits() const {
    LinkTraits out;
    out.max_request_bytes = 2 * (isTcp() ? most_exchanged_written : most_written_registers);
    out.max_reply_bytes = 2 * most_read_registers;
    out.useful_in_flight = contexts_.size();
    out.reply_every = isTcp() ? 1 : serial_reply_every;
    return out;
}

bool ModbusLink::ready() {
    const std::scoped_lock lock(mutex_);
    return under_way_ < contexts_.size() - dead_;
}

base::Result<void> ModbusLink::send(const Request& request) {
    {
        const std::scoped_lock lock(mutex_);
        if (dead_ == contexts_.size())
            return base::fail("io.link-lost", "the device does not take connections any more", {url_.text, 0, 0, {}});
        requests_.push_back(request);
        ++under_way_;
    }
    work_there_.notify_one();
    return {};
}

base::Result<std::optional<Bytes>> ModbusLink::receive(double timeout_s) {
    std::unique_lock lock(mutex_);
    const bool was_ready = under_way_ < contexts_.size() - dead_;
    const auto something = [&] {
        const bool got_ready = !was_ready && under_way_ < contexts_.size() - dead_;
        return !replies_.empty() || dead_ == contexts_.size() || got_ready;
    };
    news_.wait_for(lock, std::chrono::duration<double>(timeout_s), something);
    if (!replies_.empty()) {
        Bytes reply = std::move(replies_.front());
        replies_.pop_front();
        return reply;
    }
    if (dead_ == contexts_.size())
        return base::fail("io.link-lost", "the device does not take connections any more", {url_.text, 0, 0, {}});
    return std::nullopt;
}

void ModbusLink::work(modbus_t* context) {
    while (true) {
        std::unique_lock lock(mutex_);
        work_there_.wait(lock, [this] { return closing_ || !requests_.empty(); });
        if (closing_) return;
        const Request request = std::move(requests_.front());
        requests_.pop_front();
        lock.unlock();
        auto reply = transact(context, request);
        if (!reply) recover(context);
        lock.lock();
        --under_way_;
        if (reply && !reply->empty()) replies_.push_back(*std::move(reply));
        const bool dead = ::modbus_get_socket(context) < 0;
        if (dead) ++dead_;
        lock.unlock();
        news_.notify_all();
        if (dead) return;
    }
}

std::optional<Bytes> ModbusLink::read(modbus_t* context, const Request& request) const {
    const std::uint16_t from = request.area == ReplyArea::Status ? status_register : upload_register;
    Registers registers(std::min(most_read_registers, (request.reply_bytes + 1) / 2));
    const auto count = static_cast<int>(registers.size());
    if (::modbus_read_registers(context, from, count, registers.data()) != count) return std::nullopt;
    return toBytes(registers);
}

std::optional<Bytes> ModbusLink::transact(modbus_t* context, const Request& request) const {
    const Registers written = toRegisters(request.bytes);
    const auto count = static_cast<int>(written.size());
    if (!request.reply_wanted || !isTcp()) {
        if (::modbus_write_registers(context, mailbox_register, count, written.data()) != count) return std::nullopt;
        return request.reply_wanted ? read(context, request) : Bytes();
    }
    const std::uint16_t from = request.area == ReplyArea::Status ? status_register : upload_register;
    Registers registers(std::min(most_read_registers, (request.reply_bytes + 1) / 2));
    const auto wanted = static_cast<int>(registers.size());
    if (::modbus_write_and_read_registers(context, mailbox_register, count, written.data(), from, wanted,
                                          registers.data()) != wanted)
        return std::nullopt;
    return toBytes(registers);
}

/// A reply that comes late would be taken for that of every later request. libmodbus has an error recovery for that
/// (MODBUS_ERROR_RECOVERY_LINK); here a TCP connection is made anew, which is surer, and a serial line is left to fall
/// silent.
void ModbusLink::recover(modbus_t* context) {
    if (!isTcp()) {
        // Until nothing comes for 20 ms: five times the silence between frames at 9600 baud.
        for (int i = 0; i < 25; ++i) {
            waitFor(::modbus_get_socket(context), false, 0.02);
            if (::modbus_flush(context) <= 0) return;
        }
        return;
    }
    for (unsigned i = 0; i < reconnect_tries; ++i) {
        ::modbus_close(context);
        if (connectModbus(context)) return;
        std::unique_lock lock(mutex_);
        if (closing_) return;
        work_there_.wait_for(lock, std::chrono::milliseconds(100) * (i + 1), [this] { return closing_; });
    }
}

}  // namespace cusp::comm
