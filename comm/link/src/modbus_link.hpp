// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Modbus as a link: libmodbus clients, one context per thread, as many as connections.
#pragma once

#include "file_descriptor.hpp"

#include <cusp/comm/link/registers.hpp>

#include <condition_variable>
#include <deque>
#include <memory>
#include <modbus/modbus.h>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace cusp::comm {

struct FreeModbus {
    void operator()(modbus_t* context) const;
};
using ModbusContext = std::unique_ptr<modbus_t, FreeModbus>;

/// A context that is not connected yet.
[[nodiscard]] base::Result<ModbusContext> makeModbus(const LinkUrl& url);
/// libmodbus waits with select(), which has no room for descriptors from FD_SETSIZE on and would write past its end.
[[nodiscard]] bool connectModbus(modbus_t* context);

class ModbusLink : public Link {
public:
    [[nodiscard]] static base::Result<std::unique_ptr<ModbusLink>> open(const LinkUrl& url);
    ~ModbusLink() override;

    LinkTraits traits() const override;
    bool ready() override;
    base::Result<void> send(const Request& request) override;
    base::Result<std::optional<Bytes>> receive(double timeout_s) override;
    std::string name() const override { return url_.text; }

private:
    explicit ModbusLink(LinkUrl url) : url_(std::move(url)) {}
    void work(modbus_t* context);
    /// Nothing when the transaction failed; empty when no reply was wanted.
    [[nodiscard]] std::optional<Bytes> transact(modbus_t* context, const Request& request) const;
    [[nodiscard]] std::optional<Bytes> read(modbus_t* context, const Request& request) const;
    void recover(modbus_t* context);
    [[nodiscard]] bool isTcp() const { return url_.kind == LinkKind::ModbusTcp; }

    LinkUrl url_;
    std::vector<ModbusContext> contexts_;
    std::vector<std::thread> workers_;

    std::mutex mutex_;
    std::condition_variable work_there_;
    std::condition_variable news_;
    std::deque<Request> requests_;
    std::deque<Bytes> replies_;
    std::size_t under_way_ = 0;
    std::size_t dead_ = 0;  ///< contexts that could not be connected again
    bool closing_ = false;
};

}  // namespace cusp::comm
