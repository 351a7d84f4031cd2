// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of everything a link reads: streams, CAN frames, Modbus requests, URLs.
#include <cusp/comm/link/iso_tp.hpp>
#include <cusp/comm/link/link_url.hpp>
#include <cusp/comm/link/modbus_query.hpp>
#include <cusp/comm/link/stream_framing.hpp>

#include <algorithm>
#include <cstdlib>

namespace {

using namespace cusp::comm;

void frames(ByteView rest, bool fd) {
    IsoTpEndpoint end({.fd = fd});
    static_cast<void>(end.send(Bytes(300, 7)));
    double now_s = 0.0;
    while (!rest.empty()) {
        const std::size_t size = std::min<std::size_t>(rest[0] % 65, rest.size() - 1);
        end.receive(rest.subspan(1, size), now_s);
        rest = rest.subspan(1 + size);
        now_s += 0.01;
        for (int i = 0; i < 100; ++i) {
            const auto frame = end.poll(now_s);
            if (!frame) break;
            if (frame->empty() || frame->size() > (fd ? 64U : 8U)) std::abort();
        }
        while (const auto message = end.next()) {
            if (message->empty() || message->size() > IsoTpEndpoint::max_message_bytes) std::abort();
        }
    }
}

void streams(ByteView input) {
    StreamDeframer whole(100);
    whole.push(input);
    StreamDeframer pieces(100);
    for (const std::uint8_t byte : input) pieces.push(ByteView(&byte, 1));
    while (true) {
        const auto a = whole.next();
        const auto b = pieces.next();
        if (a != b || (a && a->size() > 100)) std::abort();
        if (!a) break;
    }
    StreamDeframer back(input.size() + 1);
    back.push(frameForStream(input));
    if (!input.empty() && back.next() != Bytes(input.begin(), input.end())) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const ByteView input(data, size);
    streams(input);
    frames(input, false);
    frames(input, true);
    const auto parsed = parseModbusQuery(input);
    if (parsed.fault == ModbusFault::None) {
        const bool writes_mailbox = parsed.query.written.empty() || parsed.query.write_address == mailbox_register;
        if (!writes_mailbox || parsed.query.read_count > most_read_registers) std::abort();
    }
    if (const auto frame = modbusTcpFrameBytes(input); frame && *frame > size) std::abort();
    const auto url = parseLinkUrl(textOf(input));
    if (url && url->text != textOf(input)) std::abort();
    return 0;
}
