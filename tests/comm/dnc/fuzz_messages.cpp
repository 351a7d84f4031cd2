// SPDX-FileCopyrightText: The cusp authors
// SPDX-License-Identifier: Apache-2.0
// Fuzz entry of both ends of the protocol: hostile requests start nothing and store nothing that was not announced, and
// hostile replies bring a sender to an end or leave it asking.
#include "memory_host.hpp"

#include <cusp/comm/dnc/sender.hpp>

#include <cstdlib>

namespace {

using namespace cusp::comm;

/// The next piece of the input: a length, then so many bytes.
ByteView nextPiece(ByteView& rest) {
    if (rest.empty()) return {};
    const std::size_t size = std::min<std::size_t>(rest[0], rest.size() - 1);
    const ByteView piece = rest.subspan(1, size);
    rest = rest.subspan(1 + size);
    return piece;
}

/// The fuzzer cannot guess a CRC or a session: half the pieces are given both, so that what lies behind is reached.
Bytes madeValid(ByteView piece, std::uint32_t session) {
    if (piece.size() < 6) return Bytes(piece.begin(), piece.end());
    RequestMessage message;
    message.type = static_cast<RequestType>(1 + (piece[0] % 9));
    message.reply_wanted = (piece[0] & 0x80U) != 0;
    message.tag = piece[1];
    message.session = session;
    message.argument = get32(piece, 2);
    message.payload = piece.subspan(6);
    return encode(message);
}

void askReceiver(ByteView rest) {
    test::MemoryHost host;
    host.fifo_bytes = 200;
    Receiver receiver({.reassembly_chunks = 4, .prefill_bytes = 20, .max_line_bytes = 40}, host, 1);
    double now_s = 0.0;
    for (bool valid = false; !rest.empty(); valid = !valid) {
        const ByteView piece = nextPiece(rest);
        now_s += piece.empty() ? 20.0 : 0.01;
        const Bytes reply =
            receiver.handle(valid ? madeValid(piece, receiver.session()) : Bytes(piece.begin(), piece.end()), now_s);
        if (!reply.empty() && !decodeAcknowledgement(reply)) std::abort();
        static_cast<void>(receiver.area(ReplyArea::Upload));
    }
    // Nobody enabled a start; and what is stored has the digest that was announced.
    if (host.starts != 0 || host.overfilled) std::abort();
    for (const auto& [name, text] : host.programs) {
        if (!isProgramName(name) || sha256(bytesOf(text)) != receiver.program().digest) {
            // An earlier transfer's program is checked by its own commit; only the last one's header is still here.
            if (host.commits < 2) std::abort();
        }
    }
}

void answerSender(ByteView rest) {
    LinkTraits link;
    link.max_request_bytes = 200;
    link.max_reply_bytes = 200;
    Sender sender({.name = "P.MPF", .text = "N10 X1\nN20 X2\nN30 M30\n"}, {.compare = true, .arm = true, .start = true},
                  link);
    double now_s = 0.0;
    std::uint16_t tag = 1;
    while (!rest.empty() && !sender.over()) {
        while (const auto request = sender.poll(now_s)) tag = get16(request->bytes, 2);
        const ByteView piece = nextPiece(rest);
        now_s += 0.05;
        if (piece.size() < 20) {
            sender.receive(piece, now_s);
            continue;
        }
        Acknowledgement reply;
        reply.tag = tag;
        reply.state = static_cast<ReceiverState>(piece[0] % 9);
        reply.reason = static_cast<Reason>(piece[1] % 22);
        reply.session = piece[2];
        reply.expected = get16(piece, 3) % 40;
        reply.free_bytes = get16(piece, 5);
        reply.running_crc = get32(piece, 7);
        reply.nonce = piece[11];
        reply.command_result = static_cast<Reason>(piece[12] % 22);
        Bytes bytes = encode(reply);
        append(bytes, piece.subspan(13));
        sender.receive(bytes, now_s);
        if (!(sender.nextWakeSeconds(now_s) > now_s)) std::abort();
    }
    if (sender.over() && sender.outcome().end != TransferEnd::Delivered && sender.outcome().message.empty())
        std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const ByteView input(data, size);
    static_cast<void>(decodeRequest(input));
    static_cast<void>(decodeProgramHeader(input));
    static_cast<void>(decodeMachineStatus(input));
    static_cast<void>(decodeUploadPiece(input));
    askReceiver(input);
    answerSender(input);
    return 0;
}
