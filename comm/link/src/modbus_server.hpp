// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Modbus servers on libmodbus: what clients ask is read here without ever waiting for one of them, libmodbus replies.
#pragma once

#include "modbus_link.hpp"

#include <cusp/comm/link/modbus_query.hpp>

#include <list>
#include <string>

namespace cusp::comm {

struct FreeMapping {
    void operator()(modbus_mapping_t* mapping) const { ::modbus_mapping_free(mapping); }
};

/// The registers and who answers behind them.
class ModbusResponder {
public:
    [[nodiscard]] static base::Result<ModbusResponder> make(ModbusContext context, RequestHandler& handler);
    /// `frame` with `header` bytes before its PDU and `trailer` after it. False when the reply could not be sent.
    [[nodiscard]] bool answer(ByteView frame, std::size_t header, std::size_t trailer);
    [[nodiscard]] modbus_t* context() const { return context_.get(); }

private:
    ModbusResponder(ModbusContext context, RequestHandler& handler)
        : context_(std::move(context)), handler_(&handler) {}
    void refresh(std::uint16_t address, const Bytes& bytes);

    ModbusContext context_;
    RequestHandler* handler_;
    std::unique_ptr<modbus_mapping_t, FreeMapping> mapping_;
};

class ModbusTcpServer : public LinkServer {
public:
    ModbusTcpServer(Listening listening, ListenOptions options, ModbusResponder responder);
    base::Result<void> step(double timeout_s) override;
    std::string name() const override { return name_; }
    std::size_t clients() const override { return clients_.size(); }

private:
    struct Client {
        FileDescriptor descriptor;
        Bytes incoming;
        double seen_s = 0.0;
    };
    void serveAll();
    [[nodiscard]] bool serve(Client& client);

    Listening listening_;
    ListenOptions options_;
    ModbusResponder responder_;
    std::string name_;
    std::list<Client> clients_;
};

class ModbusRtuServer : public LinkServer {
public:
    ModbusRtuServer(ModbusResponder responder, LinkUrl url);
    base::Result<void> step(double timeout_s) override;
    std::string name() const override { return url_.text; }

private:
    ModbusResponder responder_;
    LinkUrl url_;
};

}  // namespace cusp::comm
